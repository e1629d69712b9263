"""``--exaggerate`` and ``--caricature`` where settings are taken."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from mien.cli import main

SMALL = ["--size", "48", "--subdivide", "0", "--quiet"]
LINE = ["say", "Hello.", "--quiet", "-o"]


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("nod.spec").write_text("title A nod\nlength 2\njaw.rotation 0 1 0 4 linear\n")


def jaw_deg(path: str) -> float:
    """The greatest angle that the jaw of a played timeline has."""
    assert main(["play", path, "--quiet", "-o", "values.csv"]) == 0
    header, *rows = (line.split(",") for line in Path("values.csv").read_text().splitlines() if line[0] != "#")
    return max(float(row[header.index("jaw.rotation")]) for row in rows)


def test_a_picture_is_louder_or_of_another_person() -> None:
    pictures = []
    for number, more in enumerate(([], ["--exaggerate", "1"], ["--exaggerate", "2"], ["--caricature", "2"])):
        name = f"{number}.png"
        assert main(["render", "head:ada", "--preset", "sad", *more, *SMALL, "-o", name]) == 0
        pictures.append(Path(name).read_bytes())
    assert pictures[0] == pictures[1]
    assert len(set(pictures)) == 3


def test_a_timeline_is_played_louder() -> None:
    assert main(["play", "nod.spec", "--exaggerate", "2", "--quiet", "-o", "loud.json"]) == 0
    assert jaw_deg("loud.json") == pytest.approx(20 * 0.4 / (1 + 15 * 0.2**4) ** 0.25, abs=1e-3)


def test_a_face_speaks_louder_alone_and_from_a_script() -> None:
    Path("talk.csv").write_text("speaker,line\nAnn,Hello.\n")
    assert main([*LINE, "plain.json"]) == 0
    assert main([*LINE, "soft.json", "--exaggerate", "0.5"]) == 0
    assert main(["say", "--script", "talk.csv", "--exaggerate", "0.5", "--quiet", "-o", "%s.json"]) == 0
    assert jaw_deg("soft.json") == pytest.approx(0.5 * jaw_deg("plain.json"), rel=0.05)
    assert jaw_deg("Ann.json") == pytest.approx(jaw_deg("soft.json"), rel=0.05)
    assert json.loads(Path("soft.json").read_text())["text"] == "Hello."


@pytest.mark.parametrize("option", ["--exaggerate", "--caricature"])
def test_other_amounts_are_refused_before_anything_is_done(option: str, capsys: pytest.CaptureFixture[str]) -> None:
    for command in (["render", "head", "-o", "a.png"], ["play", "nod.spec", "-o", "a.json"], [*LINE, "a.json"]):
        assert main([*command, option, "4"]) == 2
        assert "goes from 0 to 3" in capsys.readouterr().err
    assert [path.name for path in Path().iterdir()] == ["nod.spec"]
