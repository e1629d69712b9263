"""What trackers say by VMC: names, bones, and what becomes of a face when they fall silent."""

from __future__ import annotations

import math
import struct
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.core import MienError
from mien.live import Session, check_message
from mien.live.osc import decode_packet
from mien.live.turning import compose, from_angles, halve, multiply, to_angles
from mien.live.vmc import APPLY, BONE, HOLD_S, VALUE, VOCABULARIES, VmcReceiver, bone_axes, reach
from mien.vocab import pose_from, vocabulary
from support import face

STILL = {"blinks": 0.0, "saccades": 0.0, "breathing": 0.0, "sway": 0.0}
FACES = ("head", "toon:pip", "toon:gus")
LOOP_S = 1 / 60


def tell(receiver, values=(), **bones):
    """What a session is told after a tracker has sent values of expressions and (turn, nod, tilt) of bones."""
    for name, value in dict(values).items():
        receiver.take(VALUE, (name, value))
    for bone, angles in bones.items():
        receiver.take(BONE, (bone, 0.0, 0.0, 0.0, *from_angles(*angles)))
    receiver.take(APPLY, ())
    (message,) = receiver.messages(0) or [{"values": {}}]
    return message["values"]


@pytest.mark.parametrize("subject", FACES)
@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("vrm", {"Joy": 0.7, "A": 0.5}),
        ("vrm", {"happy": 0.7, "aa": 0.5}),
        ("vrm", {"JOY": 0.7, "a": 0.5}),
        ("vrm", {"Blink_L": 1.0}),
        ("vrm", {"blinkLeft": 1.0}),
        ("arkit", {"eyeBlinkLeft": 0.6, "jawOpen": 0.5, "mouthSmileLeft": 0.2}),
        ("arkit", {"EyeBlinkLeft": 0.6, "JawOpen": 0.5, "mouthSmile_L": 0.2}),
        ("arkit", {"eyeblinkleft": 0.6, "JAWOPEN": 0.5, "MOUTHSMILE_L": 0.2}),
    ],
)
def test_names_in_all_usual_spellings_move_the_face_as_its_vocabulary_does(subject, name, given):
    table = vocabulary(name)
    spelled = {each.lower(): each for each in (*table.names, *table.aliases)}
    pose = pose_from(name, {spelled[each.lower()]: value for each, value in given.items()}, face(subject))
    found = tell(VmcReceiver(face(subject), LOOP_S), given)
    assert pose.changed().items() <= found.items()
    assert all(value == pose[parameter] for parameter, value in found.items())


def test_no_name_of_one_vocabulary_is_one_of_another():
    names = [{each.lower() for each in (*vocabulary(v).names, *vocabulary(v).aliases)} for v in VOCABULARIES]
    assert not set.intersection(*names)


@pytest.mark.parametrize("subject", FACES)
@pytest.mark.parametrize("name", VOCABULARIES)
def test_every_name_reaches_just_what_it_moves(subject, name):
    reached = reach(name, face(subject))
    for each, parameters in reached.items():
        assert set(pose_from(name, {each: 1.0}, face(subject)).changed()) <= set(parameters)
    assert "neutral" not in reached


def test_both_vocabularies_can_be_told_at_once():
    found = tell(VmcReceiver(face("head"), LOOP_S), {"Joy": 1.0, "jawOpen": 0.5})
    assert found["jaw.rotation"] == 10
    assert found["mouth.expression.left"] < 1


def test_values_count_from_apply_on_and_until_they_are_told_anew():
    receiver = VmcReceiver(face("head"), LOOP_S)
    receiver.take(VALUE, ("jawOpen", 0.5))
    assert receiver.messages(0) == []
    receiver.take(APPLY, ())
    assert receiver.messages(0)[0]["values"] == {"jaw.rotation": 10}
    receiver.take(VALUE, ("jawForward", 1.0))
    receiver.take(VALUE, ("jawOpen", 0.25))
    assert receiver.values() == {"jaw.rotation": 10}
    receiver.take(APPLY, ())
    assert receiver.values() == {"jaw.rotation": 5, "jaw.forward": 1}


def test_values_out_of_range_are_held_at_its_ends():
    assert tell(VmcReceiver(face("head"), LOOP_S), {"jawOpen": 7, "jawForward": -1}) == {
        "jaw.rotation": 20,
        "jaw.forward": 0,
    }


@pytest.mark.parametrize("subject", FACES)
def test_bones_turn_head_and_eyes_to_the_own_left_and_up(subject):
    """In the channels of every face, turns to the own left and nods up are positive."""
    found = tell(VmcReceiver(face(subject), LOOP_S), Head=(12, 6, 0), LeftEye=(10, 5, 0), RightEye=(8, -4, 0))
    pose = pose_from("channels", {"head_turn": 12, "head_nod": 6, "eye_turn": 10, "eye_nod": 5}, face(subject))
    axes = bone_axes(face(subject))
    for bone, number, wanted in (("Head", 0, 12), ("Head", 1, 6), ("LeftEye", 0, 10), ("LeftEye", 1, 5)):
        _, parameter, gain = axes[bone][number]
        assert found[parameter] == pytest.approx(pose[parameter])
        assert found[parameter] == pytest.approx(gain * wanted)
    assert found[axes["RightEye"][0][1]] == pytest.approx(8 * axes["RightEye"][0][2])
    assert found[axes["RightEye"][1][1]] == pytest.approx(-4)


def test_both_bones_of_the_neck_count_and_angles_stay_in_range():
    receiver = VmcReceiver(face("head"), LOOP_S)
    found = tell(receiver, Neck=(10, 0, 0), Head=(15, 0, 0))
    assert found["head.turn"] == pytest.approx(25)
    assert tell(receiver, Neck=(80, 0, 0), Head=(15, 0, 0))["head.turn"] == face("head").parameters["head.turn"].high


def test_eyes_by_bone_and_by_name_add_up():
    found = tell(VmcReceiver(face("head"), LOOP_S), {"LookLeft": 0.5}, LeftEye=(5, 0, 0))
    alone = tell(VmcReceiver(face("head"), LOOP_S), {"LookLeft": 0.5})
    assert found["eye.turn.left"] == pytest.approx(alone["eye.turn.left"] + 5)
    assert found["eye.turn.right"] == alone["eye.turn.right"] > 0


def test_unity_turns_a_head_to_its_right_by_a_positive_angle_about_y():
    """By hand, in Unity's axes: the head looks along z; after 90 degrees about y it looks along x, which is its right.

    About x by 90 degrees it looks along -y, down; about z by 90 degrees its top goes to -x, its left.
    """
    half = math.sqrt(0.5)
    assert to_angles((0, half, 0, half))[0] == pytest.approx(-90)
    assert to_angles((math.sin(0.2), 0, 0, math.cos(0.2)))[1] == pytest.approx(-math.degrees(0.4))
    assert to_angles((0, 0, half, half))[2] == pytest.approx(90)


def test_turns_are_products_by_hand():
    """Hamilton: i j = k, j i = -k."""
    assert multiply((1, 0, 0, 0), (0, 1, 0, 0)) == (0, 0, 1, 0)
    assert multiply((0, 1, 0, 0), (1, 0, 0, 0)) == (0, 0, -1, 0)


ANGLES = st.tuples(*[st.floats(-80, 80)] * 3)


@given(ANGLES)
def test_angles_survive_being_a_rotation(angles):
    assert to_angles(from_angles(*angles)) == pytest.approx(angles, abs=1e-6)
    assert to_angles(compose([halve(from_angles(*angles))] * 2)) == pytest.approx(angles, abs=1e-6)


def test_a_tracker_that_falls_silent_leaves_the_face_in_two_seconds():
    session = Session(face("head"), LOOP_S, idle=STILL)
    receiver = VmcReceiver(face("head"), LOOP_S)
    session.handle({"kind": "move", "values": {"jaw.forward": 0.5}})
    receiver.take(VALUE, ("jawOpen", 0.5))
    receiver.take(APPLY, ())
    said = []
    for _ in range(200):
        for message in receiver.messages(session.loop):
            said.append((session.loop, message["kind"]))
            assert session.handle(message)["kind"] == "ok"
        session.step()
    assert said == [(0, "move"), (round(HOLD_S / LOOP_S), "stop")]
    index = face("head").parameters.index
    assert session.values[index["jaw.rotation"]] == 0
    assert session.values[index["jaw.forward"]] == 0.5, "what somebody else holds stays"
    receiver.take(APPLY, ())
    assert receiver.messages(session.loop) == [], "what the tracker said before is forgotten"


@pytest.mark.parametrize("subject", FACES)
def test_everything_at_once_is_a_message(subject):
    receiver = VmcReceiver(face(subject), LOOP_S)
    names = [each for name in VOCABULARIES for each in vocabulary(name).names]
    found = tell(receiver, dict.fromkeys(names, 1.0), Head=(9, 9, 9), LeftEye=(9, 9), RightEye=(9, 9))
    check_message({"kind": "move", "values": found})
    (stop,) = receiver.messages(1000)
    session = Session(face(subject), LOOP_S, idle=STILL)
    assert session.handle({"kind": "move", "values": found})["kind"] == "ok"
    assert session.handle(stop)["kind"] == "ok"


@pytest.mark.parametrize(
    ("address", "arguments", "words"),
    [
        (VALUE, (), "want a name and 1 numbers"),
        (VALUE, ("Joy",), "want a name and 1 numbers"),
        (VALUE, ("Joy", "1"), "want a name and 1 numbers"),
        (VALUE, ("Joy", True), "want a name and 1 numbers"),
        (VALUE, ("Joy", math.nan), "want a name and 1 numbers"),
        (VALUE, (1.0, "Joy"), "want a name and 1 numbers"),
        (VALUE, ("Jyo", 1.0), "'Jyo' is no expression"),
        (BONE, ("Head", 0, 0, 0, 0, 0, 1), "want a name and 7 numbers"),
        (BONE, ("Head", 0, 0, 0, 0, 0, 0, 0), "length 0"),
        (BONE, ("Head", 0, 0, 0, math.inf, 0, 0, 1), "want a name and 7 numbers"),
        (BONE, ("Head", 0, 0, 0, 9, 0, 0, 1), "length 9"),
    ],
)
def test_wrong_arguments_are_refused_and_change_nothing(address, arguments, words):
    receiver = VmcReceiver(face("head"), LOOP_S)
    with pytest.raises(MienError, match=words):
        receiver.take(address, arguments)
    receiver.take(APPLY, ())
    assert receiver.messages(0) == []


@pytest.mark.parametrize(
    ("address", "arguments"),
    [
        ("/VMC/Ext/OK", (1,)),
        ("/VMC/Ext/T", (0.1,)),
        ("/VMC/Ext/Root/Pos", ("root", 0, 0, 0, 0, 0, 0, 1)),
        ("/VMC/Ext/Rcv", ()),
        ("/VMC/", ()),
        (BONE, ("Hips", 0, 0, 0, 0, 0, 0, 1)),
    ],
)
def test_what_means_nothing_to_a_face_is_passed_over(address, arguments):
    receiver = VmcReceiver(face("head"), LOOP_S)
    receiver.take(address, arguments)
    assert receiver.messages(0) == []


def test_more_arguments_than_are_known_are_passed_over():
    receiver = VmcReceiver(face("head"), LOOP_S)
    receiver.take(VALUE, ("jawOpen", 0.5, "later", 3))
    receiver.take(APPLY, (1,))
    assert receiver.values() == {"jaw.rotation": 10}


def test_bytes_as_a_tracker_sends_them():
    """By hand: a bundle at once of Blend/Val jawOpen 0.5 and Blend/Apply."""
    value = b"/VMC/Ext/Blend/Val\0\0" + b",sf\0" + b"jawOpen\0" + bytes([0x3F, 0, 0, 0])
    apply = b"/VMC/Ext/Blend/Apply\0\0\0\0" + b",\0\0\0"
    bundle = b"#bundle\0" + bytes([0, 0, 0, 0, 0, 0, 0, 1])
    bundle += struct.pack(">i", len(value)) + value + struct.pack(">i", len(apply)) + apply
    receiver = VmcReceiver(face("head"), LOOP_S)
    for call in decode_packet(bundle):
        receiver.take(*call)
    assert receiver.messages(3) == [{"kind": "move", "values": {"jaw.rotation": 10.0}}]


ARGUMENT = st.one_of(
    st.floats(), st.integers(), st.sampled_from(["Head", "Joy", "A", "LeftEye", ""]), st.none(), st.binary(max_size=3)
)


@given(st.lists(st.tuples(st.sampled_from([VALUE, APPLY, BONE]), st.lists(ARGUMENT, max_size=9)), max_size=9))
def test_any_calls_are_messages_or_refused(calls):
    receiver = VmcReceiver(face("toon:pip"), LOOP_S)
    for address, arguments in calls:
        with suppress(MienError):
            receiver.take(address, tuple(arguments))
    for message in receiver.messages(0):
        check_message(message)


def test_stop_lets_go_of_named_values_and_leaves_the_others():
    session = Session(face("head"), LOOP_S, idle=STILL)
    session.handle({"kind": "move", "values": {"jaw.rotation": 10, "jaw.forward": 0.5, "MLV": 1}})
    session.step()
    for names, layer in ((["jaw.rotation", "nobody"], "direct"), (["jaw.rotation"], "speech")):
        assert session.handle({"kind": "stop", "layer": layer, "names": names})["kind"] == "error"
    answer = session.handle({"kind": "stop", "layer": "direct", "names": ["jaw.rotation", "MLV"], "over_ms": 100})
    assert answer == {"kind": "ok"}
    for _ in range(7):
        session.step()
    names = ["jaw.rotation", "jaw.forward", "MLV", "mouth.expression.left"]
    state = session.handle({"kind": "state", "names": names})["values"]
    assert state == {"jaw.rotation": 0, "jaw.forward": 0.5, "MLV": 0.5, "mouth.expression.left": 1}
