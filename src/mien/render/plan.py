"""What can be said about lighting a topology before any point is known: where shades are needed, and what decides them.

A *node* is a place that gets a shade: a vertex as one part sees it, or a whole polygon where polygons are flat.
Vertices shared by two parts are two nodes. A two-sided part has its nodes twice, for its front and for its back.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from mien.core import Topology
from mien.core.sparse import SparseMatrix, sort_pairs, stable_order

Ints = NDArray[np.int64]
Ints32 = NDArray[np.int32]
Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Plan:
    """The constant part of lighting a topology.

    Attributes:
        by_size: polygons grouped by their number of corners: ((n,) polygon numbers, (n, size) vertex numbers).
        vertex: (N,) vertex of a node, -1 where the node is a polygon.
        polygon: (N,) polygon of a flat node, -1 where the node is a vertex.
        normal_sum: sums of polygon normals, one row a node.
        round: numbers of the nodes whose normal is the mesh's own.
        back: (M,) nodes that are lit once more from behind; their shades follow the N front ones.
        triangles: (3, T) vertices of the polygons cut into triangles.
        triangle_front: (T, 3) shades of their corners seen from the front.
        triangle_back: (T, 3) shades of their corners seen from behind.
        lit: (N + M,) whether the light falls on it.
        gloss: (N + M,) strength of its highlight.
        power: (N + M,) sharpness of its highlight.
        two_sided: (F,) whether a polygon's back is drawn.
        triangle_two_sided: (T,) the same of triangles.
        neighbours: (T, 3) triangle beyond the edge that follows each corner, where both are of one surface; else -1.
        columns: the same a node, for compiled code: vertex, polygon, back shade or -1, lit, round, gloss, power.
    """

    by_size: tuple[tuple[Ints, Ints], ...]
    vertex: Ints
    polygon: Ints
    normal_sum: SparseMatrix
    round: Ints
    back: Ints
    triangles: Ints
    triangle_front: Ints32
    triangle_back: Ints32
    lit: NDArray[np.bool_]
    gloss: Floats
    power: Ints
    two_sided: NDArray[np.bool_]
    triangle_two_sided: NDArray[np.bool_]
    neighbours: Ints32
    columns: tuple[NDArray[np.generic], ...]


@lru_cache(maxsize=8)
def plan_shading(topology: Topology, flat: bool, colored_by_polygon: bool = False) -> Plan:
    """The plan of a topology; ``flat`` makes every polygon flat, and both that or a colour of its own set it apart."""
    vertices: list[Ints] = []
    polygons: list[Ints] = []
    rows: list[Ints] = []
    columns: list[Ints] = []
    materials: list[Ints] = []
    corner_node = np.empty(len(topology.corners), dtype=np.int64)
    count = 0
    for number, part in enumerate(topology.parts):
        span = np.arange(topology.starts[part.first], topology.starts[part.last])
        inside = np.arange(part.first, part.last)
        owner = topology.polygon_of_corner[span]
        if flat or part.material.flat:
            corner_node[span] = count + owner - part.first
            vertices.append(np.full(len(inside), -1))
            polygons.append(inside)
            rows.append(count + inside - part.first)
            columns.append(inside)
        else:
            # ``np.unique`` would import another part of NumPy, at every start.
            in_part = np.zeros(topology.vertex_count, dtype=bool)
            in_part[topology.corners[span]] = True
            used, place = np.flatnonzero(in_part), np.cumsum(in_part) - 1
            corner_node[span] = count + place[topology.corners[span]]
            vertices.append(used)
            polygons.append(np.full(len(used), -1))
            rows.append(corner_node[span])
            columns.append(owner)
        materials.append(np.full(len(vertices[-1]), number))
        count += len(vertices[-1])
    row, column = _join(rows), _join(columns)
    total = SparseMatrix.from_entries(row, column, np.ones(len(row)), (count, topology.polygon_count))
    vertex, material = _join(vertices), _join(materials)
    sided = np.array([part.material.two_sided for part in topology.parts], dtype=bool)
    own = np.array([part.material.round for part in topology.parts], dtype=bool)
    back = np.flatnonzero(sided[material])
    back_node = np.arange(count)
    back_node[back] = count + np.arange(len(back))
    shade_material = np.concatenate([material, material[back]])
    gloss = np.array([part.material.gloss for part in topology.parts])[shade_material]
    power = np.array([part.material.gloss_power for part in topology.parts], dtype=np.int64)[shade_material]
    lit = np.array([part.material.lit for part in topology.parts], dtype=bool)[shade_material]
    behind = np.where(sided[material], back_node, -1)
    polygon, is_round = _join(polygons), own[material] & (vertex >= 0)
    return Plan(
        by_size=_group_by_size(topology),
        vertex=vertex,
        polygon=polygon,
        normal_sum=total,
        round=np.flatnonzero(is_round),
        back=back,
        triangles=np.ascontiguousarray(topology.triangles.T),
        triangle_front=corner_node[topology.triangle_corners].astype(np.int32),
        triangle_back=back_node[corner_node[topology.triangle_corners]].astype(np.int32),
        lit=lit,
        gloss=gloss,
        power=power,
        two_sided=sided[topology.part_of_polygon],
        neighbours=_find_neighbours(topology, flat, colored_by_polygon),
        triangle_two_sided=sided[topology.part_of_polygon[topology.polygon_of_triangle]],
        columns=(vertex, polygon, behind, lit[:count], is_round, gloss[:count], power[:count]),
    )


def _find_neighbours(topology: Topology, flat: bool, colored_by_polygon: bool) -> Ints32:
    """(T, 3) as in ``Plan``; an edge that three triangles share has none.

    A polygon that is flat, or has a colour of its own that does not flow into others, is a surface by itself.
    """
    parts, polygons = len(topology.parts), topology.polygon_count
    part, alone = topology.part_of_polygon, np.arange(parts, parts + polygons)
    surface = alone if flat or colored_by_polygon else part
    if colored_by_polygon and not flat and topology.tints is not None:
        surface = np.where(topology.tints >= 0, parts + polygons + topology.tints, alone)
    flat_part = np.array([each.material.flat for each in topology.parts], dtype=bool)
    surface = np.where(flat_part[part], alone, surface)
    ends = np.stack([topology.triangles, np.roll(topology.triangles, -1, axis=1)]).reshape(2, -1)
    low, high = ends.min(axis=0), ends.max(axis=0)
    surface = np.repeat(surface[topology.polygon_of_triangle], 3)
    order, _ = sort_pairs(low, high)
    order = order[stable_order(surface[order])]
    keys = [values[order] for values in (surface, low, high)]
    same = np.zeros(len(order) + 1, dtype=bool)
    same[1:-1] = np.logical_and.reduce([key[1:] == key[:-1] for key in keys])
    first = np.flatnonzero(same[1:-1] & ~same[:-2] & ~same[2:])
    neighbours = np.full(len(order), -1, dtype=np.int32)
    neighbours[order[first]], neighbours[order[first + 1]] = order[first + 1] // 3, order[first] // 3
    return neighbours.reshape(-1, 3)


def _join(arrays: list[Ints]) -> Ints:
    return np.concatenate(arrays).astype(np.int64) if arrays else np.zeros(0, dtype=np.int64)


def _group_by_size(topology: Topology) -> tuple[tuple[Ints, Ints], ...]:
    sizes = np.diff(topology.starts)
    groups = []
    for size in np.flatnonzero(np.bincount(sizes)):
        inside = np.flatnonzero(sizes == size)
        groups.append((inside, topology.corners[topology.starts[inside][:, None] + np.arange(size)]))
    return tuple(groups)
