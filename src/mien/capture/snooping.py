"""Mis-clicks: observations that all others contradict.

Each is judged as if it had been left out: χ² falls by rᵀ (I − H)⁻¹ r, r what is off and H the part of the solution that
it decides itself. The worst are left out in truth, and the rest is solved anew, until none is contradicted.

Source: Baarda 1968, "A testing procedure for use in geodetic networks" (data snooping); Cook and Weisberg 1982,
section 2.2 (leaving out).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.capture.covariances import Covariances, covariances, seen_covariances
from mien.capture.networks import Bools, Network
from mien.capture.refining import Refined
from mien.core.mesh import Ints, Points

CONTRADICTED = 18.4
"""χ² of 2 degrees of freedom beyond which a click is a mis-click: one good click in 10,000."""
LEAST_PX = 0.005
"""No click is surer than that: what is left of exact ones is rounding."""
LEAST_CHECKED = 0.01
"""Part of a direction of a click that others must check for it to be judged by it."""
LEAST_SCALE = 0.01
"""Nobody clicks more than ten times as well as told: what computed clicks are off comes of rounding and assumptions."""


@dataclass(frozen=True, eq=False)
class Judgement:
    """What is thought of active observations.

    Attributes:
        statistics: (A,) χ² of 2 degrees of freedom of leaving each out, for the standard deviations told.
        scale: square of how many times larger the clicks scatter than told; 1 where they agree.
        shares: (A,) how many numbers, 0 to 2, of each the others check.
        redundancy: how many numbers more than needed were told.
        covariances: of all.
    """

    statistics: Points
    scale: float
    shares: Points
    redundancy: float
    covariances: Covariances


def judge(refined: Refined) -> Judgement:
    """What leaving each active observation out would change."""
    found = covariances(refined.equations)
    checked = np.eye(2) - seen_covariances(refined, found)
    values, axes = np.linalg.eigh(checked)
    along = np.einsum("nij,ni->nj", axes, refined.equations.off)
    counted = values > LEAST_CHECKED
    squares = np.where(counted, along**2 / np.where(counted, values, 1.0), 0.0)
    degrees = counted.sum(axis=1)
    statistics = np.where(degrees == 1, _as_two(squares.sum(axis=1)), squares.sum(axis=1))
    shares = np.where(degrees > 0, np.trace(checked, axis1=1, axis2=2), 0.0)
    redundancy = float(np.trace(checked, axis1=1, axis2=2).sum())
    least = (LEAST_PX / float(np.median(refined.problem.network.sigmas))) ** 2
    scale = max(_scale(statistics[degrees > 0], redundancy), least)
    return Judgement(statistics, scale, shares, redundancy, found)


def scatter(judgement: Judgement, some: Bools) -> float:
    """Square of how many times larger some (A,) of the clicks scatter than told; 1 where that may be chance."""
    some = some & (judgement.shares > 0.0)
    return _scale(judgement.statistics[some], float(judgement.shares[some].sum()))


def _as_two(statistics: Points) -> Points:
    """χ² of 2 degrees of freedom that are as unlikely as those of 1."""
    from scipy.special import log_ndtr

    return -2.0 * (np.log(2.0) + log_ndtr(-np.sqrt(statistics)))


def _scale(statistics: Points, redundancy: float) -> float:
    """Square of how many times larger clicks scatter than told, by their median; 1 where that may be chance."""
    pairs = redundancy / 2.0
    if pairs < 3.0 or not len(statistics):
        return 1.0
    scale = float(np.median(statistics)) / (2.0 * np.log(2.0))
    # The median of n exponential variables scatters by 1/(ln 2 √n) of itself.
    surely = 3.0 / (np.log(2.0) * np.sqrt(pairs))
    scale = max(scale, LEAST_SCALE)
    return scale if abs(np.log(scale)) > surely else 1.0


def worst(network: Network, refined: Refined, judgement: Judgement) -> Ints:
    """Numbers of observations to leave out together: contradicted, the worst of their photograph and of their point.

    Of a point that two photographs see neither click is known to be the wrong one: both go.
    """
    order = refined.equations.layout.order
    statistics = judgement.statistics / judgement.scale
    ranked = np.argsort(-statistics, kind="stable")
    ranked = ranked[statistics[ranked] > CONTRADICTED]
    if not len(ranked):
        return np.empty(0, dtype=np.int64)
    least = 0.3 * statistics[ranked[0]]
    photos: set[int] = set()
    points: set[int] = set()
    taken: list[int] = []
    counts = np.bincount(network.point_of[order], minlength=len(network.points))
    for number in ranked[statistics[ranked] >= least]:
        seen = int(order[number])
        photo, point = int(network.photo_of[seen]), int(network.point_of[seen])
        if point in points:
            continue
        # Not its second worst either, while the worst has to wait for another of its photograph.
        points.add(point)
        if photo in photos:
            continue
        photos.add(photo)
        if not network.known[point] and counts[point] == 2:
            taken += order[network.point_of[order] == point].tolist()
        else:
            taken.append(seen)
    return np.array(taken, dtype=np.int64)
