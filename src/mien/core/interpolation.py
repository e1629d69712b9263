"""Subdivision surfaces that pass through given points: the cage is moved until its limit surface does.

Source: Halstead, Kass and DeRose 1993, Efficient, fair interpolation using Catmull-Clark surfaces (limit positions as
weighted means of a vertex and those around it, and the linear system for the cage).
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from . import exact
from .mesh import Topology
from .sparse import SparseMatrix, sort_pairs
from .subdivision import CORNER, refine

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

LEAST, MOST = 0.08, 1.2
"""Eigenvalues of the weights of the limit: those of a regular mesh lie between 1/9 and 1, and seldom others beyond."""

ROUND = 8
"""Steps of a round; their lengths shrink what is missing most evenly between ``LEAST`` and ``MOST``."""

NEAR_M = 1e-7
"""The surface passes that close to the points."""

MOST_ROUNDS = 40

ENOUGH = 0.9
"""A round that leaves more than this share of what was missing is not worth moving the cage: where no surface passes
through the points, it would go on without end."""


@lru_cache(maxsize=8)
def limit_of(topology: Topology) -> SparseMatrix:
    """(V, V) where the vertices of a cage come to lie when it is subdivided without end; vertices of other parts stay.

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
    return means.after(step.matrix)


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

    Source: Richardson's iteration with the lengths of Chebyshev (Golub and Varga 1961): products only, so that every
    machine finds the same bits.
    """
    limit, lengths = limit_of(topology), _lengths()
    best, least = points, _most(points - limit.apply(points))
    for _ in range(MOST_ROUNDS):
        if least <= NEAR_M:
            break
        cage = best
        for length in lengths:
            cage = cage + length * (points - limit.apply(cage))
        missed = _most(points - limit.apply(cage))
        if not missed < ENOUGH * least:
            break
        best, least = cage, missed
    return best, least


def _most(values: Floats) -> float:
    return float(np.abs(values).max(initial=0.0))


def _lengths() -> list[float]:
    """The steps of a round: one divided by each zero of a Chebyshev polynomial between ``LEAST`` and ``MOST``.

    Long steps and short ones take turns, so that rounding does not grow.
    """
    angles = math.pi * (2.0 * np.arange(ROUND) + 1.0) / (2.0 * ROUND)
    zeros = 0.5 * (MOST + LEAST) + 0.5 * (MOST - LEAST) * exact.cos(angles)
    order = [k for pair in zip(range(ROUND // 2), range(ROUND - 1, -1, -1), strict=False) for k in pair]
    return [1.0 / float(zeros[k]) for k in order]
