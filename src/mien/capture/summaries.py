"""A solution in a few numbers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from .records import Residual, Solution, SolvedPoint


def measured(solution: Solution) -> list[SolvedPoint]:
    """Points that were not known beforehand, by moment and name."""
    return [point for _, point in sorted(solution.points.items()) if point.kind != "reference"]


def fitted(solution: Solution) -> list[Residual]:
    """Residuals of what took part."""
    left_out = {(each.observation.photo, each.observation.point) for each in solution.suspects}
    return [each for each in solution.residuals if (each.observation.photo, each.observation.point) not in left_out]


def rms_px(solution: Solution) -> float:
    """How far points are seen from where the solution has them, px: root of the mean squared distance."""
    return rms(fitted(solution))


def errors_by_photo(solution: Solution) -> dict[str, float]:
    """As ``rms_px``, by photograph, in the order of the survey."""
    seen: dict[str, list[Residual]] = {photo.name: [] for photo in solution.survey.photographs}
    for each in fitted(solution):
        seen.setdefault(each.observation.photo, []).append(each)
    return {name: rms(residuals) for name, residuals in seen.items() if residuals}


def rms(residuals: Iterable[Residual]) -> float:
    """Root of the mean squared distance of residuals, px; 0 of none."""
    squares = [each.du**2 + each.dv**2 for each in residuals]
    return float(np.sqrt(np.mean(squares))) if squares else 0.0


def sigma_m(point: SolvedPoint) -> float:
    """How exact a place is, m: root of the mean variance of its axes."""
    return float(np.sqrt(np.trace(point.covariance) / 3.0))


def places_rms(points: Sequence[SolvedPoint]) -> float:
    """How exact places are on the whole, m."""
    return float(np.sqrt(np.mean([sigma_m(point) ** 2 for point in points]))) if points else 0.0


def worst_points(solution: Solution, count: int) -> list[SolvedPoint]:
    """The least exact points, the worst first."""
    return sorted(measured(solution), key=lambda point: (-sigma_m(point), point.moment, point.name))[:count]
