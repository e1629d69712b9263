"""Where a closed outline crosses itself."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

PAIRS = 1 << 18
"""Pairs of edges that are compared at once."""

NEAR = 1e-9
"""Share of the outline's extent below which a vertex lies on an edge."""

_ANGLES = np.arange(4) * (np.pi / 4.0)
DIRECTIONS = np.stack([np.cos(_ANGLES), np.sin(_ANGLES)], axis=1)
"""(4, 2) in which the extents of edges are compared, besides along and across most of them."""


@dataclass(frozen=True)
class Crossing:
    """Two edges, each from the vertex of its number to the next, and where they cross."""

    first: int
    second: int
    at: tuple[float, float]


def find_crossings(outline: Floats) -> Iterator[Crossing]:
    """Crossings of a closed outline (N, 2) with itself; parts that only touch or lie on one another do not cross.

    Only edges are compared whose extents overlap in several directions: first in the one in which the fewest do.
    """
    kept = np.flatnonzero((outline != np.roll(outline, 1, axis=0)).any(axis=1))
    points, edges = outline[kept], [int(number) % len(outline) for number in np.roll(kept, -1) - 1]
    if len(points) < 4:
        return
    near = NEAR * float(np.ptp(points, axis=0).max())
    for first, second in _pairs(points, near):
        a, b, c, d = points[first], _next(points, first), points[second], _next(points, second)
        sides = np.stack([_side(a, b, c), _side(a, b, d), _side(c, d, a), _side(c, d, b)])
        clear = (np.abs(sides) > near).all(axis=0)
        across = clear & (sides[0] * sides[1] < 0.0) & (sides[2] * sides[3] < 0.0)
        # Where an end of one edge lies on the other one, what comes before and after decides.
        beyond = (sides[0] * sides[1] > 0.0) | (sides[2] * sides[3] > 0.0)
        for number in np.flatnonzero(across | (~clear & ~beyond)):
            one, other = int(first[number]), int(second[number])
            at = (
                _meeting(*(each[number] for each in (a, b, c, d)))
                if across[number]
                else _crossing_vertex(points, one, other, near)
            )
            if at is not None:
                yield Crossing(edges[one], edges[other], at)


def _pairs(points: Floats, near: float) -> Iterator[tuple[Integers, Integers]]:
    """Numbers of the edges of pairs whose extents overlap in all directions, the lower number first."""
    directions = np.concatenate([_main_directions(points), DIRECTIONS])
    ends = np.stack([points, np.roll(points, -1, axis=0)]) @ directions.T
    low, high = ends.min(axis=0) - near, ends.max(axis=0) + near
    orders = np.argsort(low, axis=0, kind="stable")
    until = [np.searchsorted(low[order, axis], high[order, axis], "right") for axis, order in enumerate(orders.T)]
    best = int(np.argmin([each.sum() for each in until]))
    order, counts = orders[:, best], until[best] - np.arange(1, len(points) + 1)
    starts = np.concatenate([[0], np.cumsum(counts)])
    begin = 0
    while begin < len(order):
        end = max(int(np.searchsorted(starts, starts[begin] + PAIRS, "right")) - 1, begin + 1)
        rows = np.repeat(np.arange(begin, end), counts[begin:end])
        one, other = order[rows], order[rows + 1 + np.arange(len(rows)) - (starts[rows] - starts[begin])]
        for axis in range(len(directions)):
            overlap = (low[one, axis] <= high[other, axis]) & (low[other, axis] <= high[one, axis])
            one, other = one[overlap], other[overlap]
        first, second = np.minimum(one, other), np.maximum(one, other)
        apart = (second - first > 1) & (second - first < len(points) - 1)
        yield first[apart], second[apart]
        begin = end


def _main_directions(points: Floats) -> Floats:
    """(2, 2) along and across the edges, longer ones counting more; opposite directions are the same."""
    along = np.roll(points, -1, axis=0) - points
    double = np.arctan2(2.0 * (along[:, 0] * along[:, 1]).sum(), (along[:, 0] ** 2 - along[:, 1] ** 2).sum())
    cosine, sine = np.cos(0.5 * double), np.sin(0.5 * double)
    return np.array([[-sine, cosine], [cosine, sine]])


def _next(points: Floats, numbers: Integers) -> Floats:
    return points[(numbers + 1) % len(points)]


def _side(start: Floats, end: Floats, point: Floats) -> Floats:
    """Distance (N,) of points (N, 2) from the lines through edges; above 0 on one side."""
    along, way = end - start, point - start
    return (along[:, 0] * way[:, 1] - along[:, 1] * way[:, 0]) / np.sqrt((along * along).sum(axis=1))


def _meeting(a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[float, float]:
    along, other, way = b - a, d - c, c - a
    share = (way[0] * other[1] - way[1] * other[0]) / (along[0] * other[1] - along[1] * other[0])
    x, y = a + share * along
    return float(x), float(y)


def _crossing_vertex(points: Floats, first: int, second: int, near: float) -> tuple[float, float] | None:
    """The vertex at the end of one of two edges that lies on the other one, if there the outline goes across itself."""
    count = len(points)
    for one, other in ((first, second), (second, first)):
        vertex, start, end = points[(one + 1) % count], points[other], points[(other + 1) % count]
        # Where it is the start of the other edge, the edge before that tells of it.
        if _same(vertex, start, near) or not _on_edge(vertex, start, end, near):
            continue
        beyond = points[(other + 2) % count] if _same(vertex, end, near) else end
        if _goes_across(vertex, points[one], points[(one + 2) % count], start, beyond):
            return float(vertex[0]), float(vertex[1])
    return None


def _same(one: Floats, other: Floats, near: float) -> bool:
    return bool(np.abs(one - other).max() <= near)


def _on_edge(vertex: Floats, start: Floats, end: Floats, near: float) -> bool:
    along, way = end - start, vertex - start
    length = float(np.sqrt(along @ along))
    inside = -near * length <= float(along @ way) <= (length + near) * length
    return inside and abs(float(along[0] * way[1] - along[1] * way[0])) <= near * length


def _goes_across(vertex: Floats, before: Floats, after: Floats, other: Floats, beyond: Floats) -> bool:
    """Whether of the four directions out of a vertex those of one strand separate those of the other."""
    angles = [np.arctan2(*(point - vertex)[::-1]) for point in (before, after, other, beyond)]
    turn = [(angle - angles[0]) % (2.0 * np.pi) for angle in angles[1:]]
    if min(abs(turn[1] - turn[0]), abs(turn[2] - turn[0]), *turn[1:]) < 1e-9:
        return False
    return bool((turn[1] < turn[0]) != (turn[2] < turn[0]))
