"""A folder as a survey: clicked points, corners of boards, and what contradicts."""

from __future__ import annotations

from pathlib import Path

import pytest
from PIL import Image
from project_folders import POINTS, REFERENCES, TOML, make_folder

import mien.capture
from mien.capture.project import read_project, read_survey, solve_project
from mien.capture.records import Observation
from mien.core import LoadError, MienError, UnknownNameError

BOARD = '[[board]]\nkind = "chessboard"\ncolumns = 4\nrows = 3\nsquare = 25\ntarget = "card"\n'


def test_a_folder_is_a_survey(tmp_path: Path) -> None:
    survey = read_survey(make_folder(tmp_path / "anna"))
    assert [photo.name for photo in survey.photographs] == ["front.jpg", "left.jpg"]
    assert survey.observations[1] == Observation("left.jpg", "nose", 180.0, 150.0, 0.5, 3)
    assert [(each.name, each.x, each.sigma_m) for each in survey.references] == [("near", 0, 0), ("far", 0.254, 0.0005)]
    assert mien.capture.read_survey(tmp_path / "anna") == survey


def test_references_may_be_left_out_and_points_not(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna", references=None)
    assert read_survey(folder).references == ()
    (folder / "points.csv").unlink()
    with pytest.raises(LoadError, match=r"points\.csv: there is no such file — want rows photo,point,u,v,sigma"):
        read_survey(folder)


def test_corners_of_boards_that_were_found_before(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna", toml=f"{TOML}\n{BOARD}")
    assert len(read_survey(folder).observations) == 2
    (folder / "boards.csv").write_text("photo,point,u,v,sigma\nfront.jpg,card:0:1,10,20,0.1\n")
    survey = read_survey(folder)
    assert survey.observations[2] == Observation("front.jpg", "card:0:1", 10.0, 20.0, 0.1, 2)
    corner = next(each for each in survey.references if each.name == "card:0:1")
    assert (corner.x, corner.y, corner.target) == (0.025, 0.025, "card")
    assert len(survey.references) == 2 + 3 * 2
    (folder / "points.csv").unlink()
    assert len(read_survey(folder).observations) == 1


@pytest.mark.parametrize(
    ("file", "text", "wanted"),
    [
        ("boards.csv", "photo,point,u,v\nfront.jpg,card:2:1,1,2\n",
         r"boards\.csv:2: there is no corner 'card:2:1' on the board — find them again: mien capture boards"),
        ("boards.csv", "photo,point,u,v\nfront.jpg,crad:1:1,1,2\n",
         r"boards\.csv:2: unknown board 'crad' — did you mean 'c"),
        ("boards.csv", "photo,point,u,v\nleft.jpg,nose,1,2\n", r"boards\.csv:2: unknown board 'nose'"),
        ("points.csv", "photo,point,u,v\n\nfront.jpg,card:0:0,1,2\n",
         r"boards\.csv:2: point 'card:0:0' of front\.jpg stands in points\.csv:3 too"),
        ("references.csv", "point,x,y,z\ncard:0:0,1,2,3\n",
         r"references\.csv: 'card:0:0' is a corner of the board 'card'"),
    ],
)  # fmt: skip
def test_boards_that_contradict_other_files(tmp_path: Path, file: str, text: str, wanted: str) -> None:
    folder = make_folder(tmp_path / "anna", toml=f"{TOML}\n{BOARD}")
    (folder / "boards.csv").write_text("photo,point,u,v\nfront.jpg,card:0:0,1,2\n")
    (folder / file).write_text(text)
    with pytest.raises(LoadError, match=wanted):
        read_survey(folder)


def test_the_same_picture_under_two_names(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna", toml=TOML.replace("[400, 300]", "[40, 30]"), points="photo,point,u,v\n")
    (folder / "photographs").mkdir()
    for name in ("front.jpg", "photographs/left.jpg"):
        Image.new("RGB", (40, 30)).save(folder / name)
    with pytest.raises(LoadError, match=r"project\.toml: front\.jpg and left\.jpg are the same picture"):
        read_project(folder)
    Image.new("RGB", (40, 30), "red").save(folder / "front.jpg")
    assert read_project(folder).photographs[1].path == folder / "photographs" / "left.jpg"


def test_a_size_that_is_not_that_of_the_picture(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna")
    Image.new("RGB", (300, 400)).save(folder / "left.jpg")
    with pytest.raises(
        LoadError, match=r":14: \[photograph\] size: says 400x300, but left\.jpg is 300x400 pixels upright"
    ):
        read_project(folder)


def test_a_method_that_is_none(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna")
    with pytest.raises(UnknownNameError, match="did you mean 'appendix-c'"):
        solve_project(folder, method="appendix-d")
    pair = '[pair]\nfront = "front.jpg"\nside = "left.jpg"\n'
    make_folder(folder, toml=f"{TOML}\n{pair}", points=POINTS, references=REFERENCES)
    with pytest.raises(LoadError, match=r"has a \[pair\], which is solved in its own way, not by metric"):
        solve_project(folder, method="metric")


def test_photographs_without_corners_are_told(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna", toml=f"{TOML}\n{BOARD}")
    (folder / "boards.csv").write_text("photo,point,u,v\nfront.jpg,card:0:0,1,2\n")
    told: list[str] = []
    with pytest.raises(MienError):
        solve_project(folder, report=told.append)
    assert told[0] == f"no corners of 'card' in left.jpg; to look again: mien capture boards {folder}"


def test_boards_are_looked_for_when_they_were_not_yet(tmp_path: Path) -> None:
    folder = make_folder(tmp_path / "anna", toml=f"{TOML}\n{BOARD}")
    told: list[str] = []
    with pytest.raises(MienError, match=r"front\.jpg: the file is not there to look for the board 'card' in"):
        solve_project(folder, report=told.append)
    assert told == ["looking for boards"]
    assert not (folder / "boards.csv").exists()
