"""solution/: what is written comes back, and nothing else is written over."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from project_folders import make_folder, make_solution

from mien.capture.project import read_solution, read_survey, write_solution
from mien.capture.project_solution import solution_texts
from mien.capture.records import Observation, Solution, SolvedPoint, Survey
from mien.core import LoadError, MienError

NUMBERS = st.floats(-1.0, 1.0)


@st.composite
def solved_points(draw: st.DrawFn) -> SolvedPoint:
    place = np.array([draw(NUMBERS) for _ in range(3)])
    root = np.array([[draw(NUMBERS) for _ in range(3)] for _ in range(3)]) * 1e-3
    name = draw(st.text(st.characters(codec="utf-8", exclude_categories=["Cc", "Cs", "Z"]), min_size=1, max_size=6))
    kind = draw(st.sampled_from(["measured", "mirrored", "symmetric"]))
    return SolvedPoint(name, "smile", place, root @ root.T, ("front.jpg", "left.jpg"), kind)


def the_same(found: Solution, wanted: Solution) -> None:
    assert found.points.keys() == wanted.points.keys()
    for key, point in wanted.points.items():
        other = found.points[key]
        assert (other.photos, other.kind) == (point.photos, point.kind)
        np.testing.assert_allclose(other.place, point.place, rtol=1e-8, atol=1e-15)
        size = max(float(np.abs(point.covariance).max()), 1e-300)
        np.testing.assert_allclose(other.covariance, point.covariance, atol=2e-6 * size)
    assert found.cameras.keys() == wanted.cameras.keys()
    for name, camera in wanted.cameras.items():
        assert found.cameras[name].lens == camera.lens
        np.testing.assert_allclose(found.cameras[name].rotation, camera.rotation, atol=1e-14)
        np.testing.assert_allclose(found.cameras[name].place, camera.place, rtol=1e-11)
    assert found.residuals == wanted.residuals
    assert found.suspects == wanted.suspects
    assert (found.chi2_per_dof, found.remarks, found.method) == (wanted.chi2_per_dof, wanted.remarks, wanted.method)


@given(st.lists(solved_points(), max_size=4), st.sampled_from(["mm", "m", "inch"]))
def test_a_solution_comes_back(tmp_path_factory: pytest.TempPathFactory, points: list[SolvedPoint], unit: str) -> None:
    folder = make_folder(tmp_path_factory.mktemp("anna"))
    survey = read_survey(folder)
    solution = make_solution(survey, points, survey.observations[1:])
    write_solution(folder, solution, unit)
    the_same(read_solution(folder), solution)
    assert solution_texts(folder, solution, unit) == {
        path.name: path.read_text(encoding="utf-8") for path in (folder / "solution").iterdir()
    }


def test_files_are_for_people_and_spreadsheets(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna")
    survey = read_survey(folder)
    covariance = np.array([[4e-8, 1e-8, 0.0], [1e-8, 1e-8, 0.0], [0.0, 0.0, 9e-8]])
    point = SolvedPoint("nose", "smile", np.array([0.01, -0.02, 1 / 3]), covariance, ("front.jpg", "left.jpg"))
    write_solution(folder, make_solution(survey, [point], survey.observations[:1]))
    place = folder / "solution"
    assert (place / "points.csv").read_text().splitlines() == [
        "moment,point,x,y,z,sx,sy,sz,xy,xz,yz,photos,kind",
        "smile,nose,10,-20,333.333333,0.2,0.1,0.3,0.5,0,0,front.jpg | left.jpg,measured",
    ]
    assert (place / "residuals.csv").read_text().splitlines() == [
        "photo,point,u,v,sigma,du,dv,statistic,suspect,line",
        "front.jpg,nose,200.5,150.25,1,0.25,-0.5,1.5,yes,2",
        "left.jpg,nose,180,150,0.5,0.25,-0.5,1.5,,3",
    ]
    cameras = json.loads((place / "cameras.json").read_text())
    assert [camera["photo"] for camera in cameras["cameras"]] == ["front.jpg", "left.jpg"]
    assert json.loads((place / "solution.json").read_text())["remarks"] == ["Lens: as told."]


def test_a_solution_of_files_that_have_changed_since_says_so(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna")
    solution = make_solution(read_survey(folder))
    write_solution(folder, solution)
    with (folder / "points.csv").open("a") as file:
        file.write("left.jpg,chin,20,30,\n")
    found = read_solution(folder)
    assert found.remarks[1] == "points.csv has changed since this was solved: mien capture solve finds it anew."
    assert found.residuals == solution.residuals
    (folder / "references.csv").unlink()
    assert read_solution(folder).remarks[1].startswith("points.csv and references.csv have changed")


def test_other_files_in_the_folder_are_not_written_over(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna")
    solution = make_solution(read_survey(folder))
    write_solution(folder, solution)
    write_solution(folder, solution)
    (folder / "solution" / "thesis.txt").write_text("mine")
    with pytest.raises(MienError, match=r"holds other things \(thesis.txt\)"):
        write_solution(folder, solution)
    assert (folder / "solution" / "thesis.txt").read_text() == "mine"


@pytest.mark.parametrize(
    ("name", "text", "wanted"),
    [
        ("solution.json", "{", r"solution\.json:1: column 2: .* — want JSON"),
        ("solution.json", "{}", r"is no solution of this mien \('format'\) — find it again"),
        ("solution.json", "[]", "is no solution of this mien"),
        ("cameras.json", '{"cameras": [{"photo": "a"}]}', "is no solution of this mien"),
        ("points.csv", "moment,point\n", r"points\.csv:1: there is no column 'x'"),
        ("residuals.csv", "photo,point,u,v,sigma,du,dv,statistic,suspect,line\na,b,1,2,3,4,5,6,no,\n",
         r"residuals\.csv:2: column 'suspect': want yes or nothing, got 'no'"),
    ],
)  # fmt: skip
def test_a_damaged_solution_is_told(tmp_path: Path, name: str, text: str, wanted: str) -> None:
    folder = make_folder(tmp_path / "anna")
    write_solution(folder, make_solution(read_survey(folder)))
    (folder / "solution" / name).write_text(text)
    with pytest.raises(LoadError, match=wanted):
        read_solution(folder)


def test_there_may_be_none(tmp_path: Path) -> None:
    with pytest.raises(LoadError, match="there is no solution — find it first: mien capture solve"):
        read_solution(make_folder(tmp_path / "anna"))


def test_observations_outside_of_files_have_no_line(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna")
    survey = read_survey(folder)
    told = Survey(survey.photographs, (Observation("front.jpg", "chin", 1.0, 2.0),), ())
    write_solution(folder, make_solution(told))
    assert read_solution(folder).residuals[0].observation == told.observations[0]
