"""Drawings in and out on the command line."""

from __future__ import annotations

from pathlib import Path

import pytest

from mien.cli import main
from mien.faces.registry import load_face

DRAWINGS = Path(__file__).parents[3] / "examples" / "drawings"


def test_a_drawing_becomes_a_face_that_loads(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "ray.toon.json"
    assert main(["toon", "from-svg", str(DRAWINGS / "mina.svg"), "-o", str(out)]) == 0
    told = capfd.readouterr().err
    assert "<linearGradient> 'dress' becomes the mean of its colours" in told
    assert f"{out}: 2 hair, 2 body, 4 ear, 1 face" in told
    assert {"smile", "surprised"} <= set(load_face(out).presets)


def test_a_picture_shows_what_was_guessed(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    from PIL import Image

    picture = tmp_path / "guessed.png"
    arguments = ["-o", str(tmp_path / "sunny.toon.json"), "--picture", str(picture)]
    assert main(["toon", "from-svg", str(DRAWINGS / "sunny.svg"), *arguments]) == 0
    with Image.open(picture) as shown:
        assert shown.height == 960
        colors = {color for _, color in shown.convert("RGB").getcolors(1 << 20) or ()}
    assert {(200, 30, 80), (22, 110, 190)} <= colors


@pytest.mark.parametrize(
    ("drawing", "out", "more", "wanted"),
    [
        ("teapot.svg", "a.toon.json", [], "no face is found"),
        ("gone.svg", "a.toon.json", [], "gone.svg: cannot be read"),
        ("sunny.svg", "a.json", [], "a drawn face wants a name that ends in .toon.json"),
        ("sunny.svg", "a.toon.json", ["--picture", "a.mp4"], "a.mp4"),
        ("sunny.svg", "a.toon.json", ["--tolerance", "-1"], "tolerance -1 is out of range"),
    ],
)
def test_a_mistake_is_told_and_nothing_is_written(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
    drawing: str,
    out: str,
    more: list[str],
    wanted: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["toon", "from-svg", str(DRAWINGS / drawing), "-o", out, *more]) == 2
    assert wanted in capfd.readouterr().err
    assert not list(tmp_path.iterdir())


def test_a_face_becomes_a_drawing_that_becomes_a_face(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    drawing, back = tmp_path / "olav.svg", tmp_path / "back.toon.json"
    assert main(["toon", "to-svg", "toon:olav", "-o", str(drawing), "--preset", "smile"]) == 0
    assert main(["toon", "from-svg", str(drawing), "-o", str(back)]) == 0
    assert f"{drawing}: " in capfd.readouterr().err
    assert load_face(back).name


def test_only_drawn_faces_become_drawings(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["toon", "to-svg", "head", "-o", str(tmp_path / "a.svg")]) == 2
    assert "is no drawn face" in capfd.readouterr().err
    assert main(["toon", "to-svg", "toon:olav", "-o", str(tmp_path / "a.png")]) == 2
    assert "ends in .svg" in capfd.readouterr().err
    assert not list(tmp_path.iterdir())
