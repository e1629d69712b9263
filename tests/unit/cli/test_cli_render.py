"""``mien render``: pictures, paths, meshes and labelled sheets, each by its suffix."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest
from PIL import Image

from mien.cli import main


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("name", ["a.png", "a.JPG", "a.svg", "a.obj", "a.glb"])
def test_the_suffix_picks_the_format_and_the_bytes_are_the_same_again(name: str) -> None:
    def render() -> bytes:
        assert main(["render", "head", "--size", "64", "--subdivide", "0", "-q", "-o", name]) == 0
        return Path(name).read_bytes()

    assert render() == render()
    assert [path.name for path in Path().iterdir()] == [name]


def test_an_svg_is_subdivided_once_unless_asked_for_more(capsys: pytest.CaptureFixture[str]) -> None:
    counts = []
    for more in ([], ["--subdivide", "1"], ["--subdivide", "0"]):
        assert main(["render", "head", "--size", "64", "-o", "a.svg", *more]) == 0
        counts.append(sum(1 for _ in ElementTree.parse("a.svg").iter("{http://www.w3.org/2000/svg}path")))
    assert counts[0] == counts[1] > 1.5 * counts[2] > 0
    assert f"a.svg: {counts[2]} paths" in capsys.readouterr().err


def test_a_puppet_is_subdivided_once_and_looks_ahead_unless_asked_for_more(capsys: pytest.CaptureFixture[str]) -> None:
    found = []
    for more in (["--subdivide", "1", "--from", "0,-0.026,1.1"], [], ["--view", "side"], ["--subdivide", "0"]):
        assert main(["render", "head", "-o", "a.glb", *more]) == 0
        found.append(Path("a.glb").read_bytes())
    assert found[0] == found[1] != found[2]
    assert len(found[3]) < 0.6 * len(found[0])
    assert "a.glb: 52 morph targets; done in" in capsys.readouterr().err


def test_a_smooth_svg_is_said_to_be_none(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["render", "head", "--shading", "smooth", "--subdivide", "0", "-o", "a.svg"]) == 0
    assert "one shade a polygon" in capsys.readouterr().err


def test_a_sheet_tells_its_size_and_that_it_is_done(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["render", "head", "--sheet", "views", "--size", "32", "--subdivide", "0", "-o", "a.jpg"]) == 0
    with Image.open("a.jpg") as image:
        width, height = image.size
    text = capsys.readouterr().err
    assert f"a.jpg: {width}x{height} pixels; done in" in text
    assert "drawing: " in text


def test_a_person_drawn_by_chance_is_the_same_again_and_one_mixed_in_changes_him() -> None:
    def render(*options: str) -> bytes:
        assert main(["render", "head", "--size", "64", "--subdivide", "0", "-q", "-o", "a.png", *options]) == 0
        return Path("a.png").read_bytes()

    assert render("--random", "7") == render("--random", "7") != render("--random", "8")
    assert render("--mix", "head:ada=0.5") not in (render(), render("--mix", "head:ada=0.4"))


MISTAKES = {
    "share without number": (["--mix", "head:ada", "-o", "a.png"], "--mix head:ada: want FACE=SHARE"),
    "share too large": (["--mix", "head:ada=1.5", "-o", "a.png"], "together no more than 1"),
    "mix with nobody": (["--mix", "head:adda=0.5", "-o", "a.png"], "did you mean"),
    "unknown sheet": (["--sheet", "presests", "-o", "a.png"], "unknown sheet 'presests' — did you mean 'presets'"),
    "sheet of paths": (["--sheet", "views", "-o", "a.svg"], "a sheet is made of pixels — end the name in .png or .jpg"),
    "sheet of meshes": (["--sheet", "views", "-o", "a.obj"], "a sheet is made of pixels"),
    "sheet of puppets": (["--sheet", "views", "-o", "a.glb"], "a sheet is made of pixels"),
    "views from one side": (["--sheet", "views", "--view", "side", "-o", "a.png"], "from all sides, not from side"),
    "huge sheet": (["--sheet", "parameters", "--size", "2000", "-o", "a.png"], "at most 16384 a side"),
    "almost a suffix": (["-o", "a.svgg"], "did you mean '.svg'"),
    "paths nowhere": (["-o", "no/a.svg"], "mkdir -p no"),
    "mesh of a wrong value": (["--set", "jaw.rotation=80", "-o", "a.obj"], "from 0 to 20 deg"),
}


@pytest.mark.parametrize(("arguments", "message"), MISTAKES.values(), ids=MISTAKES)
def test_mistakes_end_with_a_clear_message_and_no_file(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["render", "head", *arguments]) == 2
    assert message in capsys.readouterr().err
    assert list(Path().iterdir()) == []


def test_what_a_mesh_has_no_use_for_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["render", "head", "--subdivide", "0", "--size", "64", "--shading", "wire", "-o", "a.glb"]) == 0
    assert "nothing is done about --size, --shading" in capsys.readouterr().err
    assert main(["render", "head", "--subdivide", "0", "-o", "a.obj"]) == 0
    assert "nothing is done" not in capsys.readouterr().err


def test_what_a_drawing_has_no_use_for_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    for suffix in ("png", "svg"):
        command = ["render", "toon:olav", "--size", "64", "-o", f"a.{suffix}"]
        assert main([*command, "--view", "side", "--subdivide", "0", "--shading", "wire"]) == 0
        assert "no outline obeys --view, --shading, --subdivide\n" in capsys.readouterr().err
        assert main([*command, "--background", "white"]) == 0
        assert "no outline obeys" not in capsys.readouterr().err


def test_the_viewer_of_a_drawing_stands_in_front_unless_said(capsys: pytest.CaptureFixture[str]) -> None:
    def render(*more: str) -> bytes:
        command = ["render", "toon:olav", "--size", "96", "--set", "gaze.compensation=1", *more, "-o", "a.png"]
        assert main(command) == 0
        assert "no outline obeys" not in capsys.readouterr().err
        return Path("a.png").read_bytes()

    in_front = render("--set", "viewer.x=0", "--set", "viewer.y=0", "--set", "viewer.z=1.1")
    assert render() == in_front == render("--from", "0,0,1.1")
    assert len({in_front, render("--view", "three-quarter"), render("--set", "viewer.x=0.5")}) == 3
