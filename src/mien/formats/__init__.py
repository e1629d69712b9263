"""Files: one module a format, listed in ``table``; each appears whole or not at all.

Nothing heavy is imported here: the codecs come when the first film or picture is written.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .performances import check_performance, write_performance
from .rates import DEFAULT_FPS
from .table import FORMATS, Format, find_format

if TYPE_CHECKING:
    from .cue_files import check_cue_file, read_cue_file, write_cue_file
    from .cue_sheet import CueSheet

__all__ = [
    "DEFAULT_FPS",
    "FORMATS",
    "CueSheet",
    "Format",
    "check_cue_file",
    "check_performance",
    "find_format",
    "read_cue_file",
    "write_cue_file",
    "write_performance",
]

_HOMES = {"CueSheet": "cue_sheet", **dict.fromkeys(("check_cue_file", "read_cue_file", "write_cue_file"), "cue_files")}
"""Names that are imported when they are first used, and from where: most films need no files of cues."""


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_HOMES[name]}", __name__), name)
