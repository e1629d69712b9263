"""The hand of a drawn face: shipped ones in the colours of a character, poses, moves, out of sight at rest."""

import json

import numpy as np
import pytest

from mien.core import LoadError
from mien.faces.registry import load_face
from mien.faces.toon.hands import SLOTS, gestures, hand_names
from mien.faces.toon.reader import parse_toon
from mien.faces.toon.toon import ToonFace
from support import FACE_NAMES, face
from toons import extended, small

ARMED = [name for name in FACE_NAMES if "hand.raise" in face(name).parameters]
USE = {
    "use": "cartoon",
    "at": [150, 150],
    "scale": 0.5,
    "skin": "skin",
    "shade": "ink",
    "sleeve": "#123456",
    "fold": "ink",
}


def with_hand(**keys):
    document = extended({"id": "dot", "kind": "free", "fill": "ink", "path": "M0 0 H1 V1 Z"})
    return {**document, "hand": {**USE, **keys}}


def read(document):
    return ToonFace(parse_toon(json.dumps(document), "armed.toon.json"), "armed")


def hand_points(subject, **values):
    drawing = subject.shape(subject.neutral.replace(values))
    return np.concatenate([path.contours[0] for path in drawing.paths if path.name.startswith("hand_")])


def test_a_shipped_hand_takes_place_size_and_colours():
    one, half = (
        np.stack([each.min(axis=0), each.max(axis=0)])
        for each in (hand_points(read(with_hand(scale=1.0, at=[0, 0])), HY=1), hand_points(read(with_hand()), HY=1))
    )
    np.testing.assert_allclose(half - [150.0, 50.0], 0.5 * (one - [0.0, 200.0]), atol=0.3)  # y up, 200 high
    half = read(with_hand())
    colors = {path.name: path.color for path in half.shape(half.neutral).paths}
    assert colors["hand_palm"][:3] == tuple(half.neutral[f"palette.skin.{c}"] for c in ("red", "green", "blue"))
    assert colors["hand_sleeve"] == pytest.approx((0.00605, 0.03434, 0.09306, 1.0), abs=1e-5)


@pytest.mark.parametrize("name", hand_names())
def test_every_shipped_hand_can_do_all_gestures_and_every_motor_moves_it(name):
    subject = read(with_hand(use=name))
    assert [each.name for each in subject.character.gestures] == [each.name for each in gestures()]
    rest = hand_points(subject)
    for code in ("HR", "HY", "HI", "HM", "HO", "HB", "HP"):
        assert np.abs(hand_points(subject, **{code: 1}) - rest).max() > 4.0, code


@pytest.mark.parametrize("name", ARMED)
def test_a_hand_is_out_of_sight_at_rest_and_in_the_picture_in_every_gesture(name):
    subject = face(name)
    down = subject.shape(subject.neutral.replace({"hand.raise": 0})).paths
    up = subject.shape(subject.neutral.replace({"hand.raise": 1})).paths
    moved = [
        k for k, (a, b) in enumerate(zip(down, up, strict=True)) if not np.array_equal(a.contours[0], b.contours[0])
    ]
    assert moved
    assert max(down[k].contours[0][:, 1].max() for k in moved) < 0.0
    for preset in subject.presets.values():
        if preset.kind in ("hand", "move") and preset.name != "down":
            paths = subject.shape(subject.neutral.replace(preset.values)).paths
            points = np.concatenate([paths[k].contours[0] for k in moved])
            assert points[:, 1].max() > 100.0, preset.name
            assert points[:, 0].max() < 1.12 * subject.character.size[0], preset.name


def test_the_hand_does_not_turn_with_the_head():
    subject = load_face("toon:olav")
    np.testing.assert_array_equal(hand_points(subject, HY=1), hand_points(subject, HY=1, HH=20, HT=5))


def test_a_gesture_needs_all_its_motors_and_pip_has_no_ring():
    names = {name for name, preset in load_face("toon:pip").presets.items() if preset.kind in ("hand", "move")}
    assert {"wave", "point", "thumbs_up"} <= names
    assert "ok" not in names
    assert not any(preset.kind == "hand" for preset in load_face("toon:miso").presets.values())


def test_own_poses_and_moves_replace_and_add():
    poses = {"open": {"HY": 0.5}, "salute": {"HY": 1, "HB": 1}}
    keys = [{"time": 0.2, "values": {"HY": 1}}, {"time": 0.5, "values": {"HR": 1}}]
    presets = read(with_hand(poses=poses, moves={"hi": keys})).presets
    assert presets["open"].values == {"hand.raise": 0.5}
    assert (presets["salute"].kind, presets["hi"].kind) == ("hand", "move")
    assert presets["hi"].keys == ((0.2, {"hand.raise": 1.0}), (0.5, {"hand.turn": 1.0}))


FAULTS = {
    "an unknown hand": ({"use": "paw"}, "hand.use: hand 'paw'"),
    "an unknown colour": ({"fold": "pink"}, "hand.fold: colour 'pink'"),
    "an unknown key": ({"colour": "pink"}, "hand: key 'colour'"),
    "no size": ({"scale": 0}, "hand.scale: 0 is out of range"),
    "no place": ({"at": 3}, r"hand.at: want two numbers"),
    "an unknown motor": ({"poses": {"open": {"HX": 1}}}, "hand.poses.open: motor 'HX'"),
    "a value out of range": ({"poses": {"open": {"HY": 2}}}, "hand.poses.open.HY: 2 is out of range"),
    "keys that go back": (
        {"moves": {"hi": [{"time": 1, "values": {}}, {"time": 0.5, "values": {}}]}},
        "hand.moves.hi: want two keys or more whose times go up",
    ),
}


@pytest.mark.parametrize(("keys", "message"), FAULTS.values(), ids=FAULTS)
def test_faults_are_told_with_their_place(keys, message):
    with pytest.raises(LoadError, match=message):
        read(with_hand(**keys))


@pytest.mark.parametrize("slot", SLOTS)
def test_every_colour_is_wanted(slot):
    document = with_hand()
    del document["hand"][slot]
    with pytest.raises(LoadError, match=f"hand.{slot}: is missing"):
        read(document)


def test_a_strict_face_has_no_hand():
    with pytest.raises(LoadError, match="hand: a strict face has none"):
        read({**small(), "hand": USE})


def test_a_part_of_that_name_is_refused():
    document = with_hand()
    document["parts"] = {"hand": [{"motor": "MB", "max": {"move": [0, 1]}}]}
    with pytest.raises(LoadError, match="'hand' is the part of the shared hand"):
        read(document)
