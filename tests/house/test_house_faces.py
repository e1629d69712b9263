"""Every face documents its parameters; every table of names fits the faces."""

import csv
from pathlib import Path

import pytest

from support import FACE_NAMES, face

DATA = Path(__file__).parents[2] / "src" / "mien" / "vocab" / "data"

# What a value is counted in. A share goes from 0 to 1 or from -1 to 1.
UNITS = {"deg", "m", "s", "share", "factor", "Parke unit", "linear light", "iris radius", "eyeball radius"}

every_face = pytest.mark.parametrize("name", FACE_NAMES)


@every_face
def test_every_parameter_has_a_unit_a_group_a_doc_and_a_source(name):
    for row in face(name).parameters:
        assert row.unit in UNITS, row.name
        assert row.group, row.name
        assert row.source, row.name
        assert row.doc[:1].isupper(), f"{row.name}: {row.doc!r} is no sentence"


@every_face
def test_parameter_names_are_region_action_and_side(name):
    for row in face(name).parameters:
        parts = row.name.split(".")
        assert len(parts) >= 2, row.name
        assert all(part.isidentifier() and part == part.lower() for part in parts), row.name


@every_face
def test_presets_are_described(name):
    for key, preset in face(name).presets.items():
        assert key == preset.name
        assert preset.kind, key
        assert preset.doc, key


def tables_of_names():
    """``data/<vocabulary>.<family>.csv``"""
    return sorted(path for path in DATA.glob("*.*.csv")) if DATA.is_dir() else []


def family(name):
    return next((face(known) for known in FACE_NAMES if face(known).family == name), None)


def rows_of(path):
    lines = (line for line in path.read_text().splitlines() if line.strip() and not line.startswith("#"))
    return list(csv.DictReader(lines))


@pytest.mark.parametrize("path", tables_of_names(), ids=lambda path: path.name)
def test_both_sets_of_names_in_a_table_exist(path):
    vocabulary, kind = path.name.removesuffix(".csv").split(".")
    subject = family(kind)
    assert subject is not None, f"{path.name}: no installed face is of the family {kind!r}"
    rows = rows_of(path)
    assert rows
    columns = list(rows[0])
    assert len(columns) >= 3, f"{path.name}: want a name, a parameter and a weight, got {columns}"
    listed = DATA / f"{vocabulary}.csv"
    known = {next(iter(row.values())) for row in rows_of(listed)} if listed.exists() else None
    for row in rows:
        theirs, ours, *_ = row.values()
        assert subject.parameters.resolve(ours)
        assert known is None or theirs in known, f"{path.name}: {theirs!r} is not in {listed.name}"
