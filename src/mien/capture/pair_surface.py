"""A guess at what one photograph does not show of a point: a smooth surface through its neighbours."""

from __future__ import annotations

import numpy as np

from mien.core.mesh import Points

REACHES_M = (0.012, 0.02, 0.035, 0.06, 0.1)
"""How far points tell of one another; which of these is chosen by how well each point is guessed from the others."""

FEWEST = 8
GRAIN = 1e-3
"""Share of the variance that has no smoothness."""


def guess_surface(at: Points, heights: Points, where: Points, *, even: bool) -> tuple[Points, Points]:
    """Heights (M,) of a smooth surface over places ``where`` (M, 2), and their standard deviations (M,), m.

    Args:
        at: (N, 2) m, where the surface is known.
        heights: (N,) m.
        where: (M, 2) m.
        even: the surface is its own mirror image about the first axis's zero.

    The standard deviations are set so that they would be right where each known point is guessed from all others.

    Source: universal kriging with a Matérn 5/2 covariance; leave-one-out as in Rasmussen & Williams 2006, "Gaussian
    Processes for Machine Learning", section 5.4.2.
    """
    if len(at) < FEWEST:
        spread = float(np.ptp(heights)) if len(heights) else 0.1
        return np.full(len(where), np.median(heights) if len(heights) else 0.0), np.full(len(where), max(spread, 0.02))
    return max((_fit(at, heights, where, reach, even) for reach in REACHES_M), key=lambda fit: fit[2])[:2]


def _fit(at: Points, heights: Points, where: Points, reach: float, even: bool) -> tuple[Points, Points, float]:
    """The guess of one reach, its standard deviations, and how likely each known point was from the others."""
    own = _covariances(at, at, reach, even) + GRAIN * np.eye(len(at))
    trend, ahead = _trend(at, even), _trend(where, even)
    inverse = np.linalg.inv(own)
    weighed = inverse @ trend
    of_trend = np.linalg.inv(trend.T @ weighed)
    precision = inverse - weighed @ of_trend @ weighed.T
    mismatch = precision @ heights
    of_each = np.diag(precision)
    sill = float(np.mean(mismatch**2 / of_each))
    likelihood = -0.5 * float(np.sum(np.log(sill / of_each)))
    across = _covariances(where, at, reach, even)
    slopes = of_trend @ (weighed.T @ heights)
    guess = ahead @ slopes + across @ mismatch
    left = ahead - across @ weighed
    nearest = 1.0 + (even * _matern(2.0 * np.abs(where[:, 0]) / reach))
    variance = nearest + GRAIN - np.sum(across @ inverse * across, axis=1) + np.sum(left @ of_trend * left, axis=1)
    return guess, np.sqrt(sill * np.maximum(variance, GRAIN)), likelihood


def _trend(places: Points, even: bool) -> Points:
    one = np.ones(len(places))
    return np.stack([one, places[:, 1]] if even else [one, *places.T], axis=1)


def _covariances(one: Points, other: Points, reach: float, even: bool) -> Points:
    covariances = _matern(np.linalg.norm(one[:, None] - other, axis=2) / reach)
    if even:
        covariances += _matern(np.linalg.norm(one[:, None] - other * [-1.0, 1.0], axis=2) / reach)
    return covariances


def _matern(distance: Points) -> Points:
    far = np.sqrt(5.0) * distance
    return (1.0 + far + far * far / 3.0) * np.exp(-far)
