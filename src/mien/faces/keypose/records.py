"""What the files of a keypose face say."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from mien.core import Material
from mien.core.mesh import Points

Vector = tuple[float, float, float]

UNITS_M: Mapping[str, float] = MappingProxyType({"mm": 0.001, "cm": 0.01, "m": 1.0, "inch": 0.0254})
"""Metres of each unit that points may be written in."""


PLAIN = Material()


@dataclass(frozen=True)
class Polygon:
    """One polygon of the skin.

    Attributes:
        points: numbers from 1, clockwise seen from outside, as Parke went around.
        color: sRGB, ``#rrggbb``.
        line: where it stands in its file; 0 for one that was made.
    """

    points: tuple[int, ...]
    color: str
    line: int = field(default=0, compare=False)


@dataclass(frozen=True)
class SkinPart:
    """Polygons of one material.

    Attributes:
        name: ``skin``.
        polygons: in the order of the file.
        material: how they take the light, and whether they are subdivided.
        blend: where they are subdivided, colours of neighbours flow into one another that are nearly the same.
    """

    name: str
    polygons: tuple[Polygon, ...]
    material: Material = PLAIN
    blend: bool = False


@dataclass(frozen=True)
class KeyposeTopology:
    """Which points make which polygons.

    Attributes:
        parts: in the order of the file.
        midline: points on the plane of symmetry, which have no mirror image.
        creases: lines of points; the edges between neighbours are creases.
    """

    parts: tuple[SkinPart, ...]
    midline: tuple[int, ...] = ()
    creases: tuple[tuple[int, ...], ...] = ()

    @cached_property
    def polygons(self) -> tuple[Polygon, ...]:
        """Those of all parts."""
        return tuple(polygon for part in self.parts for polygon in part.polygons)

    @cached_property
    def point_count(self) -> int:
        """N; the points are numbered 1 to N."""
        return max((number for polygon in self.polygons for number in polygon.points), default=0)

    @cached_property
    def edges(self) -> frozenset[frozenset[int]]:
        """Pairs of points that follow one another around some polygon."""
        return frozenset(edge for polygon in self.polygons for edge in edges_of(polygon.points))


@dataclass(frozen=True)
class Eyes:
    """Eyeballs that turn.

    Attributes:
        part: whose points turn, those at x > 0 as the left eye.
        center: (x, y, z) m, what the left eye turns about; the right eye about its mirror image.
    """

    part: str
    center: Vector


@dataclass(frozen=True, eq=False)
class Keypose:
    """A measured face: one topology, and the places of its points in every phase.

    Attributes:
        name: of the person.
        topology: polygons.
        phases: their names in order of their numbers 1, 2, …; the first is the face at rest.
        places: (K, N, 3) m, of the points in each phase; x to the face's own left, y up, z forward.
        mirror: the points are those of the left half, and of the midline.
        doc: who it is, in a line.
        unit: that the files are written in, of ``UNITS_M``.
        stands_for: own name of a phase -> the standard one that it stands for.
        sided: phases besides the standard ones that either side of the face can show for itself.
        pivot: (x, y, z) m, what the head turns about; None is the middle of the face at rest.
        neck: heights m, at rest, below which nothing turns with the head, and above which all does; None if all does.
        eyes: eyeballs that turn; None where they are part of the skin.
    """

    name: str
    topology: KeyposeTopology
    phases: tuple[str, ...]
    places: Points
    mirror: bool = True
    doc: str = ""
    unit: str = "mm"
    stands_for: Mapping[str, str] = field(default_factory=dict)
    sided: tuple[str, ...] = ()
    pivot: Vector | None = None
    eyes: Eyes | None = None
    neck: tuple[float, float] | None = None

    @cached_property
    def on_midline(self) -> NDArray[np.bool_]:
        """(N,) which points have no mirror image."""
        flags = np.zeros(self.places.shape[1], dtype=np.bool_)
        flags[[number - 1 for number in self.topology.midline]] = True
        return flags


def edges_of(points: Iterable[int]) -> list[frozenset[int]]:
    """Pairs of points that follow one another around a polygon."""
    around = list(points)
    return [frozenset(pair) for pair in zip(around, [*around[1:], *around[:1]], strict=True)]
