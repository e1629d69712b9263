"""Surveys of which all is known: what is found lies where it should."""

from dataclasses import replace

import numpy as np
import pytest

from mien.capture.records import Solution
from mien.capture.simulating import Setup, Simulated, cube, simulate
from mien.capture.solving import solve
from mien.core.errors import UnknownNameError

CUBE_M = 0.254
MODERN = Setup(references=cube(count=20), k1=-0.15, points=30, views=2)


def rms(solution: Solution, simulated: Simulated) -> float:
    """Of measured points, over the side of the cube."""
    off = [each.place - simulated.places[key] for key, each in solution.points.items() if each.kind == "measured"]
    return float(np.sqrt(np.mean(np.sum(np.square(off), axis=1)))) / CUBE_M


def test_exact_clicks_give_exact_cameras_and_points() -> None:
    simulated = simulate(replace(MODERN, sigma_px=0.0), 1)
    solution = solve(simulated.survey)
    assert rms(solution, simulated) < 1e-6
    for name, camera in solution.cameras.items():
        true = simulated.cameras[name]
        assert camera.place == pytest.approx(true.place, abs=1e-6)
        assert camera.rotation == pytest.approx(true.rotation, abs=1e-6)
        assert camera.lens.focal_px == pytest.approx(true.lens.focal_px, rel=1e-6)
        assert camera.lens.k1 == pytest.approx(-0.15, abs=1e-5)


@pytest.mark.parametrize(("views", "limit"), [(2, 0.0010), (4, 0.0008)])
def test_clicks_of_a_pixel_measure_a_face(views: int, limit: float) -> None:
    simulated = simulate(replace(MODERN, views=views), 3)
    solution = solve(simulated.survey)
    assert rms(solution, simulated) < limit
    assert not solution.suspects
    assert solution.chi2_per_dof == pytest.approx(1.0, abs=0.35)
    assert len(solution.residuals) == len(simulated.survey.observations)


def test_mis_clicks_are_named_and_take_no_part() -> None:
    simulated = simulate(replace(MODERN, views=4, mis_clicks=0.02, mis_click_sigmas=40.0), 5)
    solution = solve(simulated.survey)
    assert {(each.observation.photo, each.observation.point) for each in solution.suspects} == simulated.mis_clicks
    assert rms(solution, simulated) < 0.001


def test_unknown_method() -> None:
    with pytest.raises(UnknownNameError, match="metric"):
        solve(simulate(MODERN, 0).survey, method="metrik")
