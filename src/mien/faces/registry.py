"""Faces by address: ``head``, ``head:ada``, ``toon:olav``, ``keypose:NAME``, ``ada.face.json``, ``ada.keypose``.

The only place that names the kinds.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path

from mien.core import Face, LoadError, MienError, UnknownNameError

from .head.people import address, people, read_head, shipped_head
from .keypose.files import SUFFIX as KEYPOSE
from .keypose.shipped import keypose_address, keypose_from_folder, keypose_names, keyposes, shipped_keypose
from .toon.shipped import shipped_toon, toon_address, toon_from_file, toon_names, toons
from .toon.solid import on_solid

SUFFIXES: Mapping[str, Callable[[Path], Face]] = {".face.json": read_head, ".toon.json": toon_from_file}
KINDS: Mapping[str, Callable[[str], Face]] = {"head": shipped_head, "toon": shipped_toon, "keypose": shipped_keypose}


def face_names() -> list[tuple[str, str]]:
    """(address, what it is) of every face that is installed."""
    return [*((address(name), row["doc"]) for name, row in people().items()), *toons().items(), *keyposes().items()]


def load_face(name: str | os.PathLike[str]) -> Face:
    """The face at an address: a shipped face, a face file or a folder of phases.

    A drawn one may have ``+egg`` or ``+box`` behind its name: on a solid body.

    Raises:
        UnknownNameError: no face has that name.
        LoadError: the file is missing or not a face.
    """
    text = os.fspath(name)
    drawn, _, solid = text.rpartition("+")
    if drawn.startswith("toon:") or drawn.lower().endswith(".toon.json"):
        return on_solid(load_face(drawn), solid)
    for suffix, read in SUFFIXES.items():
        if text.lower().endswith(suffix):
            path = Path(text)
            if not path.is_file():
                raise LoadError(path, "there is no such file")
            return read(path)
    if text.rstrip("/" + os.sep).lower().endswith(KEYPOSE):
        return keypose_from_folder(Path(text))
    if os.sep in text or text.endswith(".json"):
        raise MienError(f"{text}: not a face file — face files end in {', '.join(SUFFIXES)}, folders in {KEYPOSE}")
    kind, _, rest = text.partition(":")
    known = [*map(address, people()), *map(toon_address, toon_names()), *map(keypose_address, keypose_names())]
    if text not in known:
        raise UnknownNameError("face", text, known)
    return KINDS[kind](rest or kind)
