"""What a solution says of its own errors is true, on many simulated surveys."""

from dataclasses import replace

import numpy as np
import pytest

from mien.capture.records import REST, Solution
from mien.capture.simulating import Setup, Simulated, cube, simulate
from mien.capture.solving import solve

HALF, NINETY_FIVE = 2.366, 7.815
"""χ² of 3 degrees of freedom that this share stays below."""

SETUP = Setup(cube(0.254, 8), points=10, views=3, k1=-0.1, off_centre=0.01, one_lens=False)
SEEDS = range(16)


@pytest.fixture(scope="module", params=["own lenses", "one lens", "loose references"])
def surveys(request) -> list[tuple[Simulated, Solution]]:
    changes = {"own lenses": {}, "one lens": {"one_lens": True}, "loose references": {"reference_sigma_m": 3e-4}}
    simulated = [simulate(replace(SETUP, **changes[request.param]), seed) for seed in SEEDS]
    return [(each, solve(each.survey)) for each in simulated]


def distances(surveys: list[tuple[Simulated, Solution]]) -> np.ndarray:
    """(surveys, points) of errors, squared, in their covariances."""
    rows = []
    for simulated, solution in surveys:
        measured = [(key, point) for key, point in solution.points.items() if point.kind == "measured"]
        offs = [(point.place - simulated.places[key], point.covariance) for key, point in measured]
        rows.append([off @ np.linalg.solve(covariance, off) for off, covariance in offs])
    return np.array(rows)


def test_ellipsoids_hold_the_share_of_true_places_that_they_say(surveys) -> None:
    inside = distances(surveys)
    assert inside.shape == (16, 10)
    assert abs((inside < NINETY_FIVE).mean() - 0.95) < 0.07
    assert abs((inside < HALF).mean() - 0.5) < 0.11


def test_residuals_are_as_large_as_sigmas_say(surveys) -> None:
    chi2 = np.array([solution.chi2_per_dof for _, solution in surveys])
    assert abs(chi2.mean() - 1.0) < 0.15
    assert chi2.std() < 0.35


def test_a_point_seen_by_fewer_cameras_is_known_less(surveys) -> None:
    simulated, whole = surveys[0]
    seen = simulated.survey.observations
    less = tuple(each for each in seen if (each.point, each.photo) != ("p001", "view3.jpg"))
    part = solve(replace(simulated.survey, observations=less))
    variances = [np.trace(solution.points[REST, "p001"].covariance) for solution in (whole, part)]
    assert 1.1 * variances[0] < variances[1]
    assert part.points[REST, "p001"].photos == ("view1.jpg", "view2.jpg")


def test_wrong_sigmas_are_told_by_chi2_and_ellipsoids_follow_the_scatter() -> None:
    simulated = simulate(SETUP, 1)
    shy = tuple(replace(each, sigma_px=3.0) for each in simulated.survey.observations)
    assert solve(replace(simulated.survey, observations=shy)).chi2_per_dof == pytest.approx(1.0 / 9.0, rel=0.5)


@pytest.mark.parametrize("views", [2, 4])
def test_exact_clicks_contradict_nothing(views: int) -> None:
    simulated = simulate(replace(SETUP, views=views, sigma_px=0.0), 1)
    solution = solve(simulated.survey)
    assert solution.suspects == ()
    for key, point in solution.points.items():
        assert point.place == pytest.approx(simulated.places[key], abs=1e-5)
        assert point.kind == "reference" or np.trace(point.covariance) > 0.0
