"""Poses as packets of VMC, and what a receiver makes of them."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.core import UnknownNameError
from mien.live import Session
from mien.live.osc import decode_packet, encode_bundles, encode_call
from mien.live.turning import compose, to_angles
from mien.live.vmc import APPLY, BONE, VALUE, VmcReceiver
from mien.live.vmc_sending import LONGEST, NAMES, OK, TIME, VmcEncoder
from mien.vocab import pose_from, set_values
from support import face

FACES = ("head", "toon:pip", "toon:gus")


def calls(packets):
    return [call for packet in packets for call in decode_packet(packet)]


def values(packets):
    return {arguments[0]: arguments[1] for address, arguments in calls(packets) if address == VALUE}


def received(subject, packets):
    """The pose that a receiver with the same face takes from packets."""
    receiver = VmcReceiver(face(subject), 1 / 60)
    for call in calls(packets):
        receiver.take(*call)
    (message,) = receiver.messages(0)
    return face(subject).neutral.replace(message["values"])


def differences(pose, other):
    """(P,) of two poses, as shares of the range of each parameter."""
    return np.abs(pose.values - other.values) / (pose.table.highs - pose.table.lows)


@pytest.mark.parametrize("names", NAMES)
@pytest.mark.parametrize("subject", FACES)
def test_every_frame_says_everything_in_packets_that_travel_whole(subject, names):
    encoder = VmcEncoder(face(subject), names)
    packets = encoder.encode(face(subject).neutral, 2.5)
    assert all(len(packet) <= LONGEST for packet in packets)
    told = calls(packets)
    assert told[0] == (OK, (1, 3, 0, 1))
    assert told[1] == (TIME, (2.5,))
    assert told[-1] == (APPLY, ())
    assert {arguments[0] for address, arguments in told if address == BONE} == {"Neck", "Head", "LeftEye", "RightEye"}
    assert all(type(each) is float for address, arguments in told if address == BONE for each in arguments[1:])
    assert len(values(packets)) == (18 if names.startswith("vrm") else 52)


def test_values_are_floats_even_where_they_are_whole():
    """Receivers in Unity take no other type."""
    packets = VmcEncoder(face("head")).encode(face("head").neutral, 0.0)
    assert packets[0].count(b",sf\0") == 18
    assert packets[0].count(b",sfffffff\0\0\0") == 4
    assert b",si" not in packets[0]


def test_names_are_those_of_the_set():
    pose = pose_from("vrm", {"happy": 0.8, "blinkLeft": 0.6}, face("head"))
    smile = pose_from("arkit", {"mouthSmileLeft": 0.7}, face("head"))
    for names, shown, wanted in (
        ("vrm0", pose, {"Joy": 0.8, "Blink_L": 0.6}),
        ("vrm1", pose, {"happy": 0.8, "blinkLeft": 0.6}),
        ("arkit", smile, {"mouthSmileLeft": 0.7}),
        ("perfect-sync", smile, {"MouthSmileLeft": 0.7}),
    ):
        found = values(VmcEncoder(face("head"), names).encode(shown, 0.0))
        assert {name: value for name, value in found.items() if value > 0.02} == pytest.approx(wanted, abs=0.03)


def test_vrm_0_has_the_names_of_its_specification():
    presets = {"Neutral", "A", "I", "U", "E", "O", "Blink", "Joy", "Angry", "Sorrow", "Fun", "LookUp", "LookDown"}
    presets |= {"LookLeft", "LookRight", "Blink_L", "Blink_R"}
    assert presets < set(values(VmcEncoder(face("head")).encode(face("head").neutral, 0.0)))


def test_unknown_sets_of_names_are_refused():
    with pytest.raises(UnknownNameError, match="vrm0"):
        VmcEncoder(face("head"), "vrm")


@pytest.mark.parametrize("names", NAMES)
@pytest.mark.parametrize("subject", FACES)
def test_bones_carry_head_and_eyes_there_and_back(subject, names):
    channels = {"head_turn": 20, "head_nod": -10, "head_tilt": 6, "eye_turn": -12, "eye_nod": 7}
    if subject == "toon:gus":
        del channels["head_tilt"]
    pose = pose_from("channels", channels, face(subject))
    again = received(subject, VmcEncoder(face(subject), names).encode(pose, 0.0))
    assert differences(pose, again).max() < 0.01


def test_a_head_that_looks_to_its_left_turns_bones_by_negative_angles_about_y():
    pose = pose_from("channels", {"head_turn": 20, "eye_turn": 10}, face("head"))
    told = calls(VmcEncoder(face("head")).encode(pose, 0.0))
    bones = {arguments[0]: arguments[4:] for address, arguments in told if address == BONE}
    for bone, angle in (("Neck", 10), ("Head", 10), ("LeftEye", 10), ("RightEye", 10)):
        assert bones[bone] == pytest.approx((0, -np.sin(np.radians(angle / 2)), 0, np.cos(np.radians(angle / 2))))
    assert to_angles(compose([bones["Neck"], bones["Head"]])) == pytest.approx((20, 0, 0), abs=1e-4)


@given(st.dictionaries(st.sampled_from(["MLV", "MRV", "MB", "ELU", "ERU", "HH", "HV", "PLH"]), st.floats(0, 1)))
def test_motors_of_a_drawing_go_there_and_back_by_arkit(motors):
    """Eyes and head are said exactly, corners of the mouth nearly; what keeps a smile from being wide in ARKit parts
    the lips, and nothing shuts lips that are apart at rest.
    """
    pose = set_values(motors, face("toon:gus"), face("toon:gus").neutral)
    again = received("toon:gus", VmcEncoder(face("toon:gus"), "arkit").encode(pose, 0.0))
    limits = {"mouth.bottom": 0.45, "mouth.corner": 0.08, "eyelid.upper": 0.006}
    for row, difference in zip(pose.table, differences(pose, again), strict=True):
        assert difference <= limits.get(".".join(row.name.split(".")[:2]), 1e-6), row.name


def test_a_talking_face_is_nearly_the_same_on_the_other_side():
    """By the 52 names of ARKit: what the head does while it speaks and smiles, in every loop."""
    session = Session(face("head"), 1 / 30, seed=2)
    phones = [[0.0, 0.1, "HH"], [0.1, 0.2, "AH0"], [0.2, 0.3, "L"], [0.3, 0.6, "OW1"], [0.6, 0.8, "M"]]
    session.handle({"kind": "say", "text": "hello", "phones": phones})
    session.handle({"kind": "play", "motion": "smile"})
    encoder, reach = VmcEncoder(face("head"), "arkit"), None
    worst = []
    for _ in range(40):
        pose = session.step().pose
        again = received("head", encoder.encode(pose, 0.0))
        reach = encoder._inverse._effects.any(axis=0)
        worst.append(differences(pose, again)[reach].max())
    assert max(worst) < 0.05


def test_packets_are_bundled_by_size_and_keep_their_order():
    packets = [encode_call("/a/b/c", float(number)) for number in range(9)]  # 16 bytes each, 20 in a bundle
    bundles = list(encode_bundles(packets, 60))
    assert [len(bundle) for bundle in bundles] == [56, 56, 56, 56, 36]
    assert [arguments for _, arguments in calls(bundles)] == [(float(number),) for number in range(9)]
    assert bundles[-1] == b"#bundle\0" + struct.pack(">Qi", 1, 16) + packets[-1]
    assert [len(bundle) for bundle in encode_bundles([bytes(80), bytes(4)], 60)] == [100, 24]
    assert list(encode_bundles([], 60)) == []
