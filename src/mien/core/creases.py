"""Creases by doubled vertices: each side of a crease gets vertices, and so normals, of its own.

Source: Parke 1972, "Representation of the face"; after Gouraud 1971.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from .errors import MienError

Ints = NDArray[np.int64]


def double_creases(
    polygons: Sequence[Sequence[int]], edges: Iterable[tuple[int, int]], vertex_count: int
) -> tuple[list[list[int]], Ints]:
    """Polygons of any sizes cut open along edges, and the vertex (D,) that each new vertex doubles.

    New vertices are numbered from ``vertex_count`` on. Around each vertex the polygons that still hang together by
    uncut edges share a vertex; where a crease ends they all do, so it fades.

    Raises:
        MienError: an edge is no edge of the polygons, so that some polygon would span the crease.
    """
    rows = [[int(vertex) for vertex in row] for row in polygons]
    cut = {frozenset(edge) for edge in edges}
    sides = {frozenset(pair) for row in rows for pair in zip(row, [*row[1:], row[0]], strict=True)}
    for edge in cut:
        if edge not in sides:
            raise MienError(f"crease {sorted(edge)} is no edge of the polygons: a polygon would span it")
    creased = {vertex for edge in cut for vertex in edge}
    around: dict[int, list[int]] = {vertex: [] for vertex in sorted(creased)}
    for number, row in enumerate(rows):
        for vertex in creased.intersection(row):
            around[vertex].append(number)
    out = [list(row) for row in rows]
    doubled: list[int] = []
    for vertex, polygons_around in around.items():
        groups = _hanging_together(rows, polygons_around, vertex, cut)
        for group in groups[1:]:
            for polygon in group:
                out[polygon][rows[polygon].index(vertex)] = vertex_count + len(doubled)
            doubled.append(vertex)
    return out, np.array(doubled, dtype=np.int64)


def _hanging_together(
    polygons: Sequence[Sequence[int]], around: list[int], vertex: int, cut: set[frozenset[int]]
) -> list[list[int]]:
    """The polygons around a vertex in groups that are joined by uncut edges, lowest polygon first."""
    at_edge: dict[int, list[int]] = {}
    for polygon in around:
        row = polygons[polygon]
        place = row.index(vertex)
        for neighbour in (row[place - 1], row[(place + 1) % len(row)]):
            if frozenset((vertex, neighbour)) not in cut:
                at_edge.setdefault(neighbour, []).append(polygon)
    groups: list[list[int]] = []
    left = list(around)
    while left:
        group, grown = [left.pop(0)], True
        while grown:
            joined = {p for pair in at_edge.values() if set(pair) & set(group) for p in pair} - set(group)
            grown = bool(joined)
            group += sorted(joined)
        left = [polygon for polygon in left if polygon not in group]
        groups.append(sorted(group))
    return groups
