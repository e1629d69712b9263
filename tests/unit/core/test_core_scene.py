"""Scenes: views, refusals, lights that move with the viewer, rows that a face takes from the scene."""

import math
from dataclasses import dataclass, field, replace

import numpy as np
import pytest

from mien.core import (
    Drawing,
    Face,
    Light,
    Parameter,
    ParameterTable,
    Pose,
    RangeError,
    Scene,
    UnknownNameError,
    fill_rows,
)
from mien.core.scene import BACKGROUND, CENTRE, DISTANCE_M, VIEWS


def xyz(group, low=-2.0, high=2.0):
    return tuple(Parameter(f"{group}.{axis}", low, high, unit="m") for axis in "xyz")


@dataclass(frozen=True)
class ToyFace:
    """A face that only has a table."""

    parameters: ParameterTable
    name: str = "toy"
    family: str = "toy"
    presets: dict = field(default_factory=dict)

    @property
    def unsubdivided(self):
        return self

    @property
    def neutral(self):
        return Pose.neutral(self.parameters)

    def shape(self, pose):
        return Drawing((1.0, 1.0), ())


def test_a_toy_face_is_a_face():
    assert isinstance(ToyFace(ParameterTable(())), Face)


@pytest.mark.parametrize(("view", "axis", "sign"), [("front", 2, 1), ("side", 0, 1)])
def test_a_view_stands_on_its_axis(view, axis, sign):
    scene = Scene().seen(view)
    way = np.subtract(scene.position, scene.at)
    assert np.argmax(np.abs(way)) == axis
    assert way[axis] * sign > 0.99 * DISTANCE_M * math.cos(math.radians(3))


def test_three_quarter_shows_the_face_s_own_left():
    scene = Scene().seen("three-quarter")
    assert scene.position[0] > 0.2
    assert scene.position[2] > 0.8


@pytest.mark.parametrize("view", VIEWS)
def test_views_keep_their_distance_and_their_aim(view):
    scene = Scene().seen(view)
    assert scene.at == CENTRE
    assert math.dist(scene.position, scene.at) == pytest.approx(DISTANCE_M, abs=2e-6)


def test_turning_by_hand():
    scene = Scene(at=(0.0, 0.0, 0.0), position=(0.0, 0.0, 2.0))
    assert scene.turned(90.0).position == (2.0, 0.0, 0.0)
    assert scene.turned(0.0, 90.0).position == (0.0, 2.0, 0.0)
    assert scene.turned(180.0, distance_m=1.0).position == (0.0, 0.0, -1.0)
    assert scene.turned(30.0).position == (1.0, 0.0, 1.732051)


def test_an_unknown_view_gets_near_matches():
    with pytest.raises(UnknownNameError, match="unknown view 'threequarter' — did you mean 'three-quarter'"):
        Scene().seen("threequarter")


@pytest.mark.parametrize(
    ("setting", "text"),
    [
        ({"size_px": (0, 10)}, "size 0x10 is out of range — each side is 1 to 16384 pixels"),
        ({"size_px": (10, 16385)}, "size 10x16385 is out of range"),
        ({"fov_deg": 0.0}, "field of view 0 is out of range — it goes from 0.1 to 170 degrees"),
        ({"fov_deg": 171.0}, "field of view 171 is out of range"),
        ({"fov_deg": math.nan}, "field of view nan is out of range"),
        ({"subdivide": 3}, "subdivide 3 is out of range — it is 0, 1 or 2"),
        ({"cosine_power": 0}, "cosine power 0 is out of range"),
        ({"position": (0.0, math.nan, 1.0)}, "every number must be finite"),
        ({"at": (math.inf, 0.0, 0.0)}, "every number must be finite"),
        ({"position": CENTRE}, "the very point that it looks at"),
    ],
)
def test_impossible_scenes_are_refused(setting, text):
    with pytest.raises(RangeError) as caught:
        Scene(**setting)
    assert text in str(caught.value)


def test_an_unknown_shading_is_refused():
    with pytest.raises(UnknownNameError, match="unknown shading 'smoth' — did you mean 'smooth'"):
        Scene(shading="smoth")


def test_own_lights_replace_the_default_ones():
    lamp = Light((0.0, 1.0, 0.0), (1.0, 1.0, 1.0))
    assert Scene(lights=(lamp,)).lamps == (lamp,)
    assert len(Scene().lamps) == 4


def test_the_default_lights_move_around_with_the_viewer():
    front, side = Scene().seen("front").lamps, Scene().turned(90.0, 2.0).lamps
    for before, after in zip(front, side, strict=True):
        assert after.position == pytest.approx((before.position[2], before.position[1], -before.position[0]), abs=2e-6)
        assert after.color == before.color


def test_the_key_light_comes_from_the_left_of_the_picture():
    key, fill = Scene().seen("front").lamps[:2]
    assert key.position[0] < 0 < fill.position[0]
    assert sum(key.color) > 3 * sum(fill.color)


def test_parke_s_scene_has_one_light_and_no_highlight():
    scene = Scene.parke(diffuse=0.25, cosine_power=3, size_px=(64, 64))
    (light,) = scene.lamps
    assert light.color == (0.75, 0.75, 0.75)
    assert scene.ambient == ((0.25,) * 3, (0.25,) * 3)
    assert (scene.gloss, scene.cosine_power, scene.size_px) == (0.0, 3, (64, 64))


def test_rows_at_rest_are_filled_from_the_scene():
    table = ParameterTable((*xyz("light"), *xyz("viewer"), *xyz("target"), Parameter("jaw.rotation", 0, 20)))
    lamp = Light((1.0, 1.5, 0.5), (1.0, 1.0, 1.0))
    scene = Scene(position=(0.1, 0.2, 1.0), lights=(lamp,), target=(0.0, -0.5, 1.9))
    pose = fill_rows(ToyFace(table), Pose.neutral(table).replace({"jaw.rotation": 8}), scene)
    assert pose.values.tolist() == [1.0, 1.5, 0.5, 0.1, 0.2, 1.0, 0.0, -0.5, 1.9, 8.0]


def test_eyes_look_at_the_viewer_unless_told_otherwise():
    table = ParameterTable(xyz("target"))
    scene = Scene(position=(0.1, 0.2, 1.0))
    assert fill_rows(ToyFace(table), Pose.neutral(table), scene).values.tolist() == [0.1, 0.2, 1.0]
    told = Pose.neutral(table).replace({"target.x": 0.5})
    assert fill_rows(ToyFace(table), told, scene) == told


def test_a_place_beyond_a_row_s_range_is_brought_into_it():
    table = ParameterTable(xyz("viewer", -0.5, 0.5))
    pose = fill_rows(ToyFace(table), Pose.neutral(table), Scene(position=(0.1, -3.0, 1.0)))
    assert pose.values.tolist() == [0.1, -0.5, 0.5]


def test_a_face_without_such_rows_is_left_alone():
    table = ParameterTable((Parameter("jaw.rotation", 0, 20),))
    pose = Pose.neutral(table)
    assert fill_rows(ToyFace(table), pose, Scene()) is pose


def test_scenes_are_compared_by_value():
    assert Scene() == Scene()
    assert replace(Scene(), fov_deg=20.0) != Scene()


def test_behind_a_face_is_what_the_scene_says_or_its_own_or_the_usual():
    red, blue = (1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0)
    assert Scene().behind() == BACKGROUND
    assert Scene().behind(red) == (red, red)
    assert Scene(background=(blue, red)).behind(red) == (blue, red)
