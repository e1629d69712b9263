import json

import pytest

from mien.core import LoadError, MienError
from mien.faces.registry import load_face
from mien.faces.toon.reader import parse_toon, read_toon
from mien.faces.toon.records import Shift, Touch
from toons import extended, small


def edited(change, document=None):
    document = small() if document is None else document
    change(document)
    return document


def polygon(number, **keys):
    return lambda document: document["polygons"][number].update(keys)


def test_a_file_becomes_records():
    character = parse_toon(json.dumps(small()), "small.toon.json")
    assert (character.name, character.mode, character.size) == ("small", "strict", (200.0, 200.0))
    assert character.motors["BRL"].high == 15.0
    assert character.features["ER"].points["ERI"] == (80.0, 90.0)
    assert [each.kind for each in character.polygons][:2] == ["face", "hole"]


def test_extensions_become_records():
    document = extended(
        {
            "id": "tongue", "kind": "point", "fill": "ink", "path": "M0 0 H1 V1 Z", "clip": ["eye_R"], "opacity": 0.5,
            "drivers": [
                {"motor": "MB", "max": {"move": [0, 9], "rotate": 10}},
                {"motor": "MLV", "max": {"touch": {"feature": "M"}}},
            ],
        },
        palettes={"night": {"skin": "#112233"}},
        expressions={"smile": {"MLV": 1, "HV": 3}},
        proportions={"eyes.size": [0.9, 1.1]},
    )  # fmt: skip
    character = parse_toon(json.dumps(document), "x")
    move, touch = (driver.high for driver in character.polygons[-1].drivers)
    assert isinstance(move, Shift)
    assert (move.move, move.rotate_deg) == ((0.0, 9.0), 10.0)
    assert isinstance(touch, Touch)
    assert character.palettes == {"night": {"skin": "#112233"}}
    assert character.expressions == {"smile": {"MLV": 1.0, "HV": 3.0}}
    assert character.proportions == {"eyes.size": (0.9, 1.1)}


FAULTS = {
    "another format": (lambda d: d.update(format="toon/1"), "format: is not 'mien-toon'"),
    "another version": (lambda d: d.update(version=2), "version: is not 1"),
    "an unknown key": (lambda d: d.update(colour="red"), "key 'colour'"),
    "an unknown key of a polygon": (polygon(0, colour="red"), r"polygons\[0\]: key 'colour'"),
    "a missing feature": (lambda d: d["features"].pop("PL"), "'PL', one of the seven features"),
    "a missing motor": (lambda d: d["motors"].pop("ELU"), "'ELU', one of the 21 motors"),
    "an unknown motor": (lambda d: d["motors"].update(XYZ={}), "motor 'XYZ'"),
    "a missing point": (lambda d: d["features"]["M"]["points"].pop("MT"), r"features.M.points.MT: is missing"),
    "an unknown feature": (polygon(5, feature="BX"), r"polygons\[5\].feature: feature 'BX'"),
    "a brow on nothing": (lambda d: d["polygons"][5].pop("feature"), "is attached to one, but none is named"),
    "minimum above maximum": (lambda d: d["motors"]["MB"].update(min=50), "the minimum 50 is above the maximum 38"),
    "rest outside": (lambda d: d["motors"]["MB"].update(min=5), "rest, 0, is not between 5 and 38"),
    "no degrees": (lambda d: d["motors"]["HH"].clear(), "wants min_deg and max_deg"),
    "too many degrees": (lambda d: d["motors"]["HH"].update(max_deg=120), "less than 90 degrees"),
    "states that differ": (polygon(7, max="M0 0 L1 1 Z"), "other path commands than min"),
    "one state": (lambda d: d["polygons"][7].pop("max"), "want both states"),
    "two sources": (polygon(0, min="M0 0 L1 1 Z"), "want one of path"),
    "no source": (lambda d: d["polygons"][0].pop("path"), "want one of path"),
    "an id twice": (polygon(1, id="face"), "'face' is the id of another polygon"),
    "an unknown colour": (polygon(0, fill="skim"), r"polygons\[0\].fill: colour 'skim'.*skin"),
    "a bad colour": (lambda d: d["palette"].update(skin="#12"), "'#12' is not a colour"),
    "bad path data": (polygon(0, path="M0 0 K 3"), r"polygons\[0\].path: path data: 'K'"),
    "two points": (polygon(0, path=[[0, 0], [1, 1]]), "at least three points"),
    "a text for a number": (lambda d: d["motors"]["MB"].update(max="a lot"), "motors.MB.max: want a number"),
    "true for a number": (lambda d: d["motors"]["MB"].update(max=True), "want a number, got true or false"),
    "a wild number": (lambda d: d.update(size=[1e9, 3]), "within a million"),
    "no size": (lambda d: d.update(size=[0, 3]), "two sides above 0"),
    "an unknown kind": (polygon(0, kind="nose"), "'nose'"),
    "an unknown clip": (polygon(0, clip="eye"), r"polygons\[0\].clip: polygon 'eye'"),
    "a list for an object": (lambda d: d.update(motors=[]), "motors: want an object"),
    "an object for a list": (lambda d: d.update(polygons={}), "polygons: want a list"),
    "an expression out of range": (
        lambda d: d.update(expressions={"smile": {"MLV": 2}}),
        "smile.MLV: 2 is out of range",
    ),
    "an expression of no motor": (lambda d: d.update(expressions={"smile": {"ML": 1}}), "motor 'ML'"),
    "a proportion that excludes rest": (lambda d: d.update(proportions={"eyes.size": [2, 3]}), "limits around 1"),
    "an unknown proportion": (lambda d: d.update(proportions={"eye.size": [1, 3]}), "eyes.size"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_told_with_its_place(name):
    change, words = FAULTS[name]
    with pytest.raises(LoadError, match=words) as told:
        parse_toon(json.dumps(edited(change)), "small.toon.json")
    assert str(told.value).startswith("small.toon.json")
    assert "mien toon check" in str(told.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{", "small.toon.json:1: is not JSON"),
        ("[]", "want an object"),
        ("[" * 100_000, "nested too deeply|is not JSON"),
        ('{"format": NaN}', "want a text"),
    ],
)
def test_what_is_no_face_is_told(text, words):
    with pytest.raises(LoadError, match=words):
        parse_toon(text, "small.toon.json")


def test_files_are_faces(tmp_path):
    path = tmp_path / "small.toon.json"
    path.write_text("\ufeff" + json.dumps(small()), encoding="utf-8")
    face = load_face(str(path))
    assert face.name == str(path)
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(LoadError, match="UTF-8"):
        read_toon(path)
    with pytest.raises(LoadError, match="no such file"):
        load_face(str(tmp_path / "gone.toon.json"))
    with pytest.raises(MienError, match="toon:olav"):
        load_face("toon:olaf")


def test_more_points_than_a_drawing_needs_are_refused():
    many = [[k % 100, k // 100] for k in range(100_001)]
    with pytest.raises(LoadError, match="more than 100,000 points"):
        parse_toon(json.dumps(edited(polygon(0, path=many))), "x")
