"""Hair styles: shells around the skull, read from a file of their own when one is asked for."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from mien.core import Material, UnknownNameError
from mien.core.mesh import Ints, Points

from .measured import Archive, Floats, read_archive

BALD = "bald"
STEP_M, STEP_SHADE = 1e-5, 0.01
"""Units of the whole numbers in the file."""

MATERIALS = {
    "afro": Material(gloss=0.015, gloss_power=8),
    "curls": Material(gloss=0.05, gloss_power=14),
    "crop": Material(gloss=0.045, gloss_power=16),
    "ring": Material(gloss=0.04, gloss_power=12),
}
SMOOTH = Material(gloss=0.085, gloss_power=20)
"""How hair takes the light: curly and short hair scatters it, smooth hair shines."""


@dataclass(frozen=True, eq=False)
class Hair:
    """A hair style as closed shells around the skull.

    Attributes:
        points: (N, 3) m.
        quads: (F, 4).
        shade: (N, 2) brightness, and share of the skin's colour at the hairline.
        material: how it takes the light.
    """

    points: Points
    quads: Ints
    shade: Floats
    material: Material = SMOOTH


@cache
def hair_styles() -> tuple[str, ...]:
    """Names of the hair styles that ship, bald first."""
    return (BALD, *(name.removesuffix("_points") for name in _styles().arrays if name.endswith("_points")))


@cache
def hair(style: str) -> Hair:
    """A hair style; that of the bald has no points.

    Raises:
        UnknownNameError: there is no such hair style.
    """
    if style not in hair_styles():
        raise UnknownNameError("hair style", style, hair_styles())
    if style == BALD:
        return Hair(np.zeros((0, 3)), np.zeros((0, 4), dtype=np.int64), np.zeros((0, 2)))
    data = _styles()
    points, shade = data.floats(f"{style}_points") * STEP_M, data.floats(f"{style}_shade") * STEP_SHADE
    return Hair(points, data.ints(f"{style}_quads"), shade, MATERIALS.get(style, SMOOTH))


@cache
def _styles() -> Archive:
    return read_archive("hair")
