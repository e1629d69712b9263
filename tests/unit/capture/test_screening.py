"""Exchanged references are found before a camera is begun with them, and right clicks are left alone."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from mien.capture.records import Survey
from mien.capture.screening import astray, put_back, without
from mien.capture.simulating import Setup, board, cube, simulate
from mien.capture.solving import solve


def made(seed: int, *, views: int = 2, count: int = 12) -> Survey:
    return simulate(Setup(references=cube(count=count), points=6, views=views, size_px=(800, 600)), seed).survey


def exchanged(survey: Survey, one: str, other: str) -> Survey:
    """The same with two names exchanged in the first photograph."""
    photo, names = survey.photographs[0].name, {one: other, other: one}
    return replace(
        survey,
        observations=tuple(
            replace(each, point=names.get(each.point, each.point)) if each.photo == photo else each
            for each in survey.observations
        ),
    )


@pytest.mark.parametrize("count", [8, 12])
@pytest.mark.parametrize("seed", range(2))
def test_two_exchanged_references_of_two_photographs_are_named(seed: int, count: int) -> None:
    survey = made(seed, count=count)
    one, other = survey.references[0].name, survey.references[5 if count > 8 else 7].name
    wrong = exchanged(survey, one, other)
    assert {each.point for each in astray(wrong)} == {one, other}
    solution = solve(wrong)
    assert {each.observation.point for each in solution.suspects[:2]} == {one, other}
    assert any("exchanged" in remark and repr(one) in remark and repr(other) in remark for remark in solution.remarks)
    assert solution.chi2_per_dof < 2.0
    assert len(solution.residuals) == len(survey.observations)
    assert solution.survey is wrong


def test_exchanged_corners_of_a_cube_are_found() -> None:
    survey = made(4, count=8)
    assert astray(survey) == ()
    corners = [each for each in survey.observations[:14] if each.point.startswith("c") and each.photo == "view1.jpg"]
    assert len(corners) == 8
    for first, second in list(combinations(corners, 2))[::3]:
        one, other = first.point, second.point
        if np.hypot(first.u - second.u, first.v - second.v) < 25.0:
            continue  # one before the other: another turn of the camera explains it
        assert {each.point for each in astray(exchanged(survey, one, other))} == {one, other}


def test_exchanged_corners_of_which_one_is_hidden_are_named_and_the_photograph_keeps_its_camera() -> None:
    survey = made(4, count=8)
    hidden = survey.references[7].name
    survey = replace(survey, observations=tuple(each for each in survey.observations if each.point != hidden))
    one, other = survey.references[0].name, survey.references[6].name
    solution = solve(exchanged(survey, one, other))
    assert {each.observation.point for each in solution.suspects} == {one, other}
    assert any("exchanged" in remark and repr(one) in remark and repr(other) in remark for remark in solution.remarks)
    right = solve(survey)
    for key, point in right.points.items():
        assert np.linalg.norm(point.place - solution.points[key].place) < 1e-3


def test_one_click_far_off_is_found_alone() -> None:
    survey = made(1)
    far = replace(survey.observations[3], u=survey.observations[3].u + 200.0)
    clicks = tuple(far if number == 3 else each for number, each in enumerate(survey.observations))
    assert astray(replace(survey, observations=clicks)) == (far,)


def test_right_clicks_bent_lenses_and_boards_are_left_alone() -> None:
    for seed in range(20):
        assert astray(made(seed, views=3, count=20)) == ()
        assert astray(made(seed, count=8)) == ()
        setup = Setup(references=cube(count=20), points=4, views=2, k1=-0.3, sigma_px=0.3)
        assert astray(simulate(setup, seed).survey) == ()
    flat = [replace(each, target="world") for each in board()]
    assert astray(simulate(Setup(references=tuple(flat), points=4, views=2), 0).survey) == ()


def test_a_right_click_that_was_left_out_is_no_suspect() -> None:
    survey = made(2, views=3)
    out = survey.observations[:1]
    solution = put_back(solve(without(survey, out)), survey, out)
    assert solution.suspects == ()
    (residual,) = [each for each in solution.residuals if each.observation == out[0]]
    assert np.hypot(residual.du, residual.dv) < 5.0
