"""From the texts of options to values and scenes."""

from __future__ import annotations

import io
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from mien.cli.settings import (
    check_threads,
    make_scene,
    parse_background,
    parse_size,
    parse_values,
    parse_vector,
    read_text,
)
from mien.core import MienError, RangeError, Scene, UnknownNameError


def test_values_by_name() -> None:
    assert parse_values(["jaw.rotation=8", "mouth.expression = .2", "jaw.rotation=9"]) == {
        "jaw.rotation": 9.0,
        "mouth.expression": 0.2,
    }
    assert parse_values(None) == {}


@pytest.mark.parametrize("text", ["jaw.rotation", "=3", "jaw.rotation=", "jaw.rotation=wide", "jaw.rotation=3,5"])
def test_a_setting_of_another_form_is_refused(text: str) -> None:
    with pytest.raises(MienError, match=r"--set .*(want NAME=VALUE|is not a number)"):
        parse_values([text])


def test_sizes() -> None:
    assert parse_size("512") == (512, 512)
    assert parse_size("1280x720") == parse_size("1280X720") == (1280, 720)
    for text in ("", "big", "1x2x3", "-5", "3.5", "10x"):
        with pytest.raises(MienError, match="--size"):
            parse_size(text)


def test_vectors() -> None:
    assert parse_vector("0.1,-2,3e-1", "--at") == (0.1, -2.0, 0.3)
    for text in ("1,2", "1,2,3,4", "a,b,c", ""):
        with pytest.raises(MienError, match="--from"):
            parse_vector(text, "--from")


def test_backgrounds() -> None:
    assert parse_background("white") == ((1.0, 1.0, 1.0, 1.0),) * 2
    assert parse_background("transparent") == ((0.0, 0.0, 0.0, 0.0),) * 2
    bottom, top = parse_background("black:#f00")
    assert (bottom, top) == ((0.0, 0.0, 0.0, 1.0), (1.0, 0.0, 0.0, 1.0))
    # IEC 61966-2-1: byte 128 is 0.215861 in linear light, byte 10 lies on the straight part.
    grey, dark = parse_background("#808080:#0a0a0a")
    assert grey[0] == pytest.approx(0.215861, abs=1e-6)
    assert dark[0] == pytest.approx(10 / 255 / 12.92, abs=1e-6)


@pytest.mark.parametrize(
    ("text", "message"),
    [("whit", "did you mean 'white'"), ("#12", "hexadecimal"), ("a:b:c", "bottom:top"), ("", "unknown colour")],
)
def test_a_colour_that_is_none_is_refused(text: str, message: str) -> None:
    with pytest.raises(MienError, match=message):
        parse_background(text)


def test_a_scene_keeps_what_no_option_names() -> None:
    scene = Scene.parke(0.2)
    assert make_scene(scene) == scene
    changed = make_scene(scene, size="64x32", shading="wire", subdivide=0, fov=20.0, at="0,0,0.01", position="0,0,2")
    assert (changed.size_px, changed.shading, changed.subdivide, changed.fov_deg) == ((64, 32), "wire", 0, 20.0)
    assert (changed.at, changed.position, changed.lights) == ((0.0, 0.0, 0.01), (0.0, 0.0, 2.0), scene.lights)


def test_a_view_stands_around_the_point_that_is_looked_at() -> None:
    scene = make_scene(Scene(), view="side", at="0,0.5,0")
    assert scene.position[1] == pytest.approx(0.5, abs=0.05)
    assert scene.position[0] > 1.0


def test_parkes_light_by_name_with_his_two_numbers() -> None:
    scene = make_scene(Scene(fov_deg=20.0), light="parke", diffuse=0.1, cosine_power=4)
    assert scene == Scene.parke(0.1, 4, fov_deg=20.0)
    assert make_scene(Scene(), light="parke") == Scene.parke()
    assert make_scene(Scene(), light="parke", background="white").background == ((1.0, 1.0, 1.0, 1.0),) * 2


def test_the_light_of_a_studio_undoes_parkes() -> None:
    assert make_scene(Scene.parke(0.2, 3, fov_deg=20.0), light="studio") == Scene(fov_deg=20.0)


def test_a_cosine_power_is_of_any_light() -> None:
    assert make_scene(Scene(), cosine_power=3) == Scene(cosine_power=3)


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"view": "frnt"}, UnknownNameError, "did you mean 'front'"),
        ({"view": "front", "position": "0,0,1"}, MienError, "leave one out"),
        ({"shading": "flat"}, UnknownNameError, "smooth"),
        ({"subdivide": 3}, RangeError, "0, 1 or 2"),
        ({"size": "0"}, RangeError, "1 to 16384"),
        ({"size": "99999"}, RangeError, "1 to 16384"),
        ({"light": "park"}, UnknownNameError, "did you mean 'parke'"),
        ({"light": "parke", "diffuse": 1.5}, RangeError, "diffuse factor 1.5 .* from 0 to 1"),
        ({"light": "parke", "diffuse": float("nan")}, RangeError, "from 0 to 1"),
        ({"diffuse": 0.3}, MienError, "add --light parke"),
        ({"light": "studio", "diffuse": 0.3}, MienError, "add --light parke"),
        ({"cosine_power": 0}, RangeError, "1 to 64"),
        ({"fov": float("nan")}, RangeError, "field of view"),
        ({"position": "nan,0,1"}, RangeError, "finite"),
        ({"position": "0,0,0", "at": "0,0,0"}, RangeError, "very point"),
    ],
)
def test_a_scene_that_cannot_be_is_refused(options: dict, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        make_scene(Scene(), **options)


def test_threads() -> None:
    check_threads(None)
    check_threads(8)
    for number in (0, -1, 257):
        with pytest.raises(RangeError, match="1 to 256"):
            check_threads(number)


def test_text_from_the_line_a_file_and_standard_input(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.txt").write_bytes(b"\xef\xbb\xbfHow happy\n")
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=io.BytesIO("Grüße".encode())))
    assert read_text("Hello") == "Hello"
    assert read_text(f"@{tmp_path / 'a.txt'}") == "How happy\n"
    assert read_text("-") == "Grüße"


def test_bytes_that_are_no_text_are_refused_by_where_they_came_from(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=io.BytesIO(b"caf\xe9")))
    with pytest.raises(MienError, match=r"standard input: is not UTF-8 text \(byte 3\)"):
        read_text("-")


def test_nothing_to_say_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text(" \n")
    (tmp_path / "b.txt").write_bytes(b"\xff\xff")
    cases = {"": "is empty", " \t": "is empty", f"@{tmp_path}/a.txt": "a.txt is empty", f"@{tmp_path}/b.txt": "UTF-8"}
    cases |= {f"@{tmp_path}/none.txt": "cannot be read", f"@{tmp_path}": "cannot be read"}
    for text, message in cases.items():
        with pytest.raises(MienError, match=message):
            read_text(text)
