"""What is told of surveys that cannot be solved, or only weakly: who, where, what was wanted, what to add."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
import pytest

from mien.capture.checking import check
from mien.capture.checking_solved import remarks_on
from mien.capture.projecting import project
from mien.capture.records import Camera, Lens, Observation, Photograph, Reference, Survey
from mien.capture.simulating import Setup, board, cube, face_points, simulate
from mien.capture.solving import solve
from mien.core import MienError

CORNERS = [each.name for each in cube()]


@pytest.fixture(scope="module")
def survey() -> Survey:
    """A cube and a face in three photographs, nothing wrong."""
    return simulate(Setup(references=cube(), points=30, views=3), 2).survey


def keep(survey: Survey, wanted: Callable[[Observation], bool]) -> Survey:
    return replace(survey, observations=tuple(each for each in survey.observations if wanted(each)))


def rename(survey: Survey, photo: str, names: Mapping[str, str]) -> Survey:
    return replace(
        survey,
        observations=tuple(
            replace(each, point=names.get(each.point, each.point)) if each.photo == photo else each
            for each in survey.observations
        ),
    )


def mirror(survey: Survey, axis: str) -> Survey:
    return replace(
        survey, references=tuple(replace(each, **{axis: -getattr(each, axis)}) for each in survey.references)
    )


def refusal(survey: Survey) -> str:
    with pytest.raises(MienError) as error:
        check(survey)
    return str(error.value)


def look_at(angle_deg: float, places: Mapping[str, np.ndarray], name: str) -> list[Observation]:
    """Clicks without error of a camera two metres away that stands so far around the origin."""
    angle = np.radians(angle_deg)
    place = 2.0 * np.array([np.sin(angle), 0.0, np.cos(angle)])
    rotation = np.array([[np.cos(angle), 0.0, -np.sin(angle)], [0.0, -1.0, 0.0], [-np.sin(angle), 0.0, -np.cos(angle)]])
    camera = Camera(Lens(5000.0, (2000.0, 1500.0)), rotation, place)
    pictures = project(camera, np.array(list(places.values())))
    return [Observation(name, point, float(u), float(v)) for point, (u, v) in zip(places, pictures, strict=True)]


def seen_from(*angles_deg: float) -> Survey:
    references = cube()
    places = {each.name: np.array([each.x, each.y, each.z]) for each in references}
    places |= {f"p{number}": place for number, place in enumerate(face_points(12)[0])}
    names = [f"view{number}.jpg" for number in range(len(angles_deg))]
    clicks = [click for angle, name in zip(angles_deg, names, strict=True) for click in look_at(angle, places, name)]
    return Survey(tuple(Photograph(name, (4000, 3000), "a") for name in names), tuple(clicks), references)


def test_good_survey_gets_no_remark(survey):
    assert check(survey) == ()
    assert remarks_on(solve(survey)) == ()


def test_five_reference_points_are_too_few(survey):
    text = refusal(keep(survey, lambda each: each.point not in CORNERS[5:]))
    assert "'view1.jpg' shows 5 references (c000, c001, c010, c011, c100)" in text
    assert "want 6 in one photograph" in text
    assert "click c101, c110, c111 too" in text


def test_five_in_some_photographs_do_where_another_shows_six(survey):
    check(keep(survey, lambda each: each.point not in CORNERS[5:] or each.photo == "view2.jpg"))


def test_corners_of_a_board_are_not_too_few_at_four():
    setup = Setup(references=board(columns=3, rows=2), points=4, views=3)
    survey = simulate(setup, 1).survey
    check(survey)
    bare = keep(survey, lambda each: each.point in {"board 0 0", "board 1 0", "p001"})
    assert "want 4 in one photograph" in refusal(bare)


def test_survey_without_references_is_told_what_to_put_where(survey):
    text = refusal(replace(survey, references=()))
    assert "references.csv" in text
    assert "[[board]]" in text
    assert "[pair]" in text


def test_references_that_nobody_clicked(survey):
    text = refusal(keep(survey, lambda each: each.point not in CORNERS))
    assert "no photograph shows a reference" in text
    assert "c000" in text
    assert "p001" in text


def test_references_on_one_line(survey):
    line = tuple(replace(each, x=0.01 * number, y=0.0, z=0.0) for number, each in enumerate(survey.references))
    assert "lie on one line" in refusal(replace(survey, references=line))


def test_references_on_one_plane_are_weak(survey):
    flat = [each for each in cube(count=20) if each.name[3] == "0"]
    assert len(flat) == 8
    simulated = simulate(Setup(references=tuple(flat), points=10, views=3), 1).survey
    (remark,) = check(simulated)
    assert "the 8 references lie on one plane" in remark
    assert "before or behind it" in remark


def test_two_references_in_one_place(survey):
    copied = (*survey.references, replace(survey.references[0], name="again"))
    remarks = check(replace(survey, references=copied))
    assert any("'c000' and 'again'" in each and "row copied" in each for each in remarks)


def test_references_in_a_corner_of_the_picture():
    references = tuple(replace(each, x=each.x - 0.3, y=each.y - 0.3) for each in cube(0.05))
    (remark,) = check(simulate(Setup(references=references, points=20, views=2), 1).survey)
    assert "keep to a part of the picture in view1.jpg, view2.jpg" in remark
    assert "on the other sides of the face" in remark


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_cube_labelled_mirrorwise(survey, axis):
    text = refusal(mirror(survey, axis))
    assert "mirror-wise" in text
    assert "'view1.jpg', 'view2.jpg', 'view3.jpg'" in text
    # The photographs look along z, so that x is what lies from left to right in them.
    assert "change the sign of all x in references.csv" in text
    assert "c000 and c100, c001 and c101, c010 and c110, c011 and c111" in text


def test_cure_for_a_mirrored_cube_is_one(survey):
    exchanged = {name: f"c{1 - int(name[1])}{name[2:]}" for name in CORNERS}
    wrong = survey
    for photograph in survey.photographs:
        wrong = rename(wrong, photograph.name, exchanged)
    assert "mirror-wise" in refusal(wrong)
    check(mirror(wrong, "x"))


@pytest.mark.parametrize("mirrored", [False, True])
def test_hands_are_told_apart_with_the_clicks_of_1974_and_with_mis_clicks(mirrored):
    coarse = Setup(references=cube(), points=5, views=3, size_px=(1400, 1100), sigma_px=5.0)
    wrong = Setup(references=cube(count=20), points=5, views=3, mis_clicks=0.08, mis_click_sigmas=150.0)
    far = Setup(references=cube(count=20), points=5, views=3, distance_m=6.0)
    for setup in (coarse, wrong, far):
        simulated = simulate(setup, 3).survey
        if mirrored:
            assert "mirror-wise" in refusal(mirror(simulated, "z"))
        else:
            check(simulated)


def test_one_photograph_labelled_mirrorwise(survey):
    exchanged = {name: f"c{1 - int(name[1])}{name[2:]}" for name in CORNERS}
    text = refusal(rename(survey, "view2.jpg", exchanged))
    assert "photograph 'view2.jpg': references are named mirror-wise there, and rightly in the others" in text


def test_same_photograph_twice(survey):
    copy = replace(survey.photographs[0], name="copy.jpg")
    clicks = tuple(replace(each, photo="copy.jpg") for each in survey.observations if each.photo == "view1.jpg")
    text = refusal(
        replace(survey, photographs=(*survey.photographs, copy), observations=(*survey.observations, *clicks))
    )
    assert "'view1.jpg' and 'copy.jpg'" in text
    assert "all 38 points" in text


def test_camera_on_its_stand_sees_the_cube_where_it_was(survey):
    first = replace(survey.photographs[0], fixed=True)
    smile = replace(first, name="smile.jpg", moment="smile")
    cubes = [each for each in survey.observations if each.photo == first.name and each.point in CORNERS]
    clicks = tuple(replace(each, photo="smile.jpg") for each in cubes)
    photographs = (first, smile, *survey.photographs[1:])
    check(replace(survey, photographs=photographs, observations=(*survey.observations, *clicks)))


def test_photographs_of_one_camera_have_one_size(survey):
    first = replace(survey.photographs[0], size_px=(3000, 4000))
    text = refusal(replace(survey, photographs=(first, *survey.photographs[1:])))
    assert "camera 'a': photograph 'view2.jpg' is 4000 × 3000 px" in text


def test_points_that_one_photograph_shows_are_told_together(survey):
    alone = {"p003", "p004"}
    few = keep(survey, lambda each: each.point not in alone or each.photo == "view1.jpg")
    (remark,) = check(few)
    assert "2 points clicked in one photograph only, without a place: p003, p004" in remark
    assert sum("p003" in each for each in solve(few).remarks) == 1


def test_reference_that_is_not_seen_is_told_with_what_it_may_be_called(survey):
    wrong = survey
    for photograph in survey.photographs:
        wrong = rename(wrong, photograph.name, {"c000": "co00"})
    (remark,) = check(wrong)
    assert "no photograph shows c000" in remark
    assert "is 'c000' by 'co00' meant?" in remark


def test_views_that_are_nearly_parallel():
    remarks = remarks_on(solve(seen_from(-1.0, 1.0)))
    assert len(remarks) == 1
    assert remarks[0].startswith("all 12 points")
    assert "'view0.jpg' and 'view1.jpg') at 2." in remarks[0]
    assert "20° or more to the side" in remarks[0]
    assert remarks_on(solve(seen_from(-10.0, 10.0))) == ()


@pytest.mark.parametrize(("one", "other"), [("p005", "p020"), ("c000", "c010")])
def test_names_exchanged_in_one_photograph(survey, one, other):
    solution = solve(rename(survey, "view2.jpg", {one: other, other: one}))
    (remark,) = remarks_on(solution)
    assert "photograph 'view2.jpg'" in remark
    assert {one, other} <= set(remark.split("'"))
    assert "seem exchanged" in remark
    assert remark in solution.remarks


def test_names_exchanged_in_one_of_two_photographs():
    two = simulate(Setup(references=cube(), points=30, views=2), 2).survey
    (remark,) = remarks_on(solve(rename(two, "view2.jpg", {"p005": "p020", "p020": "p005"})))
    assert "photograph 'view1.jpg' or 'view2.jpg': 'p005' and 'p020' seem exchanged" in remark


def test_names_exchanged_in_a_round(survey):
    solution = solve(rename(survey, "view2.jpg", {"p005": "p020", "p020": "p007", "p007": "p005"}))
    told = remarks_on(solution)
    assert len(told) == 3
    assert any("'p020' is clicked where 'p005' is" in each for each in told)


def test_name_that_belongs_to_another_point(survey):
    without = keep(survey, lambda each: (each.photo, each.point) != ("view2.jpg", "p020"))
    lines = replace(
        without, observations=tuple(replace(each, line=k + 2) for k, each in enumerate(without.observations))
    )
    (remark,) = remarks_on(solve(rename(lines, "view2.jpg", {"p005": "p020"})))
    line = next(each.line for each in lines.observations if (each.photo, each.point) == ("view2.jpg", "p005"))
    assert remark == f"photograph 'view2.jpg' (line {line}): 'p020' is clicked where 'p005' is — rename it"


def test_mis_clicks_are_no_exchange():
    wrong = simulate(Setup(references=cube(count=20), points=30, views=4, mis_clicks=0.04, mis_click_sigmas=40.0), 2)
    solution = solve(wrong.survey)
    assert len(solution.suspects) >= 5
    assert remarks_on(solution) == ()


def test_unit_that_makes_a_giant(survey):
    giant = replace(
        survey,
        references=tuple(Reference(each.name, *(1000.0 * v for v in (each.x, each.y, each.z))) for each in cube()),
    )
    (remark,) = remarks_on(solve(giant))
    assert "is the unit of the references in project.toml right?" in remark


def test_points_of_many_moments_that_one_photograph_shows_are_one_remark():
    simulated = simulate(Setup(references=cube(), points=9, views=2, moments=3), 2).survey
    few = keep(simulated, lambda each: each.point not in ("p003", "p004") or "view1" in each.photo)
    (remark,) = check(few)
    assert (
        "6 points clicked in one photograph only, 2 of m01, 2 of m02, 2 of m03, without a place: p003, p004" in remark
    )
