"""Moves of points that were measured, carried on to their neighbours that were not.

Source: Parke 1972, "Data acquisition" (points that photographs hide are estimated from what is near them).
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sl
from numpy.typing import NDArray

from mien.core.mesh import Ints, Points

from .registering import found

Floats = NDArray[np.float64]

LEAST_SIGMA_M = 2e-5
SMOOTH_M, SMOOTH_SHARE = 2e-4, 0.25
"""Deviation of how far neighbours move apart: a constant, and a share of how far apart they lie."""
HELD_M = 0.5
"""Deviation of a move from none at all: what nothing measured leads to stays."""
NOISE = 1.5
"""Moves that are no longer than so many deviations, among their neighbours, are taken for noise."""


def edges_of(polygons: Iterable[tuple[int, ...]]) -> Ints:
    """(E, 2) pairs of points, from 0, that follow one another around some polygon."""
    pairs = {(min(a, b), max(a, b)) for row in polygons for a, b in zip(row, (*row[1:], row[0]), strict=True) if a != b}
    return np.array(sorted(pairs), dtype=np.int64).reshape(-1, 2)


def spread(measured: Points, sigma_m: Floats, edges: Ints, places: Points, loose: Floats | None = None) -> Points:
    """(N, 3) m, the likeliest moves of all points: near the measured ones, and alike between neighbours.

    Args:
        measured: (N, 3) m, nan where nothing was.
        sigma_m: (N,) deviations of the measured ones.
        edges: (E, 2) neighbours.
        places: (N, 3) m, where they lie.
        loose: (E,) factor on how far neighbours may move apart.
    """
    count = len(measured)
    seen = found(measured)
    weight = np.where(seen, 1.0 / np.maximum(np.where(seen, sigma_m, 1.0), LEAST_SIGMA_M) ** 2, 0.0)
    length = np.linalg.norm(places[edges[:, 0]] - places[edges[:, 1]], axis=1)
    deviation = (SMOOTH_M + SMOOTH_SHARE * length) * (1.0 if loose is None else loose)
    stiff = 1.0 / deviation**2
    a, b = edges.T
    between = sp.coo_matrix((stiff, (a, b)), shape=(count, count))
    between = (between + between.T).tocsr()
    own = np.asarray(between.sum(axis=1)).ravel() + weight + 1.0 / HELD_M**2
    right = weight[:, None] * np.where(seen[:, None], measured, 0.0)
    return np.asarray(sl.splu((sp.diags(own) - between).tocsc()).solve(right))


def quieten(moves: Points, sigma_m: Floats, edges: Ints) -> Points:
    """Moves (N, 3) m with those taken back that noise alone explains, together with their neighbours.

    Source: James and Stein 1961 (positive-part shrinkage towards nothing).
    """
    square = (moves**2).sum(axis=1) / 3.0
    total, count = square.copy(), np.ones(len(moves))
    for a, b in (edges.T, edges.T[::-1]):
        np.add.at(total, a, square[b])
        np.add.at(count, a, 1.0)
    noise = (NOISE * np.maximum(sigma_m, LEAST_SIGMA_M)) ** 2
    share = np.maximum(1.0 - noise / np.maximum(total / count, 1e-18), 0.0)
    return moves * share[:, None]
