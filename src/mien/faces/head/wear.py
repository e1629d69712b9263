"""What a person may have besides hair: a beard, which follows the skin, and glasses, which follow the head."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from mien.core import UnknownNameError
from mien.core.mesh import Ints, Points

from .hair import STEP_M, STEP_SHADE
from .measured import Archive, Floats, archive, read_archive

NONE = "none"
NO_QUADS = np.zeros((0, 4), dtype=np.int64)


@dataclass(frozen=True, eq=False)
class Beard:
    """A shell that stands on vertices of the skin.

    Attributes:
        index: (B, 1) vertices of the skin.
        offset: (B,) m, how far off it along its normal.
        quads: (F, 4).
        shade: (B, 2) brightness, and share of the skin's colour.
        tint: (S,) share of the hair's colour in the skin's.
        twin: (B,) vertex in the mirror.
    """

    index: Ints
    offset: Floats
    quads: Ints
    shade: Floats
    tint: Floats
    twin: Ints


@dataclass(frozen=True, eq=False)
class Glasses:
    """A frame without lenses.

    Attributes:
        points: (G, 3) m.
        quads: (F, 4).
        color: (3,) linear RGB.
    """

    points: Points
    quads: Ints
    color: Floats


@cache
def beard_styles() -> tuple[str, ...]:
    """Names of the beards that ship, none first."""
    return _names("beard", "tint")


@cache
def glasses_styles() -> tuple[str, ...]:
    """Names of the glasses that ship, none first."""
    return _names("glasses", "points")


@cache
def beard(style: str) -> Beard:
    """A beard; stubble only tints the skin, and none does nothing.

    Raises:
        UnknownNameError: there is no such beard.
    """
    check_style("beard", style, beard_styles())
    if style == NONE:
        nobody = np.zeros(0, dtype=np.int64)
        return Beard(nobody[:, None], np.zeros(0), NO_QUADS, np.zeros((0, 2)), np.zeros(len(archive().mirror)), nobody)
    data, key = _wear(), f"beard_{style}_"
    index = data.ints(f"{key}index")
    shade, tint = data.floats(f"{key}shade") * STEP_SHADE, data.floats(f"{key}tint") * STEP_SHADE
    twin = np.searchsorted(index, archive().mirror[index])
    return Beard(index[:, None], data.floats(f"{key}offset") * STEP_M, data.ints(f"{key}quads"), shade, tint, twin)


@cache
def glasses(style: str) -> Glasses:
    """Glasses; none has no points.

    Raises:
        UnknownNameError: there are no such glasses.
    """
    check_style("glasses", style, glasses_styles())
    if style == NONE:
        return Glasses(np.zeros((0, 3)), NO_QUADS, np.zeros(3))
    data, key = _wear(), f"glasses_{style}_"
    return Glasses(data.floats(f"{key}points") * STEP_M, data.ints(f"{key}quads"), data.floats(f"{key}color"))


def check_style(kind: str, style: str, styles: tuple[str, ...]) -> None:
    """Raise UnknownNameError for a style that is not among those that ship."""
    if style not in styles:
        raise UnknownNameError(kind, style, styles)


def _names(kind: str, key: str) -> tuple[str, ...]:
    first, last = f"{kind}_", f"_{key}"
    rows = (name for name in _wear().arrays if name.startswith(first) and name.endswith(last))
    return (NONE, *(name.removeprefix(first).removesuffix(last) for name in rows))


@cache
def _wear() -> Archive:
    return read_archive("wear")
