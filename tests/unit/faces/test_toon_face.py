import numpy as np
import pytest

import mien
from mien.core import Pose, Scene
from mien.core.variety import random_person
from mien.faces.registry import load_face
from mien.faces.toon.lines import rest_of
from mien.faces.toon.motors import motors, paper_codes
from mien.faces.toon.shipped import toon_names
from mien.faces.toon.table import linear_color
from toons import extended, face_of, small

every_toon = pytest.mark.parametrize("name", toon_names())


def paths(face, values=()):
    return {path.name: path for path in face.shape(face.neutral.replace(dict(values))).paths}


def test_codes_and_numbers_are_names_of_the_rows():
    table = face_of(small()).parameters
    for names in (("ELU", "8-1", "8-V", "eyelid.upper.left"), ("MLH", "14-0", "14-H", "mouth.corner.horizontal.left")):
        assert len({table[name].name for name in names}) == 1
    assert table.resolve("eyelid.upper") == ("eyelid.upper.left", "eyelid.upper.right")
    assert (table["HH"].low, table["HH"].high, table["HH"].unit) == (-20.0, 20.0, "deg")
    assert (table["BRL"].low, table["BRL"].high, table["BRL"].default) == (0.0, 1.0, 0.25)
    assert "MT" not in table


def test_colours_are_rows():
    face = face_of(small())
    assert paths(face)["face"].color == pytest.approx((*linear_color("#F3B997"), 1.0))
    assert paths(face, {"palette.skin.red": 0.25})["face"].color[0] == 0.25
    assert paths(face, {"palette.skin.red": 0.25})["hat"].color == paths(face)["hat"].color


def test_palettes_are_presets():
    face = face_of(extended(palettes={"night": {"skin": "#102030"}}))
    night = face.neutral.replace(face.presets["night"].values)
    assert {path.name: path for path in face.shape(night).paths}["face"].color[:3] == pytest.approx(
        linear_color("#102030")
    )
    back = night.replace(face.presets["own"].values)
    np.testing.assert_allclose(back.values, face.neutral.values)


def test_expressions_of_the_file_win_over_those_of_the_family():
    plain, own = face_of(small()), face_of(small(expressions={"smile": {"MLV": 0.75}, "smug": {"MRV": 1}}))
    assert dict(own.presets["smile"].values) == {"mouth.corner.vertical.left": 0.75}
    assert "smug" in own.presets
    assert plain.presets["smile"].values["mouth.corner.vertical.left"] > 0.75
    assert dict(plain.presets["neutral"].values) == {}


def test_a_turn_moves_the_head_and_leaves_the_body():
    coat = {"id": "coat", "kind": "free", "fill": "ink", "path": "M0 190 H200 V200 H0 Z", "body": True, "layer": "back"}
    document = extended(coat)
    document["head"]["depth"] = 0.3
    face = face_of(document)
    rest, turned = paths(face), paths(face, {"HH": 20})
    moved = turned["hat"].contours[0] - rest["hat"].contours[0]
    assert (moved[:, 0] < -1.0).all()  # to the left as one sees it
    np.testing.assert_array_equal(turned["coat"].contours[0], rest["coat"].contours[0])
    assert (paths(face, {"HV": 20})["hat"].contours[0][:, 1] > rest["hat"].contours[0][:, 1]).all()  # up


def test_what_follows_a_line_turns_with_the_depth_of_its_feature():
    line = {"feature": "M"}
    document = extended(
        {"id": "brush", "kind": "feature", "fill": "ink", "stroke": line, "width": 3},
        {
            "id": "band",
            "kind": "feature",
            "fill": "ink",
            "span": [{**line, "line": "upper"}, {**line, "line": "lower"}],
        },
        {"id": "near", "kind": "feature", "fill": "ink", "stroke": line, "width": 3, "depth": 0.5},
    )
    document["features"]["M"]["depth"] = 0.3
    face = face_of(document)
    rest, turned = paths(face), paths(face, {"HH": 20})
    way = document["head"]["radius"][0] * np.sin(np.deg2rad(20.0))
    for name, depth in (("brush", 0.3), ("band", 0.3), ("near", 0.5)):
        moved = turned[name].contours[0] - rest[name].contours[0]
        np.testing.assert_allclose(moved[:, 0], -depth * way, rtol=1e-9)


def test_the_picture_has_the_background_of_the_drawing():
    picture = mien.draw(face_of(small(background="#336699")), scene=Scene(size_px=(300, 100)))
    assert picture.pixels[50, 5].tolist() == [0x33, 0x66, 0x99, 255]


@every_toon
def test_every_character_has_his_21_motors_and_each_moves_something(name):
    face = load_face(f"toon:{name}")
    rest = paths(face)
    for code in paper_codes():
        row = face.parameters[code]
        for value in {row.low, row.high} - {row.default}:
            now = paths(face, {code: value})
            moved = max(
                float(np.abs(a - b).max())
                for key in rest
                for a, b in zip(rest[key].contours, now[key].contours, strict=True)
            )
            assert moved > 0.5, (code, value)


@every_toon
def test_every_character_can_all_named_expressions_of_the_head(name):
    head = {name for name, preset in load_face("head").presets.items() if preset.kind == "expression"}
    face = load_face(f"toon:{name}")
    assert head <= {name for name, preset in face.presets.items() if preset.kind == "expression"}
    for preset in face.presets.values():
        face.shape(face.neutral.replace(preset.values))


@every_toon
def test_pupils_stay_within_their_eyes_at_every_corner(name):
    face = load_face(f"toon:{name}")
    for horizontal in ("low", "high"):
        for vertical in ("low", "high"):
            values = {}
            for side in "RL":
                values[f"P{side}H"] = getattr(face.parameters[f"P{side}H"], horizontal)
                values[f"P{side}V"] = getattr(face.parameters[f"P{side}V"], vertical)
            points = face.moment(face.neutral.replace(values)).points
            for side, outer, inner in (("R", "ERO", "ERI"), ("L", "ELI", "ELO")):
                x, y = points[f"P{side}"]
                assert points[outer][0] < x < points[inner][0]
                assert points[f"E{side}U"][1] < y < points[f"E{side}L"][1]


@every_toon
def test_neutral_is_rest(name):
    face = load_face(f"toon:{name}")
    moment = face.moment(face.neutral)
    assert all(abs(value) < 1e-12 for value in moment.activations.values())
    assert moment.points == rest_of(face.character).points


@every_toon
def test_people_drawn_by_chance_stay_within_the_limits_of_the_character(name):
    face = load_face(f"toon:{name}")
    someone, other = random_person(face, 1), random_person(face, 2)
    assert isinstance(someone, Pose)
    assert someone != other or not face.character.proportions
    codes = [motors()[code].parameter for code in face.character.motors]
    assert all(someone[code] == face.neutral[code] for code in codes)
    face.shape(someone)


def test_the_same_pose_gives_the_same_drawing():
    face, other = load_face("toon:olav"), load_face("toon:olav")
    values = {"MB": 0.4, "HH": 9.0, "ELU": 0.3}
    one, two = paths(face, values), paths(other, values)
    assert all(np.array_equal(a, b) for key in one for a, b in zip(one[key].contours, two[key].contours, strict=True))
