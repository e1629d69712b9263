"""Files broken by chance: a survey, or one clear error that names the file; never anything else."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from project_folders import POINTS, REFERENCES, TOML, make_folder, make_solution

from mien.capture.dltdv import read_clicks
from mien.capture.project import read_project, read_solution, read_survey, write_solution
from mien.capture.records import SolvedPoint
from mien.core import LoadError

BOARD = '[[board]]\nkind = "chessboard"\ncolumns = 4\nrows = 3\nsquare = 25\ntarget = "card"\n'
PAIR = '[pair]\nfront = "front.jpg"\nside = "left.jpg"\nscale = ["a", "b", 92.0]\ntwins = { a = "b" }\n'
FULL = f"{TOML}\n{BOARD}\n{PAIR}"

WORDS = ("nan", "-1e999", "1e308", "0x10", "true", "photo", "1979-05-27")
MARKS = (*',;=[]{#"', "[[", "\\", '"""', "\t", "\ufeff", "\ud7ff", "\u00e9")
ENDS = ("", "\0", "\n", "\r", "\x0b", "\x85", "\u2028")
PIECES = st.sampled_from((*WORDS, *MARKS, *ENDS, "9" * 400, "9" * 5000, "[" * 3000))


def broken(text: str, data: st.DataObject) -> str:
    for _ in range(data.draw(st.integers(1, 3))):
        first, second = sorted(data.draw(st.tuples(*[st.integers(0, len(text))] * 2)))
        second = min(second, first + data.draw(st.integers(0, 12)))
        text = text[:first] + data.draw(PIECES) + text[second:]
    return text


@given(st.data())
@pytest.mark.parametrize("name", ["project.toml", "points.csv", "references.csv", "boards.csv"])
def test_what_people_edit(tmp_path_factory: pytest.TempPathFactory, name: str, data: st.DataObject) -> None:
    folder = make_folder(tmp_path_factory.mktemp("anna"), toml=FULL)
    (folder / "boards.csv").write_text("photo,point,u,v\nfront.jpg,card:0:1,10,20\n")
    text = (folder / name).read_text()
    (folder / name).write_text(broken(text, data), encoding="utf-8", newline="")
    try:
        survey = read_survey(folder)
    except LoadError as error:
        told = str(error)
    else:
        assert all(np.isfinite([each.u, each.v, each.sigma_px]).all() for each in survey.observations)
        return
    assert told.startswith(str(folder)) or name == "project.toml"


@given(st.data())
@pytest.mark.parametrize("name", ["solution.json", "cameras.json", "points.csv", "residuals.csv"])
def test_what_we_wrote(tmp_path_factory: pytest.TempPathFactory, name: str, data: st.DataObject) -> None:
    folder = make_folder(tmp_path_factory.mktemp("anna"))
    point = SolvedPoint("nose", "smile", np.array([0.1, 0.2, 0.3]), np.eye(3) * 1e-8, ("front.jpg", "left.jpg"))
    write_solution(folder, make_solution(read_survey(folder), [point]))
    path = folder / "solution" / name
    path.write_text(broken(path.read_text(), data), encoding="utf-8", newline="")
    try:
        read_solution(folder)
    except LoadError as error:
        told = str(error)
    else:
        return
    assert str(folder / "solution") in told


@given(st.data())
def test_what_other_programs_wrote(tmp_path_factory: pytest.TempPathFactory, data: st.DataObject) -> None:
    folder = make_folder(tmp_path_factory.mktemp("anna"), toml=TOML, points=POINTS, references=REFERENCES)
    path = folder / "t_xypts.csv"
    text = "pt1_cam1_X,pt1_cam1_Y,pt1_cam2_X,pt1_cam2_Y\n1,2,NaN,NaN\nNaN,NaN,NaN,NaN\n"
    path.write_text(broken(text, data), encoding="utf-8", newline="")
    project = read_project(folder)
    try:
        found = read_clicks(path, project.photographs)
    except LoadError as error:
        told = str(error)
    else:
        assert len(found) <= 2
        return
    assert told.startswith(str(path))


@pytest.mark.parametrize("value", ["1e400", "-inf", "1979-05-27", "[1, 2]", "'''x'''", "true", "9" * 400, "9" * 5000])
@pytest.mark.parametrize("key", ["file", "size", "moment", "camera", "fixed", "square", "columns", "scale", "unit"])
def test_values_of_another_kind(tmp_path: Path, key: str, value: str) -> None:
    lines = [f"{key} = {value}" if line.startswith(f"{key} = ") else line for line in FULL.splitlines()]
    try:
        read_project(make_folder(tmp_path / "anna", toml="\n".join(lines)))
    except LoadError as error:
        told = str(error)
    else:
        return
    assert "project.toml" in told
    assert key in told or "is not TOML: " in told
    assert len(told) < 600
