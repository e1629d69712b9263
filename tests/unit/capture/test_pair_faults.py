"""Pairs of photographs that are none, or that tell too little: what is said."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mien.capture.pair import solve_pair
from mien.capture.pair_simulating import PairSetup, marks_of_head, simulate_pair
from mien.capture.records import Observation, Reference, Survey
from mien.core import MienError, UnknownNameError

FRONT, SIDE = "front.jpg", "side.jpg"
MARKS = marks_of_head(40, seed=3)
BOTH = marks_of_head(40, seed=3, both_sides=True)


def survey_of_half() -> Survey:
    return simulate_pair(PairSetup(), MARKS)[0]


def ends(survey: Survey) -> tuple[str, str, float]:
    seen = [{each.point for each in survey.observations if each.photo == photo} for photo in (FRONT, SIDE)]
    low, *_, high = sorted(seen[0] & seen[1], key=lambda name: (MARKS.places | BOTH.places)[name][1])
    return low, high, 0.1


def fault(survey: Survey, **options: object) -> str:
    clicked = {each.point for each in survey.observations}
    options = {
        "front": FRONT,
        "side": SIDE,
        "scale": ends(survey),
        "midline": [name for name in MARKS.midline if name in clicked],
    } | options
    with pytest.raises(MienError) as caught:
        solve_pair(survey, **options)  # type: ignore[arg-type]
    return str(caught.value)


def changed(survey: Survey, photo: str, u: float = 1.0, v: float = 1.0) -> Survey:
    """The same with a photograph mirrored (-1) in u or v."""
    width, height = survey.photograph(photo).size_px
    return replace(
        survey,
        observations=tuple(
            replace(each, u=0.5 * width + u * (each.u - 0.5 * width), v=0.5 * height + v * (each.v - 0.5 * height))
            if each.photo == photo
            else each
            for each in survey.observations
        ),
    )


def test_front_and_side_exchanged() -> None:
    assert "seem exchanged" in fault(survey_of_half(), front=SIDE, side=FRONT)


@pytest.mark.parametrize("photo", [FRONT, SIDE])
def test_a_mirrored_photograph(photo: str) -> None:
    assert "mirrored" in fault(changed(survey_of_half(), photo, u=-1.0))


def test_a_mirrored_front_where_names_tell_the_sides() -> None:
    survey, _ = simulate_pair(PairSetup(), BOTH)
    assert "left points stand at the face's right" in fault(changed(survey, FRONT, u=-1.0), midline=())


def test_two_names_exchanged_between_left_and_right() -> None:
    survey, _ = simulate_pair(PairSetup(), BOTH)
    pairs = {each.point for each in survey.observations if each.photo == FRONT and each.point.endswith(".left")}
    name = sorted(pairs)[0].removesuffix(".left")
    other = {f"{name}.left": f"{name}.right", f"{name}.right": f"{name}.left"}
    swapped = replace(
        survey,
        observations=tuple(
            replace(each, point=other.get(each.point, each.point)) if each.photo == FRONT else each
            for each in survey.observations
        ),
    )
    message = fault(swapped, midline=())
    assert f"'{name}.left' stands to the right of '{name}.right'" in message


def test_a_photograph_upside_down_or_lying_on_its_side() -> None:
    assert "upside down" in fault(changed(survey_of_half(), SIDE, u=-1.0, v=-1.0))
    survey = survey_of_half()
    lying = tuple(replace(each, u=each.v, v=each.u) if each.photo == SIDE else each for each in survey.observations)
    message = fault(replace(survey, observations=lying))
    assert "lying on its side" in message or "exchanged" in message


def test_too_few_points_in_common() -> None:
    survey = survey_of_half()
    seen = [{each.point for each in survey.observations if each.photo == photo} for photo in (FRONT, SIDE)]
    few = set(sorted(seen[0] & seen[1])[:5])
    kept = tuple(each for each in survey.observations if each.photo == FRONT or each.point in few)
    message = fault(replace(survey, observations=kept), scale=None)
    assert "5 points in common" in message
    assert "orthographic" in message


def test_no_length_no_midline_and_no_such_names() -> None:
    survey = survey_of_half()
    assert "how large the face is" in fault(survey, scale=None)
    assert "symmetry plane" in fault(survey, midline=())
    assert "unknown photograph 'fron.jpg'" in fault(survey, front="fron.jpg")
    assert "unknown point" in fault(survey, midline=("bridge",))
    assert "unknown side" in fault(survey, side_from="lef")
    assert "unknown photograph of a camera distance" in fault(survey, camera_distance_m={"frnt.jpg": 1.0})
    assert "more than 0" in fault(survey, camera_distance_m={FRONT: 0.0})
    low, high, _ = ends(survey)
    assert "more than 0" in fault(survey, scale=(low, high, -1.0))
    assert "to itself" in fault(survey, scale=(low, low, 0.1))
    with pytest.raises(UnknownNameError):
        solve_pair(survey, front=FRONT, side=SIDE, scale=(low, "nowhere", 0.1), midline=[low])


def test_a_told_side_that_cannot_be() -> None:
    assert "told to be taken from the face's own right" in fault(survey_of_half(), side_from="right")


def test_a_length_too_short_to_scale_by() -> None:
    survey = survey_of_half()
    both = [{each.point for each in survey.observations if each.photo == photo} for photo in (FRONT, SIDE)]
    names = sorted(both[0] & both[1])
    pairs = [(one, other) for one in names for other in names if one < other]
    low, near = min(pairs, key=lambda pair: float(np.linalg.norm(MARKS.places[pair[0]] - MARKS.places[pair[1]])))
    assert "tell a longer one" in fault(survey, scale=(low, near, 0.005))


def test_one_photograph_twice_and_two_moments() -> None:
    survey = survey_of_half()
    assert "the same photograph" in fault(survey, side=FRONT)
    front, side = survey.photographs
    message = fault(replace(survey, photographs=(front, replace(side, moment="smile"))))
    assert "'smile'" in message
    twice = (*survey.observations, replace(survey.observations[0], line=7))
    assert "points.csv:7" in fault(replace(survey, observations=twice))


def test_the_length_between_references_scales_where_none_is_told() -> None:
    survey = survey_of_half()
    low, high, length = ends(survey)
    references = (Reference(low, 0.0, 0.0, 0.0), Reference(high, 0.0, length, 0.0))
    midline = [name for name in MARKS.midline if name in {each.point for each in survey.observations}]
    options = {"front": FRONT, "side": SIDE, "midline": midline}
    told = solve_pair(survey, scale=(low, high, length), **options)  # type: ignore[arg-type]
    found = solve_pair(replace(survey, references=references), **options)  # type: ignore[arg-type]
    for key, point in told.points.items():
        np.testing.assert_allclose(found.points[key].place, point.place, atol=1e-5)


def test_other_photographs_of_a_survey_take_no_part() -> None:
    survey = survey_of_half()
    third = replace(survey.photographs[0], name="third.jpg")
    more = replace(
        survey,
        photographs=(*survey.photographs, third),
        observations=(*survey.observations, Observation("third.jpg", "elsewhere", 1.0, 1.0)),
    )
    midline = [name for name in MARKS.midline if name in {each.point for each in survey.observations}]
    solution = solve_pair(more, front=FRONT, side=SIDE, scale=ends(survey), midline=midline)
    assert set(solution.cameras) == {FRONT, SIDE}
    assert ("rest", "elsewhere") not in solution.points
