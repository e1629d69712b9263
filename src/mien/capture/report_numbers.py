"""The numbers of a report: how exact, in which unit, with how many digits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mien.core import UnknownNameError
from mien.core.mesh import Points

from .project_records import METRES
from .records import WORLD, Solution
from .summaries import measured, places_rms, rms_px, sigma_m

REFERENCE = "reference"
"""The kind of a solved point that was known beforehand."""


@dataclass(frozen=True)
class Unit:
    """How lengths are written.

    Attributes:
        name: as it stands after a number.
        metres: of one of it.
        decimals: so many that the usual standard deviation shows two digits.
    """

    name: str
    metres: float
    decimals: int

    @classmethod
    def of(cls, name: str, solution: Solution) -> Unit:
        """The unit of that name, with decimals fit for the points of a solution.

        Raises:
            UnknownNameError: there is no such unit.
        """
        if name not in METRES:
            raise UnknownNameError("unit", name, METRES)
        sigmas = [sigma_m(point) for point in measured(solution) or solution.points.values()]
        usual = float(np.median(sigmas)) / METRES[name] if sigmas else 0.0
        decimals = 1 - math.floor(math.log10(usual)) if usual > 0.0 else 3
        return cls(name, METRES[name], min(max(decimals, 0), 6))

    def number(self, length_m: float) -> str:
        """A length without its unit."""
        return fixed(length_m / self.metres, self.decimals)

    def length(self, length_m: float) -> str:
        """A length of three digits with its unit."""
        return f"{significant(length_m / self.metres)} {self.name}"


@dataclass(frozen=True)
class Exactness:
    """How well a solution is known.

    Attributes:
        points: measured ones, without references.
        point_rms_m: root mean square of the standard deviations of their coordinates; 0 without points.
        span_m: the largest distance between two references of a target, or between two points where there is none.
        spanned: what spans it, ``references`` or ``points``.
        residual_rms_px: of the clicks that took part.
        clicks, suspects: how many there are, of all.
        chi2_per_dof: 1 where the sigmas of the clicks are right.
    """

    points: int
    point_rms_m: float
    span_m: float
    spanned: str
    residual_rms_px: float
    clicks: int
    suspects: int
    chi2_per_dof: float

    @classmethod
    def of(cls, solution: Solution) -> Exactness:
        """The exactness of a solution."""
        points = measured(solution)
        span_m, spanned = _span(solution)
        return cls(
            points=len(points),
            point_rms_m=places_rms(points),
            span_m=span_m,
            spanned=spanned,
            residual_rms_px=rms_px(solution),
            clicks=len(solution.residuals),
            suspects=len(solution.suspects),
            chi2_per_dof=solution.chi2_per_dof,
        )

    @property
    def share(self) -> float:
        """Of the span, how exact points are; 0 where there is no span."""
        return self.point_rms_m / self.span_m if self.span_m > 0.0 else 0.0


def longest(places: Points) -> float:
    """The largest distance between two of (N, 3) places; 0 where there are fewer than two."""
    if len(places) < 2:
        return 0.0
    return max(float(np.sqrt(((places - place) ** 2).sum(axis=1).max())) for place in places)


def significant(value: float, digits: int = 3) -> str:
    """A number of so many digits, never as a power of ten."""
    if not math.isfinite(value):
        return "unknown"
    if value == 0.0:
        return "0"
    decimals = digits - 1 - math.floor(math.log10(abs(value)))
    text = f"{round(value, decimals):.{min(max(decimals, 0), 9)}f}"
    return text.replace("-", "−")


def fixed(value: float, decimals: int) -> str:
    """A number of so many decimals with a true minus sign."""
    return f"{value:.{decimals}f}".replace("-", "−") if math.isfinite(value) else "unknown"


def round_down(value: float) -> float:
    """The largest of 1, 2, 5, 10, 20, 50 … (and 0.5, 0.2 …) that is not above a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    return max(step * power for step in (1.0, 2.0, 5.0) if step * power <= value * (1.0 + 1e-9))


def count(number: int, one: str, many: str = "") -> str:
    """A number with its noun: ``1 point``, ``2 points``."""
    return f"{number} {one if number == 1 else many or one + 's'}"


def _span(solution: Solution) -> tuple[float, str]:
    targets: dict[str, list[tuple[float, float, float]]] = {}
    for each in solution.survey.references:
        targets.setdefault(each.target, []).append((each.x, each.y, each.z))
    bodies: Sequence[list[tuple[float, float, float]]] = (
        [targets[WORLD]] if WORLD in targets else list(targets.values())
    )
    span_m = max((longest(np.array(body)) for body in bodies), default=0.0)
    if span_m > 0.0:
        return span_m, "references"
    moments = {moment for moment, _ in solution.points}
    by_moment = [np.array([p.place for (at, _), p in solution.points.items() if at == moment]) for moment in moments]
    return max((longest(places) for places in by_moment), default=0.0), "points"
