"""From numbered points to a topology: the mirror image of a half, doubled vertices along creases.

Source: Parke 1972, "Representation of the face".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

from mien.core import Part, Topology, exact
from mien.core.creases import double_creases
from mien.core.mesh import Ints, Points

from .records import Keypose, edges_of

MIRROR = np.array([-1.0, 1.0, 1.0])


@dataclass(frozen=True, eq=False)
class Skin:
    """The polygons of a whole face.

    Attributes:
        topology: anticlockwise, with doubled vertices.
        colors: (F, 3) linear RGB of the polygons; read-only.
        point: (V,) the measured point, from 0, of each vertex.
        sign: (V,) -1 for the mirror image of its point, else 1.
        mirror: (V,) the vertex that each becomes in the mirror, -1 where the face is not mirrored.
    """

    topology: Topology
    colors: Points
    point: Ints
    sign: NDArray[np.float64]
    mirror: Ints

    def places(self, measured: Points) -> Points:
        """(…, V, 3) m of the vertices, of measured points (…, N, 3)."""
        out = measured[..., self.point, :].copy()
        out[..., 0] *= self.sign
        return out


def make_skin(keypose: Keypose) -> Skin:
    """The whole face that the files describe."""
    rows, origin, parts = _polygons(keypose)
    twin = _twins(keypose)
    lines = [[number - 1 for number in line] for line in keypose.topology.creases]
    if keypose.mirror:
        lines += [[int(twin[number]) for number in line] for line in lines]
    edges = [pair for line in lines for pair in pairwise(line)]
    count = keypose.topology.point_count
    whole = int(twin.max()) + 1
    cut, doubled = double_creases(rows, edges, whole)
    source = np.concatenate([np.arange(whole), doubled])
    point, sign = np.arange(whole), np.ones(whole)
    point[twin] = np.arange(count)
    sign[count:] = -1.0
    topology = Topology(
        len(source),
        np.array([vertex for row in cut for vertex in row], dtype=np.int64),
        np.cumsum([0, *map(len, cut)]),
        tuple(parts),
        _corners(rows, edges, source),
        _tints(keypose, rows, origin),
    )
    shades = np.array([[linear(code) for code in _codes(keypose.topology.polygons[number].color)] for number in origin])
    shades.flags.writeable = False
    mirror = _mirrored(cut, parts, len(source)) if keypose.mirror else np.full(len(source), -1)
    return Skin(topology, shades, point[source], sign[source], mirror)


def split_left(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """(V,) how much of what the left half does each vertex takes part in, of places x, m: a half on the midline."""
    width = max(float(np.abs(x).max(initial=0.0)), 1e-6)
    return exact.smoothstep(0.5 + x / (2.0 * BLEND_SHARE * width))


NEAR_CODES = 24
"""Colours that differ by no more than this in red, green and blue, of 255, flow into one another."""

BLEND_SHARE = 0.12
"""Half the width of the strip in which the halves share what one of them does, as a share of half the face's width."""


def _polygons(keypose: Keypose) -> tuple[list[list[int]], list[int], list[Part]]:
    """Vertices of all polygons, the polygon of the file that each is, the parts; of a part the half, then its image."""
    twin = _twins(keypose)
    rows: list[list[int]] = []
    origin: list[int] = []
    parts: list[Part] = []
    start = 0
    for part in keypose.topology.parts:
        first, numbers = len(rows), range(start, start + len(part.polygons))
        left = [[number - 1 for number in polygon.points] for polygon in part.polygons]
        rows += [row[::-1] for row in left]
        origin += numbers
        if keypose.mirror:
            rows += [[int(twin[number]) for number in row] for row in left]
            origin += numbers
        if len(rows) > first:
            parts.append(Part(part.name, first, len(rows), part.material))
        start += len(part.polygons)
    return rows, origin, parts


def _twins(keypose: Keypose) -> Ints:
    """(N,) vertex of the mirror image of each point; its own on the midline, and where nothing is mirrored."""
    twin = np.arange(keypose.topology.point_count)
    if keypose.mirror:
        aside = np.flatnonzero(~keypose.on_midline)
        twin[aside] = len(twin) + np.arange(len(aside))
    return twin


def _corners(rows: Sequence[Sequence[int]], edges: Sequence[tuple[int, int]], source: Ints) -> Ints:
    """(K, 2) rows of ``Topology.creases`` that keep what doubles a vertex together where creases branch or run out.

    There the curves along which the surface is cut would turn into different curves on their two sides.
    """
    sides: dict[frozenset[int], int] = {}
    for row in rows:
        for pair in zip(row, [*row[1:], row[0]], strict=True):
            sides[frozenset(pair)] = sides.get(frozenset(pair), 0) + 1
    creased = {frozenset(edge) for edge in edges}
    sharp: dict[int, int] = {}
    for edge in creased | {edge for edge, count in sides.items() if count == 1}:
        for vertex in edge:
            sharp[vertex] = sharp.get(vertex, 0) + 1
    kept = [vertex for vertex in sorted({v for edge in creased for v in edge}) if sharp[vertex] > 2]
    numbers = np.flatnonzero(np.isin(source, kept))
    return np.stack([numbers, numbers], axis=1)


def _tints(keypose: Keypose, rows: Sequence[Sequence[int]], origin: Sequence[int]) -> Ints | None:
    """(F,) a number for polygons whose colours flow into one another, -1 for others; None if none do.

    Neighbours of one part whose colours are nearly the same have one number, and so on from neighbour to neighbour.
    """
    topology = keypose.topology
    part = [number for number, part in enumerate(topology.parts) for _ in part.polygons]
    flows = [topology.parts[part[number]].blend for number in origin]
    if not any(flows):
        return None
    codes = [_codes(topology.polygons[number].color) for number in origin]
    at_edge: dict[frozenset[int], list[int]] = {}
    for number, row in enumerate(rows):
        for edge in edges_of(row) if flows[number] else ():
            at_edge.setdefault(edge, []).append(number)
    tints = [number if flow else -1 for number, flow in enumerate(flows)]
    near = [
        (one, other)
        for one, other in (pair for around in at_edge.values() for pair in combinations(around, 2))
        if part[origin[one]] == part[origin[other]]
        and max(abs(a - b) for a, b in zip(codes[one], codes[other], strict=True)) <= NEAR_CODES
    ]
    changed = True
    while changed:
        changed = False
        for one, other in near:
            if tints[one] != tints[other]:
                tints[one] = tints[other] = min(tints[one], tints[other])
                changed = True
    return np.array(tints)


def _mirrored(cut: Sequence[Sequence[int]], parts: Sequence[Part], count: int) -> Ints:
    """(V,) of vertices, from the polygons: the image of a polygon goes around it the other way."""
    mirror = np.zeros(count, dtype=np.int64)
    for part in parts:
        half = (part.last - part.first) // 2
        for left, right in zip(cut[part.first : part.first + half], cut[part.first + half : part.last], strict=True):
            for one, other in zip(left, right[::-1], strict=True):
                mirror[one], mirror[other] = other, one
    return mirror


@cache
def linear(code: int) -> float:
    """Linear light 0..1 of an sRGB code 0..255."""
    return exact.srgb_to_linear(code / 255.0)


def _codes(color: str) -> list[int]:
    return [int(color[k : k + 2], 16) for k in (1, 3, 5)]
