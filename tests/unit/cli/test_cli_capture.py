"""``mien capture``: from a folder to cameras and points, with known answers."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mien.capture.project import read_solution
from mien.capture.project_points import format_points, format_references
from mien.capture.project_records import Project
from mien.capture.project_toml import format_project
from mien.capture.simulating import Setup, Simulated, cube, simulate
from mien.cli import main

SETUP = Setup(references=cube(count=20), points=12, views=3)


@pytest.fixture(scope="module")
def simulated() -> Simulated:
    return simulate(SETUP, 5)


@pytest.fixture
def folder(simulated: Simulated, tmp_path: Path) -> Path:
    """The set-up as a project, with one click a hundred pixels off."""
    survey, place = simulated.survey, tmp_path / "anna"
    place.mkdir()
    (place / "project.toml").write_text(format_project(Project(place, "anna", survey.photographs)))
    wrong = [
        replace(each, u=each.u + 100.0) if number == 40 else each for number, each in enumerate(survey.observations)
    ]
    (place / "points.csv").write_text(format_points(wrong))
    (place / "references.csv").write_text(format_references(survey.references, "mm"))
    return place


def failure(capfd: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main(arguments) == 2
    out, err = capfd.readouterr()
    assert out == ""
    assert err.startswith("mien: ")
    return err


def test_solve_finds_points_and_names_the_wrong_click(
    folder: Path, simulated: Simulated, capfd: pytest.CaptureFixture[str]
) -> None:
    assert main(["capture", "solve", str(folder)]) == 0
    out, err = capfd.readouterr()
    assert out.startswith("metric: 3 photographs, 12 points, ")
    wrong = simulated.survey.observations[40]
    (line,) = [line for line in out.splitlines() if " px off (+" in line]
    number = 1 + (folder / "points.csv").read_text().splitlines().index(
        next(
            row
            for row in (folder / "points.csv").read_text().splitlines()
            if row.startswith(f"{wrong.photo},{wrong.point},")
        )
    )
    assert line.startswith(f"  {folder / 'points.csv'}:{number}: {wrong.point} in {wrong.photo} is ")
    assert f"{folder / 'solution'}: cameras.json, points.csv" in err
    solution = read_solution(folder)
    assert [each.observation.line for each in solution.suspects] == [number]
    errors = [np.linalg.norm(solution.points[key].place - place) for key, place in simulated.places.items()
              if solution.points[key].kind == "measured"]  # fmt: skip
    assert len(errors) == 12
    assert max(errors) < 0.0006


def test_solving_twice_writes_the_same_bytes(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    def texts() -> dict[str, str]:
        assert main(["capture", "solve", str(folder), "--quiet"]) == 0
        assert capfd.readouterr() == ("", "")
        return {path.name: path.read_text() for path in (folder / "solution").iterdir()}

    assert texts() == texts()


def test_solve_tells_programs_all_of_it(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["capture", "solve", str(folder), "--json", "--quiet"]) == 0
    out, err = capfd.readouterr()
    assert err == ""
    told = json.loads(out)
    assert (told["method"], len(told["points"]), len(told["suspects"])) == ("metric", 12, 1)
    assert 0.5 < told["rms_px"] < 2.0
    assert list(told["photographs"]) == [photo.name for photo in simulate(SETUP, 5).survey.photographs]


def test_mistakes_end_with_two_and_write_nothing(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert "unknown method 'apendix-c' — did you mean 'appendix-c'?" in failure(
        capfd, "capture", "solve", str(folder), "--method", "apendix-c"
    )
    assert "there is no such folder — begin a project" in failure(capfd, "capture", "solve", str(folder / "none"))
    assert "there is no board in its project.toml" in failure(capfd, "capture", "boards", str(folder))
    assert "there is no solution — find it first" in failure(
        capfd, "capture", "export", str(folder), "-o", str(folder / "a_dltCoefs.csv")
    )
    with (folder / "points.csv").open("a") as file:
        file.write("view9.jpg,nose,1,2\n")
    assert "unknown photograph 'view9.jpg' — did you mean" in failure(capfd, "capture", "solve", str(folder))
    assert sorted(path.name for path in folder.iterdir()) == ["points.csv", "project.toml", "references.csv"]


def test_begin_import_and_export(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    photos = []
    for number, name in enumerate(("smile-1.png", "smile-2.png")):
        Image.new("RGB", (400, 300), (number, 0, 0)).save(tmp_path / name)
        photos.append(str(tmp_path / name))
    folder = str(tmp_path / "anna")
    assert main(["capture", "new", folder, *photos, "--cube", "300"]) == 0
    assert "2 photographs; moments smile; cameras a" in capfd.readouterr().err
    assert "cube-111,300,300,300,," in (tmp_path / "anna" / "references.csv").read_text()
    (tmp_path / "t_xypts.csv").write_text("pt1_cam1_X,pt1_cam1_Y,pt1_cam2_X,pt1_cam2_Y\n1,1,2,2\n")
    assert main(["capture", "import", str(tmp_path / "t_xypts.csv"), folder, "--names", "nose"]) == 0
    assert "clicks added: 2; nose" in capfd.readouterr().err
    assert main(["capture", "export", folder, "-o", str(tmp_path / "u_xypts.csv"), "-q"]) == 0
    assert capfd.readouterr() == ("", "")
    assert (tmp_path / "u_xypts.csv").read_text() == (tmp_path / "t_xypts.csv").read_text()


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        (["new", "DIR", "a.png", "--unit", "feet"], "unknown unit 'feet'"),
        (["new", "DIR", "a.png", "--cube", "-3"], "--cube: want the length of its edge in mm, got -3"),
        (["new", "DIR", "a.png", "--pair", "--cube", "3"], "--cube: a --pair has no cube"),
        (["new", "DIR", "b.png"], "there is no such file"),
        (
            ["import", "t.csv", "DIR", "--frames", "1,b"],
            "--frames: want different rows from 1, as in 12,340, got '1,b'",
        ),
    ],
)
def test_options_that_make_no_sense(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], arguments: list[str], wanted: str
) -> None:
    Image.new("RGB", (4, 3)).save(tmp_path / "a.png")
    places = [str(tmp_path / word) if word in ("DIR", "a.png", "b.png") else word for word in arguments]
    assert wanted in failure(capfd, "capture", *places)
    assert [path.name for path in tmp_path.iterdir()] == ["a.png"]


def test_boards_are_found_kept_and_listed(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    squares = np.add.outer(np.arange(7), np.arange(10)) % 2 * 255
    sheet = np.pad(np.kron(squares, np.ones((30, 30))).astype(np.uint8), 40, constant_values=255)
    Image.fromarray(sheet).save(tmp_path / "front.png")
    board = '[[board]]\nkind = "chessboard"\ncolumns = 10\nrows = 7\nsquare = 25\n'
    (tmp_path / "project.toml").write_text(
        f'format = "mien-capture"\nversion = 1\n[[photograph]]\nfile = "front.png"\n{board}'
    )
    assert main(["capture", "boards", str(tmp_path), "--json", "-q"]) == 0
    told = json.loads(capfd.readouterr().out)["boards"]
    assert [(row["photo"], row["board"], row["corners"]) for row in told] == [("front.png", "board", 54)]
    rows = (tmp_path / "boards.csv").read_text().splitlines()
    assert len(rows) == 55
    photo, point, u, v, _ = rows[1].split(",")
    assert (photo, point) == ("front.png", "board:0:0")
    assert (float(u), float(v)) == pytest.approx((70.0, 70.0), abs=0.1)
    assert main(["capture", "boards", str(tmp_path), "-q"]) == 0
    assert capfd.readouterr().out == ""


def test_reading_a_project_imports_nothing_heavy() -> None:
    code = (
        "import mien.capture.project, mien.cli.capture, sys\n"
        "print([name for name in ('cv2', 'scipy', 'PIL', 'matplotlib', 'numba') if name in sys.modules])"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"


@pytest.mark.parametrize("command", ["", "new", "solve", "boards", "import", "export"])
def test_help_shows_examples(capfd: pytest.CaptureFixture[str], command: str) -> None:
    assert main(["capture", *([command] if command else []), "--help"]) == 0
    assert f"mien capture {command}".strip() in capfd.readouterr().out.split("Usage")[1].split("\n", 1)[1]
