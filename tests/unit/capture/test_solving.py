"""Surveys of which all is known: what is found lies where it should."""

from dataclasses import replace

import numpy as np
import pytest

from mien.capture.records import Solution
from mien.capture.simulating import Setup, Simulated, board, cube, simulate
from mien.capture.solving import solve
from mien.core.errors import MienError, UnknownNameError

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
    assert not solution.suspects
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


@pytest.mark.parametrize("views", [2, 4])
def test_a_reference_that_was_surveyed_wrongly_is_named_with_what_is_off(views: int) -> None:
    survey = simulate(replace(MODERN, views=views), 6).survey
    wrong = survey.references[3]
    references = tuple(replace(each, x=each.x + 0.005) if each is wrong else each for each in survey.references)
    remarks = [each for each in solve(replace(survey, references=references)).remarks if "measure it again" in each]
    assert len(remarks) == 1
    assert remarks[0].startswith(f"reference {wrong.name!r}")
    x, y, z = (float(text) for text in remarks[0].split("(")[1].split(" mm")[0].split(","))
    assert (x, y, z) == pytest.approx((-5.0, 0.0, 0.0), abs=0.6)


@pytest.mark.parametrize("off_centre", [0.3, 0.9])
def test_cropped_photographs_are_solved_and_told(off_centre: float) -> None:
    simulated = simulate(replace(MODERN, references=cube(), k1=0.0, views=3, off_centre=off_centre), 1)
    solution = solve(simulated.survey)
    off = {key: each.place - simulated.places[key] for key, each in solution.points.items() if each.kind == "measured"}
    covered = [v @ np.linalg.solve(solution.points[key].covariance, v) < 7.815 for key, v in off.items()]
    assert len(off) == 30
    assert np.mean(covered) > 0.8
    assert not solution.suspects
    assert sum("cropped" in remark for remark in solution.remarks) >= 1


def test_unknown_method() -> None:
    with pytest.raises(UnknownNameError, match="metric"):
        solve(simulate(MODERN, 0).survey, method="metrik")


def test_a_photograph_of_few_references_is_placed_by_points_of_others() -> None:
    simulated = simulate(replace(MODERN, views=4), 2)
    references = {each.name for each in simulated.survey.references}
    own = [each for each in simulated.survey.observations if each.photo == "view4.jpg" and each.point in references]
    few = tuple(each for each in simulated.survey.observations if each not in own[2:])
    solution = solve(replace(simulated.survey, observations=few))
    assert solution.cameras["view4.jpg"].place == pytest.approx(simulated.cameras["view4.jpg"].place, abs=0.005)
    assert rms(solution, simulated) < 0.001


def test_boards_alone_tell_a_pair_of_cameras() -> None:
    setup = Setup(references=board(), points=0, views=2, moments=6, fixed=True, one_lens=False, k1=-0.1)
    simulated = simulate(setup, 4)
    solution = solve(simulated.survey)
    found, true = (
        np.linalg.norm(cameras["m01-view1.jpg"].place - cameras["m01-view2.jpg"].place)
        for cameras in (solution.cameras, simulated.cameras)
    )
    assert found == pytest.approx(true, rel=0.01)
    assert solution.points["m01", "board 0 0"].place == pytest.approx(np.zeros(3))
    assert len(solution.cameras) == 12


def test_a_photograph_whose_clicks_are_anywhere_is_left_out() -> None:
    survey = simulate(replace(MODERN, views=3), 6).survey
    generator = np.random.default_rng(1)
    wild = tuple(
        replace(each, u=generator.uniform(0, 4000), v=generator.uniform(0, 3000)) if each.photo == "view3.jpg" else each
        for each in survey.observations
    )
    solution = solve(replace(survey, observations=wild))
    assert sorted(solution.cameras) == ["view1.jpg", "view2.jpg"]
    assert any("'view3.jpg' was left out" in remark and "contradict" in remark for remark in solution.remarks)


def test_clicks_that_are_all_anywhere_are_no_solution() -> None:
    survey = simulate(MODERN, 6).survey
    generator = np.random.default_rng(1)
    wild = tuple(
        replace(each, u=generator.uniform(0, 4000), v=generator.uniform(0, 3000)) for each in survey.observations
    )
    with pytest.raises(MienError, match="no photograph can be placed"):
        solve(replace(survey, observations=wild))


def test_sigmas_that_are_told_too_small_are_found_out() -> None:
    simulated = simulate(replace(MODERN, views=4, sigma_px=4.0), 7)
    bold = tuple(replace(each, sigma_px=1.0) for each in simulated.survey.observations)
    honest, told = solve(simulated.survey), solve(replace(simulated.survey, observations=bold))
    assert not told.suspects
    assert any("sigmas" in remark for remark in told.remarks)
    key = ("rest", "p001")
    assert np.trace(told.points[key].covariance) == pytest.approx(np.trace(honest.points[key].covariance), rel=0.2)


def test_references_that_are_not_where_they_are_said_to_be() -> None:
    survey = simulate(replace(MODERN, views=4, reference_sigma_m=0.0005), 8).survey
    exact = replace(survey, references=tuple(replace(each, sigma_m=0.0) for each in survey.references))
    assert any("tell their sigma" in remark for remark in solve(exact).remarks)
    assert not any("tell their sigma" in remark for remark in solve(survey).remarks)
