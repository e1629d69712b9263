"""Faces you can play: type a sentence, and a face says it.

Names are imported when they are first used, so that ``import mien`` alone costs next to nothing.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .api import (
        draw,
        draw_paths,
        face_names,
        hear,
        load_face,
        make_model,
        make_pose,
        make_puppet,
        perform,
        play,
        pose_from,
        say,
        sheet,
        speak,
        voices,
    )
    from .core import (
        Cue,
        Face,
        Light,
        LoadError,
        Mesh,
        MienError,
        Parameter,
        ParameterTable,
        Pose,
        RangeError,
        Scene,
        Sound,
        UnknownNameError,
        caricature,
    )
    from .formats.picture import Picture
    from .formats.sheet import contact_sheet
    from .live.client import AsyncClient, Client
    from .perform import Performance, Style, exaggerate
    from .speech import Speech
    from .timeline import Layer, Timeline, Track

    __version__: str

__all__ = [
    "AsyncClient",
    "Client",
    "Cue",
    "Face",
    "Layer",
    "Light",
    "LoadError",
    "Mesh",
    "MienError",
    "Parameter",
    "ParameterTable",
    "Performance",
    "Picture",
    "Pose",
    "RangeError",
    "Scene",
    "Sound",
    "Speech",
    "Style",
    "Timeline",
    "Track",
    "UnknownNameError",
    "__version__",
    "caricature",
    "contact_sheet",
    "draw",
    "draw_paths",
    "exaggerate",
    "face_names",
    "hear",
    "load_face",
    "make_model",
    "make_pose",
    "make_puppet",
    "perform",
    "play",
    "pose_from",
    "say",
    "sheet",
    "speak",
    "voices",
]

_HOMES = {
    "mien.api": (
        "draw",
        "draw_paths",
        "face_names",
        "hear",
        "load_face",
        "make_model",
        "make_pose",
        "make_puppet",
        "perform",
        "play",
        "pose_from",
        "say",
        "sheet",
        "speak",
        "voices",
    ),
    "mien.formats.picture": ("Picture",),
    "mien.formats.sheet": ("contact_sheet",),
    "mien.live.client": ("AsyncClient", "Client"),
    "mien.perform": ("Performance", "Style", "exaggerate"),
    "mien.speech": ("Speech",),
    "mien.timeline": ("Layer", "Timeline", "Track"),
}
"""Module -> names that are imported from it; all others come from ``mien.core``."""

_HOME_OF = {name: module for module, names in _HOMES.items() for name in names}


def __getattr__(name: str) -> Any:
    if name == "__version__":
        value = import_module("importlib.metadata").version("mien")
    elif name in __all__:
        value = getattr(import_module(_HOME_OF.get(name, "mien.core")), name)
    else:
        raise AttributeError(f"module 'mien' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


class _Perform(ModuleType):
    """The subpackage ``mien.perform``, which has the name of the function ``mien.perform`` and so answers for it."""

    def __call__(self, *arguments: Any, **options: Any) -> Any:
        return import_module("mien.api").perform(*arguments, **options)


class _Mien(ModuleType):
    """This module, which sees to it that importing ``mien.perform`` does not hide the function."""

    def __setattr__(self, name: str, value: Any) -> None:
        # Whoever imports a subpackage makes it an attribute of its parent, in the place of the function.
        if name == "perform" and isinstance(value, ModuleType):
            value.__class__ = _Perform
        super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Mien
