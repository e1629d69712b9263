"""The pictures of docs/parameters.md: every row has its own, from a view that is told, and they are not stale."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mien.faces.head.table import conformation_rows
from support import load_tool

ROOT = Path(__file__).parents[2]
MOST_BYTES = 3_000_000
MOST_APART = 2.0
"""Mean difference of 8-bit values that JPEG and font versions may make."""


TOOL = load_tool("parameters")
ENTRIES = {entry.name: entry for entry in TOOL.entries()}


def pixels(path):
    with Image.open(path) as picture:
        return np.asarray(picture, dtype=float)


def test_every_parameter_is_shown_once():
    rows = [row for entry in ENTRIES.values() for row in entry.rows]
    assert sorted(rows) == sorted(TOOL.person().parameters.names)


def test_every_row_has_its_pictures_and_every_picture_its_row():
    assert {path.stem for path in TOOL.PICTURES.iterdir()} == set(ENTRIES), (
        "run python tools/parameters.py --pictures and look"
    )
    assert sum(path.stat().st_size for path in TOOL.PICTURES.iterdir()) < MOST_BYTES


@pytest.mark.parametrize("name", ENTRIES)
def test_a_row_shows_three_pictures_and_a_shape_its_region_too(name):
    shape = name in {row["name"] for row in conformation_rows()}
    assert pixels(TOOL.PICTURES / f"{name}.jpg").shape[1] == TOOL.SIZE_PX * (4 if shape else 3)


def test_every_view_is_that_of_some_row():
    used = [TOOL.view_of(name)["parameters"] for name in ENTRIES]
    assert [row["parameters"] for row in TOOL.views() if row["parameters"] not in used] == []


@pytest.mark.parametrize("name", ["jaw.rotation", "chin.forward", "iris.color"])
def test_pictures_are_those_that_the_tool_makes(name, tmp_path):
    (tmp_path / "new.jpg").write_bytes(TOOL.strip(ENTRIES[name]))
    apart = np.abs(pixels(tmp_path / "new.jpg") - pixels(TOOL.PICTURES / f"{name}.jpg"))
    assert apart.mean() < MOST_APART, "run python tools/parameters.py --pictures and look"


@pytest.mark.parametrize("row", conformation_rows(), ids=lambda row: row["name"])
def test_a_shape_is_tinted_where_it_acts_and_not_elsewhere(row):
    entry = ENTRIES[row["name"]]
    face = TOOL.person()
    weights = TOOL._weights(entry, face.neutral)
    assert weights.min() >= 0.0
    assert weights.max() <= 1.0
    assert (weights > 0.2).any()
    if row["kind"] != "head":
        assert (weights == 0.0).any()
