"""Lid arcs for another person: where the lids of a changed head must go so that they meet and clear the ball.

The arcs that ship belong to the neutral head. A head with a residual has other margins and another ball; closed
with the neutral arcs four of ten people showed a sliver of eye. Here the same rules are solved on their own points.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mien.core.mesh import Ints, Points
from mien.core.sparse import SparseMatrix

from .lids import on_sphere
from .measured import LID_RINGS, Floats, Lids
from .vectors import length

MEETING = 0.93
"""The margins meet so far down from the upper to the lower one: the lower lid of the measured blink hardly rises."""

OVERLAP_RAD = 0.012
"""How far each margin passes the line where they meet."""

SHARE_UPPER = (1.0, 1.0, 1.0, 0.96, 0.28, 0.05)
SHARE_LOWER = (1.0, 1.0, 1.0, 0.60, 0.30, 0.10)
"""How far each ring goes with the margin, from the hidden inner ring to the fold."""

CLEARANCE_M = 0.0005
MARGIN_CLEARANCE_M, LIP_CLEARANCE_M = 0.00085, 0.0012
"""How far refined skin, margin and lip of the lids stand off the ball at least."""

FLIP = (-1.0, 1.0, 1.0)
ROUNDS = 16
INNER, MARGIN, LIP = (LID_RINGS.index(ring) for ring in ("inner", "margin", "lip"))
STATIONS = 12
ABOVE, BELOW = np.arange(0, 7), np.array([0, *range(11, 5, -1)])
"""Stations of the upper and of the lower margin, from the inner to the outer corner; they share both corners."""


@dataclass(frozen=True, eq=False)
class LeftEye:
    """What the lids of the left eye are fitted to, or of the right one in the mirror.

    Attributes:
        points: (V, 3) m, neutral skin.
        lids: polar coordinates at rest of the lids on that skin.
        rows: (rings, stations) numbers into ``lids``.
        centre: (3,) m.
        radius: m, of the ball.
        refine: matrix (V', V) of one subdivision step for a cage; None for points on the surface.
    """

    points: Points
    lids: Lids
    rows: Ints
    centre: Points
    radius: float
    refine: SparseMatrix | None

    def margin(self, points: Points) -> tuple[Floats, Floats]:
        """(stations,) azimuth and elevation of the margin, on refined skin for a cage."""
        seen = points if self.refine is None else self.refine.apply(points)
        azimuth, elevation, _ = to_polar(seen[self.lids.index[self.rows[MARGIN]]] - self.centre)
        return azimuth, elevation


def fit_lids(
    points: Points, lids: Lids, centres: Points, radius: float, refine: SparseMatrix | None, mirror: Ints | None = None
) -> Lids:
    """The lids' polar coordinates on other points.

    Args:
        points: (V, 3) m, neutral skin of the person.
        lids: which vertices they are.
        centres: (2, 3) m, left and right eye.
        radius: m, of the ball.
        refine: matrix (V', V) of one subdivision step for a cage; None for points on the surface.
        mirror: (V,) vertex that each becomes in the mirror; None for symmetric points, whose left lids do for both.
    """
    flip = np.stack([lids.side, np.ones_like(lids.side), np.ones_like(lids.side)], axis=1)
    centre = np.where(lids.side[:, None] > 0, centres[0], centres[1])
    azimuth, elevation, distance = to_polar((points[lids.index] - centre) * flip)
    fitted = replace(lids, azimuth=azimuth, elevation=elevation, radius=distance)
    left, right = np.flatnonzero(lids.side > 0), np.flatnonzero(lids.side < 0)
    rows = left.reshape(len(LID_RINGS), STATIONS)
    shut, far = _shut(LeftEye(points, fitted, rows, centres[0], radius, refine))
    if mirror is None:
        shut[right], far[right] = shut[left], far[left]
    else:
        seen = replace(fitted, azimuth=azimuth.copy(), elevation=elevation.copy(), radius=distance.copy())
        for values in (seen.azimuth, seen.elevation, seen.radius):
            values[left] = values[right]
        other = LeftEye(points[mirror] * FLIP, seen, rows, centres[1] * FLIP, radius, refine)
        shut_right, far_right = _shut(other)
        shut[right], far[right] = shut_right[left], far_right[left]
    return replace(fitted, elevation_shut=_round(shut), radius_shut=_round(far))


def _shut(eye: LeftEye) -> tuple[Floats, Floats]:
    """(L,) elevation and radius of the shut lids."""
    margin = eye.margin(eye.points)
    shut, far = _close(eye, margin)
    if eye.refine is not None:
        for _ in range(ROUNDS):
            shut, far = _correct(eye, margin, eye.refine, shut, far)
    return shut, far


def _close(eye: LeftEye, margin: tuple[Floats, Floats]) -> tuple[Floats, Floats]:
    """(L,) elevation and radius of the shut lids, each ring by its share of what the margin goes."""
    lids = eye.lids
    shut, far = lids.elevation.copy(), lids.radius.copy()
    moving = eye.rows[lids.upper[eye.rows] != 0]
    ring, upper = lids.ring[moving], lids.upper[moving] > 0
    top, bottom = _margin_elevations(margin, lids.azimuth[moving])
    share = np.where(upper, np.take(SHARE_UPPER, ring), np.take(SHARE_LOWER, ring))
    shut[moving] += share * (_meeting(top, bottom) - np.where(upper, top, bottom))
    shut[moving] -= np.where(ring <= MARGIN, _overlap(upper), 0.0)
    edge, lip = moving[ring == MARGIN], moving[ring == LIP]
    far[edge] = np.maximum(far[edge], eye.radius + MARGIN_CLEARANCE_M)
    # Never thinner than its clearance, never thicker than the open lid.
    far[lip] = np.maximum(eye.radius + LIP_CLEARANCE_M, 0.5 * (far[lip] + eye.radius + LIP_CLEARANCE_M))
    return shut, far


def _correct(
    eye: LeftEye, margin: tuple[Floats, Floats], refine: SparseMatrix, shut: Floats, far: Floats
) -> tuple[Floats, Floats]:
    """One round: margins moved towards where the refined ones should meet, and what cuts the ball pushed out."""
    lids, rows = eye.lids, eye.rows
    shut, far = shut.copy(), far.copy()
    posed = eye.points.copy()
    posed[lids.index[rows]] = eye.centre + on_sphere(lids.azimuth[rows], shut[rows], far[rows])
    azimuth, elevation = eye.margin(posed)
    moving = np.flatnonzero(lids.upper[rows[MARGIN]])
    over = _overlap(lids.upper[rows[MARGIN, moving]] > 0)
    miss = _meeting(*_margin_elevations(margin, azimuth[moving])) - over - elevation[moving]
    for ring in (INNER, MARGIN):
        shut[rows[ring, moving]] += 0.8 * miss
    fine = refine.apply(posed) - eye.centre
    gap = length(fine) - eye.radius
    owner = {int(lids.index[row]): int(row) for row in rows[MARGIN:].ravel()}
    for vertex in np.flatnonzero((gap < CLEARANCE_M) & (fine[:, 2] > 0.002)):
        entries = slice(refine.starts[vertex], refine.starts[vertex + 1])
        for column, weight in zip(refine.columns[entries], refine.weights[entries], strict=True):
            if int(column) in owner and weight > 0.05:
                far[owner[int(column)]] += 0.6 * weight * (CLEARANCE_M - gap[vertex])
    return shut, far


def _overlap(upper: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> Floats:
    return np.where(upper, OVERLAP_RAD, -OVERLAP_RAD)


def _meeting(top: Floats, bottom: Floats) -> Floats:
    return top + MEETING * (bottom - top)


def _margin_elevations(margin: tuple[Floats, Floats], azimuth: Floats) -> tuple[Floats, Floats]:
    """(N,) elevation of the upper and of the lower margin at an azimuth (N,)."""
    top, bottom = (_curve(margin[0][stations], margin[1][stations], azimuth) for stations in (ABOVE, BELOW))
    return top, bottom


def _curve(azimuth: Floats, elevation: Floats, at: Floats) -> Floats:
    order = np.argsort(azimuth)
    return np.interp(at, azimuth[order], elevation[order])


def to_polar(vectors: Points) -> tuple[Floats, Floats, Floats]:
    """(N,) azimuth, elevation, rad, and distance, m, of vectors (N, 3) m."""
    distance = length(vectors)
    azimuth = np.arctan2(vectors[:, 0], vectors[:, 2])
    elevation = np.arcsin(vectors[:, 1] / distance)
    return _round(azimuth), _round(elevation), _round(distance)


def _round(values: Floats) -> Floats:
    """To a ten-millionth, so that no library's arctangent decides a bit of what is drawn."""
    return np.rint(values * 1e7) * 1e-7
