"""Faces to start a drawing from."""

from __future__ import annotations

import json
import re
from importlib.resources import files

from mien.core import UnknownNameError

from .records import Mode
from .shipped import FOLDER, SUFFIX, toon_names


def starter_text(name: str, mode: Mode = "extended") -> str:
    """The file of a small face with all that a face needs, called ``name``."""
    return _renamed(files(__package__).joinpath("data", "starters", mode + SUFFIX).read_text(encoding="utf-8"), name)


def copied_text(name: str, like: str) -> str:
    """The file of a character that ships, called ``name``.

    Raises:
        UnknownNameError: no character is called ``like``.
    """
    like = like.removeprefix("toon:")
    if like not in toon_names():
        raise UnknownNameError("toon", like, toon_names())
    return _renamed(files(__package__).joinpath(*FOLDER, like + SUFFIX).read_text(encoding="utf-8"), name)


def _renamed(text: str, name: str) -> str:
    """The text with another name, and otherwise as it was written."""
    return re.sub(r'"name": *"[^"]*"', lambda _: f'"name": {json.dumps(name, ensure_ascii=False)}', text, count=1)
