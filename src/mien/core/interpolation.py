"""Subdivision surfaces that pass through given points: the cage is moved until its limit surface does.

Source: Halstead, Kass and DeRose 1993, Efficient, fair interpolation using Catmull-Clark surfaces (limit positions as
weighted means of a vertex and those around it, and the linear system for the cage).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from .mesh import Topology
from .sparse import SparseMatrix, sort_pairs
from .subdivision import CORNER, Refinement, refine

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

STEP = 1.5
"""Share of what is missing that a round adds: the rounds shrink what is missing while the weights of the limit have
eigenvalues between 0 and 4/3; those of a regular mesh lie between 1/9 and 1."""

NEAR_M = 1e-9
"""The surface passes that close to the points."""

MOST_ROUNDS = 400

ENOUGH = 0.99
"""A round that leaves more than this share of what was missing is not worth moving the cage further: where no surface
passes through the points, it would go on without end."""


@dataclass(frozen=True, eq=False)
class Limit:
    """Where the vertices of a cage come to lie when it is subdivided without end.

    Attributes:
        step: one step of subdivision.
        means: (V, V') limit positions as means of the points of that step.
    """

    step: Refinement
    means: SparseMatrix

    def apply(self, values: Floats) -> Floats:
        """(V, K) limits of vertex values (V, K)."""
        return self.means.apply(self.step.matrix.apply(values))


@lru_cache(maxsize=8)
def limit_of(topology: Topology) -> Limit:
    """The limit of a topology, of the parts that are subdivided; other vertices stay.

    It is exact where no single sharp edge ends at a vertex.
    """
    step = refine(topology)
    fine, count = step.topology, topology.vertex_count
    chosen = np.array([part.material.subdivide for part in fine.parts], dtype=bool)[fine.part_of_polygon]
    quads = fine.corners[chosen[fine.polygon_of_corner]].reshape(-1, 4)
    vertex, beside, across = quads[:, 0], quads[:, (1, 3)], quads[:, 2]
    ends, sharp = _edges(np.repeat(vertex, 2), beside.ravel(), fine)
    valence = np.bincount(ends[:, 0], minlength=count)
    sharp_edges = np.bincount(ends[sharp, 0], minlength=count)
    sharp_edges[topology.creases[topology.creases[:, 0] == topology.creases[:, 1], 0]] = CORNER

    crease = sharp_edges == 2
    smooth = (sharp_edges < 2) & (valence > 0)
    own = np.where(smooth, valence / (valence + 5.0), np.where(crease, 4.0 / 6.0, 1.0))
    weight = 1.0 / np.maximum(valence * (valence + 5.0), 1.0)
    every = np.arange(count)
    edge, face = smooth[ends[:, 0]], smooth[vertex]
    curve = sharp & crease[ends[:, 0]]
    rows = [every, ends[edge, 0], vertex[face], ends[curve, 0]]
    columns = [every, ends[edge, 1], across[face], ends[curve, 1]]
    weights = [own, 4.0 * weight[ends[edge, 0]], weight[vertex[face]], np.full(int(curve.sum()), 1.0 / 6.0)]
    size = (count, fine.vertex_count)
    means = SparseMatrix.from_entries(np.concatenate(rows), np.concatenate(columns), np.concatenate(weights), size)
    return Limit(step, means)


def _edges(first: Ints, second: Ints, fine: Topology) -> tuple[Ints, NDArray[np.bool_]]:
    """(E, 2) the pairs, each once, and whether each is an edge of one polygon only, or a crease."""
    order, new = sort_pairs(first, second)
    starts = np.flatnonzero(new)
    times = np.diff(np.append(starts, len(order)))
    ends = np.stack([first[order[starts]], second[order[starts]]], axis=1)
    keys, count = np.sort(fine.creases, axis=1), fine.vertex_count
    creased = np.isin(ends.min(axis=1) * count + ends.max(axis=1), keys[:, 0] * count + keys[:, 1])
    return ends, (times != 2) | creased


def cage_through(topology: Topology, points: Floats) -> tuple[Floats, float]:
    """Vertices (V, K) of a cage whose limit surface has the points (V, K) at its vertices, and how far it misses.

    The distance is that of the coordinate that is missed most, m. It is below ``NEAR_M`` but for topologies, such as
    two polygons back to back, that no surface can pass through.
    """
    limit = limit_of(topology)
    cage, best, least = points, points, float("inf")
    for _ in range(MOST_ROUNDS):
        missing = points - limit.apply(cage)
        most = float(np.abs(missing).max(initial=0.0))
        if most < ENOUGH * least:
            best, least = cage, most
        if not NEAR_M < most < 1e3:
            break
        cage = cage + STEP * missing
    return best, least
