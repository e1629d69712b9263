"""The 2-D result of a face: an ordered list of filled paths."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from .errors import MienError, UnknownNameError

Rule = Literal["evenodd", "nonzero"]
Rgba = tuple[float, float, float, float]
Contours = tuple[NDArray[np.float64], ...]

RULES: tuple[Rule, ...] = ("evenodd", "nonzero")


@dataclass(frozen=True, eq=False)
class Region:
    """An area that cuts paths and is not painted itself. Paths cut by the same area share one region.

    Attributes:
        contours: closed outlines, each (N, 2) in the drawing's units, x right, y up.
        rule: what is inside where contours overlap, as in SVG: evenodd, or nonzero, which goes by their direction.
    """

    contours: Contours
    rule: Rule = "evenodd"

    def __post_init__(self) -> None:
        _check("region", self.contours, self.rule)


@dataclass(frozen=True, eq=False)
class Path:
    """One filled shape, painted where it lies inside of all of some regions and outside of all of others.

    Attributes:
        name: the part it shows.
        contours: closed outlines, each (N, 2) in the drawing's units, x right, y up.
        color: linear RGBA 0..1; light above 1 is as bright as it gets.
        rule: what is inside where contours overlap, as in SVG: evenodd, or nonzero, which goes by their direction.
        inside: regions that clip it.
        outside: regions that are holes in it.
    """

    name: str
    contours: Contours
    color: Rgba
    rule: Rule = "evenodd"
    inside: tuple[Region, ...] = ()
    outside: tuple[Region, ...] = ()

    def __post_init__(self) -> None:
        place = f"path {self.name!r}"
        _check(place, self.contours, self.rule)
        if len(self.color) != 4 or not all(map(math.isfinite, self.color)) or not 0.0 <= self.color[3] <= 1.0:
            raise MienError(f"{place}: a colour is red, green, blue and an alpha from 0 to 1, got {self.color}")


@dataclass(frozen=True, eq=False)
class Drawing:
    """Filled paths, drawn in order, on a canvas with its origin in the lower left.

    Attributes:
        size: (width, height) of the canvas.
        paths: what is painted, the hindmost first.
        background: linear RGBA of what the drawing itself has behind it, opaque; None leaves that to the scene.
    """

    size: tuple[float, float]
    paths: tuple[Path, ...]
    background: Rgba | None = None

    def __post_init__(self) -> None:
        if len(self.size) != 2 or not all(math.isfinite(side) and side > 0.0 for side in self.size):
            raise MienError(f"drawing: a canvas has a width and a height above 0, got {self.size}")
        if self.background is not None and self.background[3] != 1.0:
            raise MienError(f"drawing: its own background must be opaque, got {self.background} — leave it out (None)")


def _check(place: str, contours: Contours, rule: str) -> None:
    if rule not in RULES:
        raise UnknownNameError(f"rule of {place}", str(rule), RULES)
    for contour in contours:
        if contour.ndim != 2 or contour.shape[1] != 2 or not np.isfinite(contour).all():
            raise MienError(f"{place}: a contour must be finite points (N, 2), got shape {contour.shape}")
