"""The measured people that ship, and those in folders."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib import resources
from pathlib import Path

from mien.core import UnknownNameError

from .face import KeyposeFace
from .files import SUFFIX, read_doc, read_keypose

FAMILY = "keypose"


@cache
def keypose_names() -> tuple[str, ...]:
    """Names of the measured people that ship, sorted."""
    return tuple(sorted(path.name.removesuffix(SUFFIX) for path in _folder().glob(f"*{SUFFIX}")))


@cache
def keyposes() -> Mapping[str, str]:
    """Who each of them is, by address."""
    return {keypose_address(name): read_doc(_folder() / f"{name}{SUFFIX}") for name in keypose_names()}


def keypose_address(name: str) -> str:
    """How a measured person is called for: ``keypose:NAME``."""
    return f"{FAMILY}:{name}"


@cache
def shipped_keypose(name: str) -> KeyposeFace:
    """A measured person who ships.

    Raises:
        UnknownNameError: there is none of that name.
    """
    if name not in keypose_names():
        raise UnknownNameError(FAMILY, name, keypose_names())
    return KeyposeFace(read_keypose(_folder() / f"{name}{SUFFIX}"), keypose_address(name))


def keypose_from_folder(path: Path) -> KeyposeFace:
    """The face in a folder; its address is the path.

    Raises:
        LoadError: the folder cannot be read or understood.
    """
    return KeyposeFace(read_keypose(path), str(path))


def _folder() -> Path:
    # Files of an installed package are plain files: those of the measured head are as well.
    return Path(str(resources.files(__package__).joinpath("data")))
