"""``mien fit``: a face file from a table of points."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from mien.capture.fitting_people import population
from mien.capture.fitting_places import find_place, known_places, weights_of
from mien.cli import main


@pytest.fixture
def table(tmp_path: Path) -> Path:
    """Points of the mean person, in millimetres."""
    rows = population().rows
    names = [name for name in known_places() if name.startswith("ibug_")][17:60]
    places = weights_of([find_place(name) for name in names], len(rows.points)) @ (rows.points + rows.mean)
    lines = [f"{name},{x},{y},{z}" for name, (x, y, z) in zip(names, (1000.0 * places).tolist(), strict=True)]
    path = tmp_path / "points.csv"
    path.write_text("\n".join(["point,x,y,z", *lines]) + "\n")
    return path


def test_a_table_becomes_a_face_that_loads(table, tmp_path, capsys):
    out = tmp_path / "ann.face.json"
    command = ["fit", str(table), "--unit", "mm", "-o", str(out), "--name", "Ann", "--no-residual", "--json"]
    assert main([*command, "--quiet"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["files"] == [str(out)]
    assert told["points"] == 43
    assert told["rms_mm"] < 0.2
    assert not told["remarks"]
    record = json.loads(out.read_text())
    assert record["name"] == "Ann"
    assert main(["params", str(out), "--json"]) == 0


def test_points_in_millimetres_are_told(table, tmp_path, capsys):
    assert main(["fit", str(table), "-o", str(tmp_path / "ann.face.json")]) == 2
    assert "seem to be in mm: say so with --unit mm" in capsys.readouterr().err
    assert not (tmp_path / "ann.face.json").exists()
