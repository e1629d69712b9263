"""``mien toon check``, ``new`` and ``schema`` at the command line."""

import json

import pytest

from mien.cli import main
from mien.faces.toon.starters import starter_text


@pytest.fixture
def bad(tmp_path):
    path = tmp_path / "bad.toon.json"
    path.write_text(starter_text("bad").replace('"fill": "shirt"', '"fill": "shrt"'), encoding="utf-8")
    return path


def test_a_new_face_has_no_faults_and_is_not_replaced(capfd, tmp_path):
    path = tmp_path / "kim.toon.json"
    assert main(["toon", "new", "-o", str(path)]) == 0
    assert json.loads(path.read_text(encoding="utf-8"))["name"] == "kim"
    assert main(["toon", "check", str(path)]) == 0
    assert capfd.readouterr().out == f"{path}: no faults\n"
    path.write_text("mine", encoding="utf-8")
    assert main(["toon", "new", "-o", str(path)]) == 2
    assert "--force" in capfd.readouterr().err
    assert path.read_text(encoding="utf-8") == "mine"
    assert main(["toon", "new", "-o", str(path), "--force", "--like", "olav"]) == 0
    document = json.loads(path.read_text(encoding="utf-8"))
    assert (document["name"], "fisherman" in document["doc"]) == ("kim", True)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["-o", "kim.json"], "ends in .toon.json"),
        (["-o", ".toon.json"], "ends in .toon.json"),
        (["-o", "no/folder/kim.toon.json"], "does not exist"),
        (["-o", "kim.toon.json", "--like", "olaf"], "did you mean 'olav'"),
        (["-o", "kim.toon.json", "--like", "olav", "--strict"], "leave one of the two out"),
    ],
)
def test_mistakes_write_nothing(capfd, tmp_path, monkeypatch, arguments, message):
    monkeypatch.chdir(tmp_path)
    assert main(["toon", "new", *arguments]) == 2
    assert message in capfd.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_strict_face(tmp_path):
    path = tmp_path / "kim.toon.json"
    assert main(["toon", "new", "-o", str(path), "--strict"]) == 0
    assert json.loads(path.read_text(encoding="utf-8"))["mode"] == "strict"


def test_faults_name_file_and_line(capfd, bad):
    assert main(["toon", "check", str(bad)]) == 2
    first, second, last = capfd.readouterr().out.splitlines()
    assert first.startswith(f"{bad}:5: warning: palette.shirt: is used by no polygon")
    assert f"{bad}:" in second
    assert "polygons[0].fill (shirt): unknown colour 'shrt' — did you mean 'shirt'" in second
    assert last == f"{bad}: 1 error and 1 warning"


def test_faults_as_json(capfd, bad, tmp_path):
    other = tmp_path / "none.toon.json"
    assert main(["toon", "check", str(bad), str(other), "--json"]) == 2
    first, second = json.loads(capfd.readouterr().out)
    assert (first["file"], first["errors"], len(first["faults"])) == (str(bad), 1, 2)
    fault = first["faults"][1]
    assert (fault["severity"], fault["rule"], fault["place"]) == ("error", "palette", ["polygons", 0, "fill"])
    assert fault["polygon"] == "shirt"
    assert fault["try"].startswith("did you mean 'shirt'")
    assert second["faults"][0]["what"].startswith("cannot be read")


def test_warnings_alone_are_no_mistake(capfd, bad):
    bad.write_text(bad.read_text(encoding="utf-8").replace('"shrt"', '"#2F7F79"'), encoding="utf-8")
    assert main(["toon", "check", str(bad)]) == 0
    assert capfd.readouterr().out.endswith(": 1 warning\n")


def test_many_faults_are_cut_short(capfd, bad):
    document = json.loads(starter_text("bad"))
    document["polygons"] += [{"id": f"p{number}"} for number in range(60)]
    bad.write_text(json.dumps(document), encoding="utf-8")
    assert main(["toon", "check", str(bad)]) == 2
    lines = capfd.readouterr().out.splitlines()
    assert len(lines) == 42
    assert "more, which --json shows" in lines[-2]
