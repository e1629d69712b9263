"""``mien capture report``: from the folder of a project to its page."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from PIL import Image

from mien.capture.project import read_survey, write_solution
from mien.capture.project_points import format_points
from mien.capture.records import Solution
from mien.capture.simulating import Setup, cube, simulate
from mien.capture.solving import solve
from mien.cli import main

HEAD = 'format = "mien-capture"\nversion = 1\nname = "anna"\nunit = "mm"\n'
PHOTO = '[[photograph]]\nfile = "{}"\nsize = [400, 300]\ncamera = "a"\n'


@pytest.fixture(scope="module")
def solved(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project with pictures, solved."""
    folder = tmp_path_factory.mktemp("capture") / "anna"
    folder.mkdir()
    survey = simulate(Setup(references=cube(), points=12, views=3, size_px=(400, 300), sigma_px=0.2), 1).survey
    names = [each.name for each in survey.photographs]
    (folder / "project.toml").write_text(HEAD + "".join(PHOTO.format(name) for name in names), encoding="utf-8")
    (folder / "points.csv").write_text(format_points(survey.observations), encoding="utf-8")
    rows = (f"{each.name},{each.x * 1000},{each.y * 1000},{each.z * 1000},\n" for each in survey.references)
    (folder / "references.csv").write_text("point,x,y,z,sigma\n" + "".join(rows), encoding="utf-8")
    for number, name in enumerate(names):
        Image.new("RGB", (400, 300), (120, 110, 100 + 40 * number)).save(folder / name)
    solution: Solution = solve(read_survey(folder))
    write_solution(folder, solution)
    return folder


def test_page_lies_beside_the_solution(solved: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["capture", "report", str(solved)]) == 0
    text = (solved / "solution/report.html").read_text(encoding="utf-8")
    assert "<h1>anna</h1>" in text
    assert "12 points measured" in text
    assert text.count("data:image/jpeg;base64") == 3
    assert "report.html: 0." in capsys.readouterr().err


def test_page_of_another_name_without_pictures(
    solved: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bare = tmp_path / "anna"
    shutil.copytree(solved, bare)
    for picture in bare.glob("*.jpg"):
        picture.unlink()
    assert main(["capture", "report", str(bare), "-o", str(tmp_path / "page.html")]) == 0
    assert "data:image" not in (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "view1.jpg: the picture is not there" in capsys.readouterr().err


def test_project_that_was_not_solved_gets_no_page(
    solved: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bare = tmp_path / "anna"
    shutil.copytree(solved, bare, ignore=shutil.ignore_patterns("solution"))
    assert main(["capture", "report", str(bare), "-o", str(tmp_path / "page.html")]) == 2
    assert "mien capture solve" in capsys.readouterr().err
    assert not (tmp_path / "page.html").exists()


def test_page_is_html(solved: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["capture", "report", str(solved), "-o", "page.pdf"]) == 2
    assert ".html" in capsys.readouterr().err
