"""Catmull-Clark subdivision as one constant sparse matrix, with crease and boundary rules.

Parts whose material says ``subdivide`` are refined; the points of all other parts pass through. The matrix depends
on the topology alone, so it is made once and applied to points, colours and anything else that belongs to a vertex.

Source: Catmull and Clark 1978; boundary and crease rules after Hoppe et al. 1994 and DeRose et al. 1998 (sharp
edges: cubic B-spline curves; a vertex where one, or more than two, sharp edges end: dart, corner).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from .mesh import Mesh, Part, Topology
from .sparse import SparseMatrix, sort_pairs
from .tinting import tinting_of

Ints = NDArray[np.int64]
Multiply = Callable[[SparseMatrix, Sequence[NDArray[np.float64]]], Sequence[NDArray[np.float64]]]


CORNER = 3
"""Sharp edges that make a vertex a corner."""


@dataclass(frozen=True, eq=False)
class Refinement:
    """A finer topology and how its values come from the coarse ones.

    Attributes:
        topology: the finer one.
        matrix: (V', V), makes its vertex values.
        polygon_parent: (F',) the polygon that each of its polygons comes from.
        tinting: (F', F), makes its polygons' colours where some flow into one another; None if none do.
    """

    topology: Topology
    matrix: SparseMatrix
    polygon_parent: Ints
    tinting: SparseMatrix | None = None

    def tint(self, colors: NDArray[np.float64]) -> NDArray[np.float64]:
        """(F', 3) colours of its polygons, of coarse ones (F, 3)."""
        return colors[self.polygon_parent] if self.tinting is None else self.tinting.apply(colors)


def apply_to_each(matrix: SparseMatrix, values: Sequence[NDArray[np.float64]]) -> Sequence[NDArray[np.float64]]:
    """The products of a matrix with several values (C, 3)."""
    return [matrix.apply(each) for each in values]


def subdivide(mesh: Mesh, levels: int, multiply: Multiply = apply_to_each) -> Mesh:
    """The mesh with the parts that ask for it refined ``levels`` times; colours follow the same rules.

    Args:
        mesh: what to refine.
        levels: how many times.
        multiply: products of a matrix and one or two values (C, 3); a renderer brings compiled ones of the same bits.
    """
    for _ in range(levels):
        fine = refine(mesh.topology)
        if mesh.colored_by_polygon:
            (points,), colors = multiply(fine.matrix, (mesh.points,)), fine.tint(mesh.colors)
        else:
            points, colors = multiply(fine.matrix, (mesh.points, mesh.colors))
        normals = None if mesh.normals is None else _keep_rows(mesh.normals, fine.topology.vertex_count)
        mesh = Mesh(fine.topology, points, colors, normals, mesh.colored_by_polygon)
    return mesh


def _keep_rows(values: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    # Old vertices keep their numbers, and a round part is never subdivided: its normals just move along.
    out = np.zeros((count, values.shape[1]))
    out[: len(values)] = values
    return out


@lru_cache(maxsize=8)
def refine(topology: Topology) -> Refinement:
    """One step of refinement. New vertices follow the old ones: first one a polygon, then one an edge."""
    chosen = np.array([part.material.subdivide for part in topology.parts], dtype=bool)[topology.part_of_polygon]
    corner_chosen = chosen[topology.polygon_of_corner]
    start = topology.corners[corner_chosen]
    end = topology.corners[topology.next_corner][corner_chosen]
    polygon = topology.polygon_of_corner[corner_chosen]

    count = topology.vertex_count
    face_number = np.full(topology.polygon_count, -1, dtype=np.int64)
    face_number[chosen] = np.arange(int(chosen.sum()))
    face = face_number[polygon]
    face_size = np.diff(topology.starts)[chosen]
    face_vertex = count + face
    edges, edge = _edges(start, end)
    face_count, edge_count = len(face_size), len(edges)
    edge_vertex = count + face_count + edge

    faces_of_edge = np.bincount(edge, minlength=edge_count)
    creased = np.isin(_keys(edges, count), _keys(np.sort(topology.creases, axis=1), count))
    kept = topology.creases[topology.creases[:, 0] == topology.creases[:, 1]]
    sharp = (faces_of_edge != 2) | creased

    entries = _Entries()
    touched = np.zeros(count, dtype=bool)
    touched[start] = True
    still = np.flatnonzero(~touched)
    entries.add(still, still, np.ones(len(still)))
    _face_points(entries, face_vertex, start, face_size[face])
    _edge_points(entries, count + face_count + np.arange(edge_count), edges, edge, face, face_size, start, sharp)
    _vertex_points(entries, count, edges, sharp, start, face, face_size, kept[:, 0])

    total = count + face_count + edge_count
    matrix = SparseMatrix.from_entries(*entries.arrays(), shape=(total, count))
    middle = count + face_count + np.flatnonzero(creased)
    creases = np.stack([edges[creased, 0], middle, middle, edges[creased, 1]], axis=1).reshape(-1, 2)
    creases = np.concatenate([creases, kept])
    fine, parents = _fine_topology(topology, corner_chosen, face_vertex, edge_vertex, total, creases)
    if topology.tints is None:
        return Refinement(fine, matrix, parents)
    return Refinement(
        replace(fine, tints=topology.tints[parents]), matrix, parents, tinting_of(topology, fine, parents)
    )


def _edges(start: Ints, end: Ints) -> tuple[Ints, Ints]:
    """(E, 2) edges, lower vertex first, in order, and the edge (C,) that starts at each corner."""
    low, high = np.minimum(start, end), np.maximum(start, end)
    order, new = sort_pairs(low, high)
    edge = np.empty(len(order), dtype=np.int64)
    edge[order] = np.cumsum(new) - 1
    first = order[new]
    return np.stack([low[first], high[first]], axis=1), edge


def _keys(pairs: Ints, count: int) -> Ints:
    """A number for each pair (E, 2) of vertices below ``count``."""
    return pairs[:, 0] * count + pairs[:, 1]


class _Entries:
    """Collects (row, column, weight)."""

    def __init__(self) -> None:
        self.rows: list[Ints] = []
        self.columns: list[Ints] = []
        self.weights: list[NDArray[np.float64]] = []

    def add(self, rows: Ints, columns: Ints, weights: NDArray[np.float64]) -> None:
        self.rows.append(rows)
        self.columns.append(columns)
        self.weights.append(weights)

    def arrays(self) -> tuple[Ints, Ints, NDArray[np.float64]]:
        return np.concatenate(self.rows), np.concatenate(self.columns), np.concatenate(self.weights)


def _face_points(entries: _Entries, vertex: Ints, start: Ints, size: Ints) -> None:
    entries.add(vertex, start, 1.0 / size)


def _edge_points(
    entries: _Entries,
    vertex: Ints,
    edges: Ints,
    edge: Ints,
    face: Ints,
    face_size: Ints,
    start: Ints,
    sharp: NDArray[np.bool_],
) -> None:
    ends = np.where(sharp, 0.5, 0.25)
    for column in (0, 1):
        entries.add(vertex, edges[:, column], ends)
    smooth = ~sharp[edge]
    sides = face[smooth]
    rows, columns = _spread(vertex[edge[smooth]], sides, face_size, start)
    entries.add(rows, columns, np.repeat(0.25 / face_size[sides], face_size[sides]))


def _vertex_points(
    entries: _Entries,
    count: int,
    edges: Ints,
    sharp: NDArray[np.bool_],
    start: Ints,
    face: Ints,
    face_size: Ints,
    kept: Ints,
) -> None:
    sharp_edges = np.bincount(edges[sharp].ravel(), minlength=count)
    sharp_edges[kept] = CORNER
    valence = np.bincount(edges.ravel(), minlength=count)
    touched = np.flatnonzero(valence)

    crease = sharp_edges == 2
    corner = (sharp_edges > 2) & (valence > 0)
    smooth = (sharp_edges < 2) & (valence > 0)

    corners = np.flatnonzero(corner)
    entries.add(corners, corners, np.ones(len(corners)))
    creases = np.flatnonzero(crease)
    entries.add(creases, creases, np.full(len(creases), 0.75))
    for a, b in ((0, 1), (1, 0)):
        pairs = edges[sharp & crease[edges[:, a]]]
        entries.add(pairs[:, a], pairs[:, b], np.full(len(pairs), 0.125))

    # Smooth: Q/n + 2R/n + (n - 3)S/n with Q the mean of face points, R the mean of edge midpoints.
    n = valence.astype(np.float64)
    inside = touched[smooth[touched]]
    entries.add(inside, inside, (n[inside] - 3.0) / n[inside])
    for a, b in ((0, 1), (1, 0)):
        pairs = edges[smooth[edges[:, a]]]
        weight = 1.0 / (n[pairs[:, a]] ** 2)
        entries.add(pairs[:, a], pairs[:, a], weight)
        entries.add(pairs[:, a], pairs[:, b], weight)
    vertices, around = start[smooth[start]], face[smooth[start]]
    rows, columns = _spread(vertices, around, face_size, start)
    entries.add(rows, columns, np.repeat(1.0 / (n[vertices] ** 2 * face_size[around]), face_size[around]))


def _spread(rows: Ints, faces: Ints, face_size: Ints, start: Ints) -> tuple[Ints, Ints]:
    """Each row paired with every corner of its face: (row, vertex) arrays."""
    first = np.cumsum(face_size) - face_size
    sizes = face_size[faces]
    within = np.arange(int(sizes.sum())) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    return np.repeat(rows, sizes), start[np.repeat(first[faces], sizes) + within]


def _fine_topology(
    topology: Topology,
    corner_chosen: NDArray[np.bool_],
    face_vertex: Ints,
    edge_vertex: Ints,
    total: int,
    creases: Ints,
) -> tuple[Topology, Ints]:
    """The finer topology and the polygon (F',) that each of its polygons comes from.

    Args:
        topology: the coarse one.
        corner_chosen: (C,) whether a corner belongs to a polygon that is refined.
        face_vertex: for each such corner the new vertex in its polygon.
        edge_vertex: for each such corner the new vertex on the edge that starts there.
        total: number of vertices of the finer topology.
        creases: (K, 2) its creases.
    """
    before = np.full(len(topology.corners), -1, dtype=np.int64)
    before[topology.next_corner] = np.arange(len(topology.corners))
    edge_of_corner = np.full(len(topology.corners), -1, dtype=np.int64)
    edge_of_corner[corner_chosen] = edge_vertex
    face_of_corner = np.full(len(topology.corners), -1, dtype=np.int64)
    face_of_corner[corner_chosen] = face_vertex

    corners: list[Ints] = []
    sizes: list[Ints] = []
    parents: list[Ints] = []
    parts: list[Part] = []
    first = 0
    for part in topology.parts:
        span = np.arange(topology.starts[part.first], topology.starts[part.last])
        if part.material.subdivide:
            quads = np.stack(
                [
                    topology.corners[span],
                    edge_of_corner[span],
                    face_of_corner[span],
                    edge_of_corner[before[span]],
                ],
                axis=1,
            )
            corners.append(quads.reshape(-1))
            sizes.append(np.full(len(quads), 4))
            parents.append(topology.polygon_of_corner[span])
        else:
            corners.append(topology.corners[span])
            sizes.append(np.diff(topology.starts[part.first : part.last + 1]))
            parents.append(np.arange(part.first, part.last))
        parts.append(Part(part.name, first, first + len(sizes[-1]), part.material))
        first += len(sizes[-1])
    starts = np.concatenate([[0], np.cumsum(np.concatenate(sizes))]).astype(np.int64)
    fine = Topology(total, np.concatenate(corners), starts, tuple(parts), creases.astype(np.int64))
    return fine, np.concatenate(parents)
