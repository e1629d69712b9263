"""The characters that ship, and characters in files."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib import resources
from pathlib import Path

from mien.core import UnknownNameError

from .reader import parse_toon, read_toon
from .toon import ToonFace

SUFFIX = ".toon.json"
FOLDER = ("data", "characters")


@cache
def toon_names() -> tuple[str, ...]:
    """Names of the characters that ship, sorted."""
    folder = resources.files(__package__).joinpath(*FOLDER)
    return tuple(sorted(entry.name.removesuffix(SUFFIX) for entry in folder.iterdir() if entry.name.endswith(SUFFIX)))


@cache
def toons() -> Mapping[str, str]:
    """What each character is, by its address."""
    return {toon_address(name): shipped_toon(name).character.doc for name in toon_names()}


def toon_address(name: str) -> str:
    """How a shipped character is called for: ``toon:olav``."""
    return f"toon:{name}"


@cache
def shipped_toon(name: str) -> ToonFace:
    """A character that ships.

    Raises:
        UnknownNameError: there is none of that name.
    """
    if name not in toon_names():
        raise UnknownNameError("toon", name, toon_names())
    text = resources.files(__package__).joinpath(*FOLDER, name + SUFFIX).read_text(encoding="utf-8")
    return ToonFace(parse_toon(text, name + SUFFIX), toon_address(name))


def toon_from_file(path: Path) -> ToonFace:
    """The character in a file; its address is the path.

    Raises:
        LoadError: it cannot be read or understood.
    """
    return ToonFace(read_toon(path), str(path))
