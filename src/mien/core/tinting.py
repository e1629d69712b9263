"""Colours of polygons that flow into one another when the polygons are subdivided.

A colour belongs to a polygon as a point belongs to a vertex of the dual mesh, and so it is refined as the dual mesh is.

Source: Doo and Sabin 1978, in the averaging form (on a regular mesh 9, 3, 3 and 1 sixteenths: quadratic B-splines).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .mesh import Topology
from .sparse import SparseMatrix, sort_pairs

Ints = NDArray[np.int64]


def tinting_of(topology: Topology, fine: Topology, parents: Ints) -> SparseMatrix:
    """(F', F) weights that make the colours of finer polygons (F') of coarse ones.

    A finer polygon lies in a corner of a coarse one. Its colour is the mean of four: of the coarse polygon, of this
    and its neighbour across either edge of the corner, and of all around the vertex, those of another tint left out.

    Args:
        topology: the coarse one, with tints.
        fine: the finer one; the polygons of what is subdivided come corner after corner.
        parents: (F',) the coarse polygon of each.
    """
    polygon, vertex, following = topology.polygon_of_corner, topology.corners, topology.next_corner
    tint = np.full(len(vertex), -1) if topology.tints is None else topology.tints[polygon]
    before = np.empty_like(following)
    before[following] = np.arange(len(following))
    low, high = np.minimum(vertex, vertex[following]), np.maximum(vertex, vertex[following])
    edge, place = _numbered(low * topology.vertex_count + high, tint), _numbered(vertex, tint)

    corner, child = np.flatnonzero(_divided(topology)[polygon]), np.flatnonzero(_divided(fine))
    whole = np.flatnonzero(~_divided(fine))
    rows, columns = [whole, child], [parents[whole], polygon[corner]]
    weights = [np.ones(len(whole)), np.full(len(child), 0.25)]
    for groups, chosen in ((edge, corner), (edge, before[corner]), (place, corner)):
        some, members, share = _members(groups, groups[chosen])
        rows.append(child[some])
        columns.append(polygon[members])
        weights.append(0.25 * share)
    size = (fine.polygon_count, topology.polygon_count)
    return SparseMatrix.from_entries(np.concatenate(rows), np.concatenate(columns), np.concatenate(weights), size)


def _divided(topology: Topology) -> NDArray[np.bool_]:
    """(F,) which polygons are subdivided."""
    return np.array([part.material.subdivide for part in topology.parts], dtype=bool)[topology.part_of_polygon]


def _numbered(keys: Ints, tint: Ints) -> Ints:
    """(C,) a number for each pair of key and tint; corners without tint have one of their own."""
    order, new = sort_pairs(keys, np.where(tint >= 0, tint, -1 - np.arange(len(tint))))
    numbers = np.empty(len(keys), dtype=np.int64)
    numbers[order] = np.cumsum(new) - 1
    return numbers


def _members(groups: Ints, chosen: Ints) -> tuple[Ints, Ints, NDArray[np.float64]]:
    """Members (M,) of some chosen groups (K,): of which of the K, which corner, and one divided by their number.

    Corners (C,) belong to ``groups``.
    """
    order, counts = np.argsort(groups, kind="stable"), np.bincount(groups)
    first, sizes = (np.cumsum(counts) - counts)[chosen], counts[chosen]
    some = np.repeat(np.arange(len(chosen)), sizes)
    within = np.arange(int(sizes.sum())) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    return some, order[np.repeat(first, sizes) + within], np.repeat(1.0 / sizes, sizes)
