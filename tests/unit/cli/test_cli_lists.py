"""What the listing commands print."""

from __future__ import annotations

import json

import pytest

from mien.cli import main
from mien.faces.registry import face_names, load_face


def output(capfd: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main(arguments) == 0
    out, err = capfd.readouterr()
    assert err == ""
    return out


def test_faces_one_a_line_name_first(capfd: pytest.CaptureFixture[str]) -> None:
    lines = output(capfd, "faces").splitlines()
    assert [line.split()[0] for line in lines] == [name for name, _ in face_names()]
    rows = json.loads(output(capfd, "faces", "--json"))
    assert [(row["name"], row["doc"]) for row in rows] == face_names()


def test_every_parameter_with_its_range(capfd: pytest.CaptureFixture[str]) -> None:
    table = load_face("head").parameters
    lines = output(capfd, "params", "head").splitlines()
    assert [line.split()[0] for line in lines[1:]] == list(table.names)
    jaw = next(line for line in lines if line.startswith("jaw.rotation"))
    assert jaw.split()[1:7] == ["0", "0", "20", "deg", "0.0", "38.2"]


def test_parameters_as_json_have_the_documented_shape(capfd: pytest.CaptureFixture[str]) -> None:
    data = json.loads(output(capfd, "params", "head", "--json"))
    assert list(data) == ["face", "parameters"]
    assert data["face"] == "head"
    assert len(data["parameters"]) == len(load_face("head").parameters)
    row = next(row for row in data["parameters"] if row["name"] == "eyelid.opening.left")
    assert list(row) == ["name", "default", "low", "high", "unit", "group", "mirror", "doc", "source", "reach_mm"]
    assert (row["low"], row["high"], row["mirror"]) == (0, 1, "eyelid.opening.right")
    assert row["reach_mm"] == [15.4, 4.1]


def test_presets(capfd: pytest.CaptureFixture[str]) -> None:
    lines = output(capfd, "presets", "head").splitlines()
    assert [line.split()[0] for line in lines[1:]] == list(load_face("head").presets)
    data = json.loads(output(capfd, "presets", "head", "--json"))
    smile = next(row for row in data["presets"] if row["name"] == "smile")
    assert smile["values"] == dict(load_face("head").presets["smile"].values)


def test_voices(capfd: pytest.CaptureFixture[str]) -> None:
    assert output(capfd, "voices").split()[0] == "hibari"
    assert json.loads(output(capfd, "voices", "--json"))[0]["name"] == "hibari"


def test_version(capfd: pytest.CaptureFixture[str]) -> None:
    import mien

    assert output(capfd, "--version").strip() == f"mien {mien.__version__}"


@pytest.mark.parametrize(
    "command", ["say", "render", "play", "faces", "params", "presets", "voices", "warmup", "doctor"]
)
def test_every_command_explains_itself_with_an_example(command: str, capfd: pytest.CaptureFixture[str]) -> None:
    assert f"  mien {command}" in output(capfd, command, "--help")
    assert f"  {command} " in output(capfd, "--help")
