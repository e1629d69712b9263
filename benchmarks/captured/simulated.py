"""Simulated set-ups solved, and how far off the face is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from captured import opencv
from mien.capture.records import Solution
from mien.capture.simulating import INCH_M, Setup, Simulated, cube, simulate
from mien.capture.solving import solve
from mien.core.errors import MienError

SIDE_M = 10 * INCH_M
DOTS_PER_INCH = 100
TABLET_INCH = 0.05
"""The accuracy of his tablet (1974, C.3)."""

READINGS = {
    "rounded to 0.05 inch": ("rounded", TABLET_INCH / np.sqrt(12.0)),
    "within 0.05 inch": ("uniform", TABLET_INCH / np.sqrt(3.0)),
    "sigma 0.05 inch": ("normal", TABLET_INCH),
}
REFERENCES = (6, 8, 20)
VIEWS = (2, 3, 4)
NINETY_FIVE = 7.814727903251179
"""χ² of 3 degrees of freedom that 95 % stay below."""

METHODS = ("appendix-c", "metric", *(f"OpenCV, {setting}" for setting in opencv.SETTINGS))


@dataclass(frozen=True)
class Outcome:
    """How a method did on one simulated survey.

    Attributes:
        error: root mean square distance of the points of the face from where they are, % of the cube's side.
        covered: how many of their 95 % ellipsoids hold the true place, of how many.
        chi2: of a degree of freedom.
    """

    error: float
    covered: tuple[int, int] = (0, 0)
    chi2: float = np.nan


def parke(reading: str, references: int, views: int) -> Setup:
    """Appendix C: a cube of 10 inches on prints of 14 by 11.

    Each has a lens of its own, being an enlargement, with its middle off by up to 3 % of the width; k1 = -0.05 moves
    the corners by 0.3 %, as a decent lens does.
    """
    noise, sigma = READINGS[reading]
    return Setup(
        cube(SIDE_M, references),
        views=views,
        size_px=(14 * DOTS_PER_INCH, 11 * DOTS_PER_INCH),
        k1=-0.05,
        off_centre=0.03,
        one_lens=False,
        noise=noise,  # type: ignore[arg-type]
        sigma_px=sigma * DOTS_PER_INCH,
    )


def modern(views: int, **changes: object) -> Setup:
    """Clicks of today: 1 px of 4000, a lens that bends, 20 references."""
    return Setup(cube(SIDE_M, 20), views=views, distance_m=1.0, k1=-0.15, off_centre=0.01, **changes)  # type: ignore[arg-type]


def outcome(simulated: Simulated, method: str) -> Outcome | None:
    """What a method makes of a survey; nothing if it refuses."""
    if method.startswith("OpenCV"):
        flags = opencv.SETTINGS[method.removeprefix("OpenCV, ")]
        return Outcome(error_percent(simulated, opencv.locate(simulated.survey, simulated.cameras, flags)))
    try:
        solution = solve(simulated.survey, method=method)
    except MienError:
        return None
    places = {key: point.place for key, point in solution.points.items()}
    if method != "metric":
        return Outcome(error_percent(simulated, places))
    return Outcome(error_percent(simulated, places), coverage(simulated, solution), solution.chi2_per_dof)


def error_percent(simulated: Simulated, places: Mapping[tuple[str, str], np.ndarray]) -> float:
    """Root mean square distance from the truth, % of the cube's side."""
    known = {reference.name for reference in simulated.survey.references}
    off = [places[key] - true for key, true in simulated.places.items() if key[1] not in known and key in places]
    return 100.0 / SIDE_M * float(np.sqrt((np.array(off) ** 2).sum(axis=1).mean()))


def coverage(simulated: Simulated, solution: Solution) -> tuple[int, int]:
    """How many 95 % ellipsoids of measured points hold the true place, of how many."""
    held = []
    for key, point in solution.points.items():
        if point.kind == "measured":
            off = point.place - simulated.places[key]
            held.append(float(off @ np.linalg.solve(point.covariance, off)) < NINETY_FIVE)
    return sum(held), len(held)


@dataclass(frozen=True)
class Hunt:
    """What became of mis-clicks: those found, and those whose point was, of those made; false alarms of good clicks."""

    found: int
    named: int
    made: int
    false: int
    good: int


def hunt(simulated: Simulated) -> Hunt:
    """The suspects of the metric method against the mis-clicks that were made."""
    solution = solve(simulated.survey)
    suspects = {(each.observation.photo, each.observation.point) for each in solution.suspects}
    wrong = simulated.mis_clicks
    good = len(simulated.survey.observations) - len(wrong)
    named = sum(point in {name for _, name in suspects} for _, point in wrong)
    return Hunt(len(suspects & wrong), named, len(wrong), len(suspects - wrong), good)


def outcomes(setup: Setup, methods: Sequence[str], seeds: range) -> dict[str, list[Outcome | None]]:
    """Of each method on the surveys of all seeds."""
    surveys = [simulate(setup, seed) for seed in seeds]
    return {method: [outcome(each, method) for each in surveys] for method in methods}
