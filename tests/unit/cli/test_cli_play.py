"""Rendering and playing from the command line, on the real head."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mien import load_face
from mien.cli import main

SMALL = ["--size", "48", "--subdivide", "0", "--quiet"]


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("nod.spec").write_text("title A nod\nlength 6\njaw.rotation 1 3 0 8 linear\nhead.nod 0 5 0 -20 cosine\n")


def pixels(path: str) -> np.ndarray:
    with Image.open(path) as image:
        return np.asarray(image.convert("RGBA")).astype(int)


def test_a_setting_changes_the_picture_and_a_preset_can_be_overruled() -> None:
    assert main(["render", "head", *SMALL, "-o", "rest.png"]) == 0
    assert main(["render", "head", *SMALL, "--set", "jaw.rotation=15", "-o", "open.png"]) == 0
    assert main(["render", "head", *SMALL, "--preset", "neutral", "-o", "neutral.png"]) == 0
    assert np.abs(pixels("rest.png") - pixels("open.png")).max() > 50
    np.testing.assert_array_equal(pixels("rest.png"), pixels("neutral.png"))


def test_transparency_and_size() -> None:
    command = ["render", "head", "-q", "--size", "40x60", "--subdivide", "0", "--background", "transparent"]
    assert main([*command, "-o", "a.png"]) == 0
    picture = pixels("a.png")
    assert picture.shape == (60, 40, 4)
    assert (picture[0, 0, 3], picture[30, 20, 3]) == (0, 255)


def test_the_picture_does_not_depend_on_threads() -> None:
    for threads in ("1", "3"):
        assert main(["render", "head", *SMALL, "--threads", threads, "-o", f"{threads}.png"]) == 0
    assert Path("1.png").read_bytes() == Path("3.png").read_bytes()


def test_the_command_list_of_a_specification_list(capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["play", "nod.spec", "--commands"]) == 0
    lines = [line.split() for line in capfd.readouterr().out.splitlines()]
    jaw = [(int(frame), float(value)) for frame, name, value in lines if name == "jaw.rotation"]
    assert jaw == [(1, 0.0), (2, 4.0), (3, 8.0)]
    assert [frame for frame, name, _ in lines if name == "head.nod"] == ["0", "1", "2", "3", "4", "5"]


def test_frames_after_a_pattern_and_the_same_from_json() -> None:
    assert main(["play", "nod.spec", *SMALL, "-o", "a_%02d.png"]) == 0
    assert main(["play", "nod.spec", *SMALL, "-o", "nod.json"]) == 0
    assert main(["play", "nod.json", "-q", "-o", "b_%02d.png"]) == 0
    assert sorted(path.name for path in Path().glob("a_*.png")) == [f"a_{number:02d}.png" for number in range(6)]
    for number in range(6):
        np.testing.assert_array_equal(pixels(f"a_{number:02d}.png"), pixels(f"b_{number:02d}.png"))
    assert np.abs(pixels("a_00.png") - pixels("a_05.png")).max() > 50


def test_a_timeline_of_an_older_head_plays_and_says_so(capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["play", "nod.spec", *SMALL, "-o", "nod.json"]) == 0
    assert main(["play", "nod.json", "-o", "a.csv"]) == 0
    assert "another version" not in capfd.readouterr().err
    table = load_face("head").parameters.fingerprint
    Path("nod.json").write_text(Path("nod.json").read_text().replace(table, "0" * 12))
    assert main(["play", "nod.json", "-o", "b.csv"]) == 0
    assert "nod.json: made with another version of 'head'" in capfd.readouterr().err
    assert Path("a.csv").read_text() == Path("b.csv").read_text()


def test_settings_lie_beneath_what_moves() -> None:
    more = ["--set", "jaw.rotation=20", "--set", "mouth.expression=0"]
    assert main(["play", "nod.spec", *SMALL, *more, "-o", "a.csv"]) == 0
    head, *rows = Path("a.csv").read_text().splitlines()
    columns = {name: [float(row.split(",")[place]) for row in rows] for place, name in enumerate(head.split(","))}
    assert columns["jaw.rotation"] == pytest.approx([20.0, 0.0, 4.0, 8.0, 8.0, 8.0])
    assert set(columns["mouth.expression.left"]) == set(columns["mouth.expression.right"]) == {0.0}


def test_a_table_plays() -> None:
    Path("a.csv").write_text("frame,jaw.rotation\n0,0\n3,9\n")
    assert main(["play", "a.csv", "--fps", "12", "-o", "b.csv", "-q"]) == 0
    assert Path("b.csv").read_text().splitlines()[2] == f"{1 / 12!r},3.0"


def test_the_curves_are_plotted() -> None:
    assert main(["play", "nod.spec", "--plot", "nod.svg", "--quiet"]) == 0
    assert "<svg" in Path("nod.svg").read_text()


def test_warmup_says_that_it_is_ready(capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["warmup"]) == 0
    assert "ready in" in capfd.readouterr().err
