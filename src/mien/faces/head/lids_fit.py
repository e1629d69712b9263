"""Lid arcs for another person: where the lids of a changed head must go so that they meet and clear the ball.

The arcs that ship belong to the neutral head. A head with a residual has other margins and another ball; closed
with the neutral arcs four of ten people showed a sliver of eye. Here the same rules are solved on their own points.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mien.core.mesh import Points
from mien.core.sparse import SparseMatrix

from .measured import LID_RINGS, Floats, Lids

Curve = Callable[[float], float]

MEETING = 0.70
"""The margins meet 70 % of the way down from the upper to the lower one."""

OVERLAP_RAD = 0.012
SHARE_UPPER = (1.0, 1.0, 1.0, 0.66, 0.30, 0.07)
SHARE_LOWER = (1.0, 1.0, 1.0, 0.60, 0.30, 0.10)
"""How far each ring goes with the margin, from the hidden inner ring to the fold."""

CLEARANCE_M = 0.0005
MARGIN_CLEARANCE_M, LIP_CLEARANCE_M = 0.00085, 0.0012
ROUNDS = 16
MARGIN = LID_RINGS.index("margin")
STATIONS = 12


def fit_lids(points: Points, lids: Lids, centres: Points, radius: float, refine: SparseMatrix | None) -> Lids:
    """The lids' polar coordinates on other points.

    Args:
        points: (V, 3) m, neutral skin of the person; symmetric.
        lids: which vertices they are.
        centres: (2, 3) m, left and right eye.
        radius: m, of the ball.
        refine: matrix (V', V) of one subdivision step for a cage; None for points on the surface.
    """
    flip = np.stack([lids.side, np.ones_like(lids.side), np.ones_like(lids.side)], axis=1)
    centre = np.where(lids.side[:, None] > 0, centres[0], centres[1])
    azimuth, elevation, distance = _polar((points[lids.index] - centre) * flip)
    fitted = replace(lids, azimuth=azimuth, elevation=elevation, radius=distance)
    left = np.flatnonzero(lids.side > 0)
    ring = left.reshape(len(LID_RINGS), STATIONS)
    margin = _margin(points, lids.index[ring[MARGIN]], centres[0], refine)
    upper, lower = _curves(margin)
    shut, far = elevation.copy(), distance.copy()
    for number, row in enumerate(ring):
        for vertex in row[lids.upper[row] != 0]:
            is_upper = lids.upper[vertex] > 0
            share = (SHARE_UPPER if is_upper else SHARE_LOWER)[number]
            start = (upper if is_upper else lower)(azimuth[vertex])
            way = _meeting(upper, lower, azimuth[vertex]) - start
            shut[vertex] = elevation[vertex] + share * way
            if number <= MARGIN:
                shut[vertex] -= OVERLAP_RAD if is_upper else -OVERLAP_RAD
            if number == MARGIN:
                far[vertex] = max(distance[vertex], radius + MARGIN_CLEARANCE_M)
            elif number == MARGIN + 1:
                # Never thinner than its clearance, never thicker than the open lid.
                far[vertex] = max(radius + LIP_CLEARANCE_M, 0.5 * (distance[vertex] + radius + LIP_CLEARANCE_M))
    for _ in range(ROUNDS if refine is not None else 0):
        _correct(points, fitted, shut, far, ring, centres[0], radius, refine, upper, lower)
    right = np.flatnonzero(lids.side < 0)
    shut[right], far[right] = shut[left], far[left]
    return replace(fitted, elevation_shut=_round(shut), radius_shut=_round(far))


def _correct(
    points: Points,
    lids: Lids,
    shut: Floats,
    far: Floats,
    ring: np.ndarray[tuple[int, int], np.dtype[np.int64]],
    centre: Floats,
    radius: float,
    refine: SparseMatrix | None,
    upper: Curve,
    lower: Curve,
) -> None:
    """One round: move margins towards where the refined ones should meet, push out what cuts the ball."""
    posed = points.copy()
    posed[lids.index[ring]] = centre + _cartesian(lids.azimuth[ring], shut[ring], far[ring])
    margin = _margin(posed, lids.index[ring[MARGIN]], centre, refine)
    for station in range(STATIONS):
        vertex = ring[MARGIN, station]
        if lids.upper[vertex] == 0:
            continue
        over = OVERLAP_RAD if lids.upper[vertex] > 0 else -OVERLAP_RAD
        miss = _meeting(upper, lower, margin[0][station]) - over - margin[1][station]
        for number in (MARGIN - 1, MARGIN):
            shut[ring[number, station]] += 0.8 * miss
    if refine is None:
        return
    fine = refine.apply(posed) - centre
    gap = np.sqrt(fine[:, 0] ** 2 + fine[:, 1] ** 2 + fine[:, 2] ** 2) - radius
    owner = {int(lids.index[vertex]): int(vertex) for vertex in ring[MARGIN:].ravel()}
    near = np.flatnonzero((gap < CLEARANCE_M) & (fine[:, 2] > 0.002))
    for row in near:
        entries = slice(refine.starts[row], refine.starts[row + 1])
        for column, weight in zip(refine.columns[entries], refine.weights[entries], strict=True):
            if int(column) in owner and weight > 0.05:
                far[owner[int(column)]] += 0.6 * weight * (CLEARANCE_M - gap[row])


def _margin(
    points: Points, vertices: np.ndarray[tuple[int], np.dtype[np.int64]], centre: Floats, refine: SparseMatrix | None
) -> tuple[Floats, Floats]:
    """Azimuth and elevation of the left margin's twelve stations, on refined skin for a cage."""
    seen = points if refine is None else refine.apply(points)
    azimuth, elevation, _ = _polar(seen[vertices] - centre)
    return azimuth, elevation


def _curves(margin: tuple[Floats, Floats]) -> tuple[Curve, Curve]:
    """Elevation of the upper and the lower margin as functions of azimuth."""
    azimuth, elevation = margin
    above, below = np.arange(0, 7), np.array([0, *range(11, 5, -1)])
    return _curve(azimuth[above], elevation[above]), _curve(azimuth[below], elevation[below])


def _curve(azimuth: Floats, elevation: Floats) -> Curve:
    order = np.argsort(azimuth)
    return lambda x: float(np.interp(x, azimuth[order], elevation[order]))


def _meeting(upper: Curve, lower: Curve, azimuth: float) -> float:
    top = upper(azimuth)
    return float(top + MEETING * (lower(azimuth) - top))


def _polar(vectors: Points) -> tuple[Floats, Floats, Floats]:
    distance = np.sqrt(vectors[:, 0] ** 2 + vectors[:, 1] ** 2 + vectors[:, 2] ** 2)
    azimuth = np.arctan2(vectors[:, 0], vectors[:, 2])
    elevation = np.arcsin(vectors[:, 1] / distance)
    return _round(azimuth), _round(elevation), _round(distance)


def _cartesian(azimuth: Floats, elevation: Floats, distance: Floats) -> Points:
    flat = distance * np.cos(elevation)
    return np.stack([flat * np.sin(azimuth), distance * np.sin(elevation), flat * np.cos(azimuth)], axis=-1)


def _round(values: Floats) -> Floats:
    """To a ten-millionth, so that no library's arctangent decides a bit of what is drawn."""
    return np.rint(values * 1e7) * 1e-7
