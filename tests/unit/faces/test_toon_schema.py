"""The published schema of drawn faces: it is one, it fits what ships, and our own reading of it is that of others."""

import json
from importlib.resources import files

import pytest
from jsonschema import Draft202012Validator

from mien.cli import main
from mien.faces.toon.checks_schema import find_mismatches
from mien.faces.toon.motors import motors, paper_codes
from mien.faces.toon.reader import FEATURE_POINTS, PAPER_FEATURES
from mien.faces.toon.records import KINDS, LAYERS
from mien.faces.toon.schema import referred, schema_text, toon_schema
from mien.faces.toon.shipped import toon_names
from mien.faces.toon.table import PROPORTIONS

DEFINITIONS = toon_schema()["$defs"]


def shipped(name):
    path = files("mien.faces.toon").joinpath("data", "characters", f"{name}.toon.json")
    return json.loads(path.read_text(encoding="utf-8"))


def members(schema):
    """Every key that the schema describes: where, and its own schema."""
    for name, definition in {"": schema, **schema["$defs"]}.items():
        for key, member in definition.get("properties", {}).items():
            yield f"{name}.{key}", member


def test_it_is_a_schema():
    Draft202012Validator.check_schema(toon_schema())


@pytest.mark.parametrize("name", toon_names())
def test_what_ships_fits(name):
    document = shipped(name)
    assert [error.message for error in Draft202012Validator(toon_schema()).iter_errors(document)] == []
    assert [fault.text() for fault in find_mismatches(document, toon_schema())] == []


def test_every_key_is_described():
    for place, member in members(toon_schema()):
        assert member.get("description", "").endswith("."), place


def test_names_are_those_of_the_tables():
    assert DEFINITIONS["code"]["enum"] == list(motors())
    assert list(DEFINITIONS["motors"]["properties"]) == list(motors())
    assert DEFINITIONS["motors"]["required"] == list(paper_codes())
    assert list(DEFINITIONS["features"]["properties"]) == list(FEATURE_POINTS)
    assert DEFINITIONS["features"]["required"] == list(PAPER_FEATURES)
    assert DEFINITIONS["polygon"]["properties"]["feature"]["enum"] == list(FEATURE_POINTS)
    assert DEFINITIONS["polygon"]["properties"]["kind"]["enum"] == list(KINDS)
    assert DEFINITIONS["polygon"]["properties"]["layer"]["enum"] == list(LAYERS)
    assert list(DEFINITIONS["proportions"]["properties"]) == list(PROPORTIONS)
    assert DEFINITIONS["point_name"]["enum"] == [point for points in FEATURE_POINTS.values() for point in points]
    for feature, points in FEATURE_POINTS.items():
        assert DEFINITIONS[f"points_{feature}"]["required"] == list(points)


def test_what_the_paper_has_is_told_from_extensions():
    motor_keys = DEFINITIONS["motors"]["properties"]
    assert [code for code, key in motor_keys.items() if not key.get("x-extension")] == list(paper_codes())
    polygon = DEFINITIONS["polygon"]["properties"]
    paper = [key for key, member in polygon.items() if not member.get("x-extension")]
    assert paper == ["id", "kind", "fill", "path", "feature", "motor", "min", "max"]


def test_references_lead_somewhere_and_ranges_have_a_maximum():
    def walk(value):
        if isinstance(value, dict):
            assert referred(value) or "$ref" not in value
            assert "maximum" in value or not {"minimum", "exclusiveMinimum"} & value.keys()
            for member in value.values():
                walk(member)
        elif isinstance(value, list):
            for item in value:
                walk(item)

    walk(toon_schema())


def test_the_command_prints_it(capfd, tmp_path):
    assert main(["toon", "schema"]) == 0
    assert json.loads(capfd.readouterr().out) == toon_schema()
    assert main(["toon", "schema", "-o", str(tmp_path / "s.json")]) == 0
    assert (tmp_path / "s.json").read_text(encoding="utf-8") == schema_text()
