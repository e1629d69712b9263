"""A capture project as a stranger may get it wrong: one clear error or a warning, and nothing written over."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mien.capture.pair_simulating import FRONT_FILE, SIDE_FILE, PairSetup, marks_of_head, simulate_pair
from mien.capture.project import read_solution, read_survey
from mien.capture.project_points import format_points, format_references
from mien.capture.project_records import Pair, Project
from mien.capture.project_toml import format_project
from mien.capture.records import Survey
from mien.capture.simulating import Setup, cube, simulate
from mien.cli import main

MARKS = marks_of_head(40, seed=3)


@cache
def cube_survey() -> Survey:
    return simulate(Setup(references=cube(count=12), points=6, views=2, size_px=(800, 600)), 5).survey


@cache
def pair_survey() -> tuple[Survey, Pair]:
    """A pair of pictures of other sizes, and what its project says of it."""
    survey, _ = simulate_pair(PairSetup(sizes_px=((750, 1000), (480, 640)), sigma_px=0.3), MARKS)
    seen = [{each.point for each in survey.observations if each.photo == photo} for photo in (FRONT_FILE, SIDE_FILE)]
    low, *_, high = sorted(seen[0] & seen[1], key=lambda name: float(MARKS.places[name][1]))
    length = float(np.linalg.norm(MARKS.places[low] - MARKS.places[high]))
    midline = tuple(name for name in MARKS.midline if name in seen[0] | seen[1])
    return survey, Pair(FRONT_FILE, SIDE_FILE, (low, high, length), midline=midline)


def make(folder: Path, survey: Survey, pair: Pair | None = None, *, pictures: bool = False) -> Path:
    folder.mkdir()
    (folder / "project.toml").write_text(format_project(Project(folder, "anna", survey.photographs, pair=pair)))
    (folder / "points.csv").write_text(format_points(survey.observations))
    if survey.references:
        (folder / "references.csv").write_text(format_references(survey.references, "mm"))
    for number, photo in enumerate(survey.photographs if pictures else ()):
        Image.new("RGB", photo.size_px, (40 * number, 90, 120)).save(folder / photo.name)
    return folder


def renamed(survey: Survey, photo: str, names: Mapping[str, str]) -> Survey:
    """The same with other names of points in one photograph."""
    return replace(
        survey,
        observations=tuple(
            replace(each, point=names.get(each.point, each.point)) if each.photo == photo else each
            for each in survey.observations
        ),
    )


def files(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.fixture
def failure(capfd: pytest.CaptureFixture[str]) -> Callable[..., str]:
    """What a command says that fails by the fault of the one who typed it: in one line."""

    def run(*arguments: object) -> str:
        assert main(["capture", *map(str, arguments)]) == 2
        out, err = capfd.readouterr()
        assert out == ""
        told = [line for line in err.splitlines() if line.startswith("mien: ")]
        assert len(told) == 1
        return told[0]

    return run


def jpeg(size: tuple[int, int] = (64, 48), *, mode: str = "RGB", orientation: int = 1) -> bytes:
    file, exif = io.BytesIO(), Image.Exif()
    exif[274] = orientation
    Image.new(mode, size, 7 if mode == "L" else (10, 20, 30, 0)[: len(mode)]).save(file, "JPEG", exif=exif)
    return file.getvalue()


@pytest.mark.parametrize(
    ("name", "content", "wanted"),
    [
        ("phone.heic", b"\0\0\0\x18ftypheic" + bytes(90), "HEIC"),
        ("phone.jpg", b"\0\0\0\x18ftypheic" + bytes(90), "HEIC"),
        ("none.jpg", b"", "is empty"),
        ("letter.jpg", b"Dear all", "no picture"),
        ("camera.nef", jpeg(), "raw picture"),
    ],
)
def test_what_is_no_photograph_begins_no_project(
    tmp_path: Path, failure: Callable[..., str], name: str, content: bytes, wanted: str
) -> None:
    (tmp_path / name).write_bytes(content)
    (tmp_path / "good.jpg").write_bytes(jpeg())
    message = failure("new", tmp_path / "anna", tmp_path / "good.jpg", tmp_path / name)
    assert wanted in message
    assert name in message
    assert not (tmp_path / "anna").exists()


def test_turned_and_printers_photographs_of_other_sizes_begin_a_project(tmp_path: Path) -> None:
    (tmp_path / "upright.jpg").write_bytes(jpeg())
    (tmp_path / "turned.jpg").write_bytes(jpeg(orientation=6))
    (tmp_path / "print.jpg").write_bytes(jpeg((50, 40), mode="CMYK"))
    paths = [str(tmp_path / name) for name in ("upright.jpg", "turned.jpg", "print.jpg")]
    assert main(["capture", "new", str(tmp_path / "anna"), *paths, "--quiet"]) == 0
    survey = read_survey(tmp_path / "anna")
    sizes = {photo.name: photo.size_px for photo in survey.photographs}
    assert sizes == {"upright.jpg": (64, 48), "turned.jpg": (48, 64), "print.jpg": (50, 40)}
    assert survey.photograph("print.jpg").camera != survey.photograph("upright.jpg").camera


def test_a_hundred_megapixels_begin_a_project_and_two_hundred_are_too_many(
    tmp_path: Path, failure: Callable[..., str]
) -> None:
    Image.new("1", (12_000, 9_000)).save(tmp_path / "large.png")
    assert main(["capture", "new", str(tmp_path / "anna"), str(tmp_path / "large.png"), "--quiet"]) == 0
    assert read_survey(tmp_path / "anna").photographs[0].size_px == (12_000, 9_000)
    Image.new("1", (20_000, 10_000)).save(tmp_path / "huge.png")
    assert "megapixels" in failure("new", tmp_path / "bob", tmp_path / "huge.png")
    assert not (tmp_path / "bob").exists()


def test_a_project_and_its_photographs_are_not_written_over(tmp_path: Path, failure: Callable[..., str]) -> None:
    (tmp_path / "a.jpg").write_bytes(jpeg())
    assert main(["capture", "new", str(tmp_path / "anna"), str(tmp_path / "a.jpg"), "--quiet"]) == 0
    before = files(tmp_path / "anna")
    assert "there is a project already" in failure("new", tmp_path / "anna", tmp_path / "a.jpg")
    assert files(tmp_path / "anna") == before
    other = tmp_path / "bob" / "photographs"
    other.mkdir(parents=True)
    (other / "a.jpg").write_bytes(jpeg((32, 32)))
    assert main(["capture", "new", str(tmp_path / "bob"), str(tmp_path / "a.jpg"), "--quiet"]) in (0, 2)
    assert (other / "a.jpg").read_bytes() == jpeg((32, 32))


def test_five_references_are_too_few(tmp_path: Path, failure: Callable[..., str]) -> None:
    survey = cube_survey()
    known = {each.name for each in survey.references}
    five = {each.name for each in survey.references[:5]}
    clicks = tuple(each for each in survey.observations if each.point in five or each.point not in known)
    folder = make(
        tmp_path / "anna", replace(survey, observations=clicks, references=survey.references[:5]), pictures=True
    )
    before = files(folder)
    message = failure("solve", folder)
    assert "shows 5 references" in message
    assert "want 6" in message
    assert files(folder) == before


def test_one_photograph_under_two_names(tmp_path: Path, failure: Callable[..., str]) -> None:
    survey = cube_survey()
    one, other = (photo.name for photo in survey.photographs)
    kept = [each for each in survey.observations if each.photo == one]
    clicks = tuple(kept + [replace(each, photo=other) for each in kept])
    message = failure("solve", make(tmp_path / "clicks", replace(survey, observations=clicks)))
    assert one in message
    assert other in message
    folder = make(tmp_path / "pictures", survey, pictures=True)
    (folder / other).write_bytes((folder / one).read_bytes())
    assert "same picture" in failure("solve", folder)


def test_exchanged_names_are_named_and_a_failed_solve_leaves_the_last_solution(
    tmp_path: Path, failure: Callable[..., str]
) -> None:
    survey = simulate(Setup(references=cube(count=20), points=4, views=3, size_px=(800, 600)), 5).survey
    one, other = survey.references[0].name, survey.references[5].name
    photo = survey.photographs[0].name
    folder = make(tmp_path / "anna", renamed(survey, photo, {one: other, other: one}))
    assert main(["capture", "solve", str(folder), "--quiet"]) == 0
    remarks = " ".join(read_solution(folder).remarks)
    assert "exchanged" in remarks
    assert repr(one) in remarks
    assert repr(other) in remarks
    before = files(folder / "solution")
    with (folder / "points.csv").open("a") as file:
        file.write(f"{photo},nose,12,\n")
    failure("solve", folder)
    assert files(folder / "solution") == before


def test_sizes_that_do_not_fit(tmp_path: Path, failure: Callable[..., str]) -> None:
    survey = cube_survey()
    folder = make(tmp_path / "anna", survey, pictures=True)
    name = survey.photographs[1].name
    Image.new("RGB", (400, 300)).save(folder / name)
    assert "is 400x300 pixels upright" in failure("solve", folder)
    first, second = survey.photographs
    mixed = replace(survey, photographs=(replace(first, camera="a"), replace(second, camera="a", size_px=(400, 300))))
    assert "no lens in common" in failure("solve", make(tmp_path / "bob", mixed))


def test_a_truncated_photograph_is_solved_and_left_out_of_the_report(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    survey, pair = pair_survey()
    folder = make(tmp_path / "anna", survey, pair, pictures=True)
    noise = np.random.default_rng(0).integers(0, 255, (1000, 750, 3), dtype=np.uint8)
    file = io.BytesIO()
    Image.fromarray(noise).save(file, "JPEG")
    (folder / FRONT_FILE).write_bytes(file.getvalue()[:9000])
    assert main(["capture", "solve", str(folder), "--quiet"]) == 0
    assert main(["capture", "report", str(folder)]) == 0
    assert "is damaged or not complete" in capfd.readouterr().err
    assert (folder / "solution" / "report.html").is_file()


def test_a_pair_with_a_wrong_height_is_solved_without_it_and_reported(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    survey, pair = pair_survey()
    assert pair.scale is not None
    seen = {each.point for each in survey.observations if each.photo == SIDE_FILE}
    seen &= {each.point for each in survey.observations if each.photo == FRONT_FILE}
    wrong = sorted(seen - set(pair.midline) - set(pair.scale[:2]))[0]
    clicks = tuple(
        replace(each, v=each.v + 25.0) if (each.photo, each.point) == (SIDE_FILE, wrong) else each
        for each in survey.observations
    )
    folder = make(tmp_path / "anna", replace(survey, observations=clicks), pair, pictures=True)
    assert main(["capture", "solve", str(folder)]) == 0
    assert f"{wrong} in {SIDE_FILE} is " in capfd.readouterr().out
    solution = read_solution(folder)
    assert {each.observation.point for each in solution.suspects} == {wrong}
    assert all(np.isfinite([each.du, each.dv, each.statistic]).all() for each in solution.residuals)
    assert main(["capture", "report", str(folder), "--quiet"]) == 0


def test_a_pair_told_the_wrong_way_round(tmp_path: Path, failure: Callable[..., str]) -> None:
    survey, pair = pair_survey()
    folder = make(tmp_path / "anna", survey, replace(pair, front=pair.side, side=pair.front))
    before = files(folder)
    assert "seem exchanged" in failure("solve", folder)
    assert files(folder) == before
    told = make(tmp_path / "bob", survey, replace(pair, side_from="right"))
    assert "points of its left" in failure("solve", told)
    assert "how large" in failure("solve", make(tmp_path / "cy", survey, replace(pair, scale=None)))
