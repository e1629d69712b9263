"""The 3-D result of a face: points, polygons of any size, colours, named parts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import MienError, UnknownNameError

Points = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True)
class Material:
    """How a part takes the light.

    Attributes:
        gloss: strength of the highlight, 0..1.
        gloss_power: sharpness of the highlight.
        two_sided: its back is drawn too (hair shells, lashes).
        lit: False for what shines by itself (the reflection spot).
        flat: one normal a polygon even where the picture is smooth.
        round: its normals are the mesh's own (``Mesh.normals``), not averaged from polygons.
        subdivide: it takes part in subdivision.
    """

    gloss: float = 0.0
    gloss_power: int = 16
    two_sided: bool = False
    lit: bool = True
    flat: bool = False
    round: bool = False
    subdivide: bool = False


@dataclass(frozen=True)
class Part:
    """A named run of polygons ``first:last`` of one material."""

    name: str
    first: int
    last: int
    material: Material = Material()


@dataclass(frozen=True, eq=False)
class Topology:
    """What stays the same while a face moves: who is connected with whom. Shared by all meshes of a face.

    Polygon f has the corners ``corners[starts[f]:starts[f + 1]]``, anticlockwise seen from outside. A crease that
    must stay sharp is a pair of edges with vertices of their own at the same places ("doubled vertices"), or a
    row of ``creases``; a row of one vertex, twice, is a corner, which subdivision leaves where it is. The parts cover
    all polygons in order. Polygons that have one number of ``tints``, -1 excepted, and a vertex in common flow into one
    another where colours belong to polygons and are subdivided; none if nothing flows.
    """

    vertex_count: int
    corners: Ints
    starts: Ints
    parts: tuple[Part, ...]
    creases: Ints = field(default_factory=lambda: np.zeros((0, 2), dtype=np.int64))
    tints: Ints | None = None

    def __post_init__(self) -> None:
        if len(self.corners) and not (self.corners.min() >= 0 and self.corners.max() < self.vertex_count):
            raise MienError(f"a polygon names a vertex that is not in 0..{self.vertex_count - 1}")
        ends = [0, *(part.last for part in self.parts)]
        if [part.first for part in self.parts] != ends[:-1] or ends[-1] != self.polygon_count:
            raise MienError("the parts of a topology must cover its polygons in order, without gap or overlap")

    @property
    def polygon_count(self) -> int:
        """Number of polygons F."""
        return len(self.starts) - 1

    def part(self, name: str) -> Part:
        """The part of that name."""
        for part in self.parts:
            if part.name == name:
                return part
        raise UnknownNameError("part", name, [part.name for part in self.parts])

    def polygon(self, number: int) -> Ints:
        """(n,) vertex numbers of one polygon."""
        return self.corners[self.starts[number] : self.starts[number + 1]]

    def keeping(self, polygons: NDArray[np.bool_]) -> Topology:
        """The topology with some of its polygons (F,) only; a part that loses all is left out, the vertices stay."""
        sizes = np.diff(self.starts)
        ends = np.concatenate([[0], np.cumsum(polygons)])
        runs = [replace(part, first=int(ends[part.first]), last=int(ends[part.last])) for part in self.parts]
        return replace(
            self,
            corners=self.corners[np.repeat(polygons, sizes)],
            starts=np.concatenate([[0], np.cumsum(sizes[polygons])]),
            parts=tuple(run for run in runs if run.last > run.first),
            tints=None if self.tints is None else self.tints[polygons],
        )

    @cached_property
    def polygon_of_corner(self) -> Ints:
        """(C,) polygon that each corner belongs to."""
        return np.repeat(np.arange(self.polygon_count), np.diff(self.starts))

    @cached_property
    def next_corner(self) -> Ints:
        """(C,) number of the corner that follows each corner around its polygon."""
        following = np.arange(1, len(self.corners) + 1)
        following[self.starts[1:] - 1] = self.starts[:-1]
        return following

    @cached_property
    def triangles(self) -> Ints:
        """(T, 3) vertex numbers, each polygon as a fan from its first corner."""
        return self.corners[self.triangle_corners]

    @cached_property
    def triangle_corners(self) -> Ints:
        """(T, 3) corner numbers of the fans."""
        first = np.repeat(self.starts[:-1], np.diff(self.starts) - 2)
        second = np.concatenate(
            [np.zeros(0), *(np.arange(a + 1, b - 1) for a, b in zip(self.starts[:-1], self.starts[1:], strict=True))]
        )
        second = second.astype(np.int64)
        return np.stack([first, second, second + 1], axis=1)

    @cached_property
    def polygon_of_triangle(self) -> Ints:
        """(T,) polygon that each triangle belongs to."""
        return np.repeat(np.arange(self.polygon_count), np.diff(self.starts) - 2)

    @cached_property
    def part_of_polygon(self) -> Ints:
        """(F,) number of the part of each polygon."""
        return np.repeat(np.arange(len(self.parts)), [part.last - part.first for part in self.parts])


@dataclass(frozen=True, eq=False)
class Mesh:
    """A face at one moment.

    Attributes:
        topology: polygons and parts.
        points: (V, 3) m, head frame: x to the face's own left, y up, z forward.
        colors: (V, 3) a vertex or (F, 3) a polygon, linear RGB 0..1.
        normals: (V, 3) unit normals of the parts whose material is ``round``; other rows are ignored.
        by_polygon: colours are a polygon's even where there are as many vertices as polygons.
    """

    topology: Topology
    points: Points
    colors: Points
    normals: Points | None = None
    by_polygon: bool = False

    def __post_init__(self) -> None:
        vertices, polygons = self.topology.vertex_count, self.topology.polygon_count
        if self.points.shape != (vertices, 3):
            raise MienError(f"points have shape {self.points.shape}, wanted ({vertices}, 3)")
        if self.colors.shape not in ((vertices, 3), (polygons, 3)):
            raise MienError(f"colors have shape {self.colors.shape}, wanted ({vertices}, 3) or ({polygons}, 3)")
        if self.normals is not None and self.normals.shape != (vertices, 3):
            raise MienError(f"normals have shape {self.normals.shape}, wanted ({vertices}, 3)")

    @property
    def colored_by_polygon(self) -> bool:
        """Whether a colour belongs to a polygon (Parke's way) instead of a vertex."""
        topology = self.topology
        return len(self.colors) == topology.polygon_count and (
            self.by_polygon or topology.polygon_count != topology.vertex_count
        )

    def moved(self, points: Points) -> Mesh:
        """The mesh with other points."""
        return replace(self, points=points)

    def keeping(self, polygons: NDArray[np.bool_]) -> Mesh:
        """The mesh with some of its polygons (F,) only; all its points stay."""
        colors = self.colors[polygons] if self.colored_by_polygon else self.colors
        return replace(
            self, topology=self.topology.keeping(polygons), colors=colors, by_polygon=self.colored_by_polygon
        )

    def without(self, parts: Iterable[str]) -> Mesh:
        """The mesh with some of its parts left out.

        Raises:
            UnknownNameError: it has no such part.
        """
        left_out = [self.topology.part(name) for name in parts]
        polygons = np.ones(self.topology.polygon_count, dtype=bool)
        for part in left_out:
            polygons[part.first : part.last] = False
        return self.keeping(polygons)

    def part_vertices(self, name: str) -> Ints:
        """Sorted numbers of the vertices that a part's polygons use."""
        part = self.topology.part(name)
        return np.unique(self.topology.corners[self.topology.starts[part.first] : self.topology.starts[part.last]])


def build_topology(
    vertex_count: int, parts: Sequence[tuple[str, NDArray[Any], Material]], creases: Ints | None = None
) -> Topology:
    """A topology from parts given as (F, n) vertex arrays; a row may repeat its last vertex to pad."""
    corners: list[Ints] = []
    counts: list[Ints] = []
    rows: list[Part] = []
    first = 0
    for name, polygons, material in parts:
        polygons = np.asarray(polygons, dtype=np.int64)
        keep = np.ones(polygons.shape, dtype=bool)
        keep[:, 1:] = polygons[:, 1:] != polygons[:, :-1]
        corners.append(polygons[keep].astype(np.int64))
        counts.append(keep.sum(axis=1))
        rows.append(Part(name, first, first + len(polygons), material))
        first += len(polygons)
    starts = np.concatenate([[0], np.cumsum(np.concatenate(counts))]).astype(np.int64)
    none = np.zeros((0, 2), dtype=np.int64)
    return Topology(vertex_count, np.concatenate(corners), starts, tuple(rows), none if creases is None else creases)
