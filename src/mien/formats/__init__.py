"""Files: one module a format, listed in ``table``; each appears whole or not at all.

Nothing heavy is imported here: the codecs come when the first film or picture is written.
"""

from .cue_files import check_cue_file, read_cue_file, write_cue_file
from .cue_sheet import CueSheet
from .performances import check_performance, write_performance
from .rates import DEFAULT_FPS
from .table import FORMATS, Format, find_format

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
