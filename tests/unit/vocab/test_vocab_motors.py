"""The 21 motors of ToonFace: on drawn faces their own rows, on the head what comes nearest."""

import numpy as np
import pytest

import mien
from mien.core import Face, Mesh, Pose, RangeError, UnknownNameError
from mien.faces.head.measured import archive
from mien.vocab import pose_from, set_values, vocabulary
from support import FACE_NAMES, face

MOTORS = vocabulary("toonface")
TOONS = [name for name in FACE_NAMES if face(name).family == "toon"]
TURN_DEG = 12.0

SIGHTED = {"pupil": "eye", "eyebrow": "brow", "eyelid": "lash"}


def played(code: str, value: float, name: str = "head") -> Pose:
    return pose_from("toonface", {code: value}, face(name))


def test_there_are_twenty_one_by_code_and_by_point() -> None:
    assert len(MOTORS) == 21
    assert MOTORS["15-0"].name == MOTORS["15-H"].name == "PLH"
    assert MOTORS["1-1"].name == "BRM"
    assert MOTORS["17-V"].name == "HV"


@pytest.mark.parametrize("name", TOONS)
@pytest.mark.parametrize("row", MOTORS, ids=MOTORS.names)
def test_on_a_drawn_face_they_are_what_set_does(row, name: str) -> None:
    subject = face(name)
    for value in (TURN_DEG / 3.0, -TURN_DEG) if row.unit == "deg" else (0.0, 0.3, 1.0):
        base = subject.neutral.replace({"BLM": 0.9, "PLH": 7.0, "MLV": 0.8})
        assert pose_from("toonface", {row.name: value}, subject, base) == base.replace({row.name: value})


def test_at_rest_the_head_is_at_rest() -> None:
    head = face("head")
    assert pose_from("toonface", {row.name: row.default for row in MOTORS}, head) == head.neutral


def test_they_take_over_from_what_lies_beneath() -> None:
    head = face("head")
    angry = head.neutral.replace(head.presets["angry"].values)
    calm = pose_from("toonface", {"BLM": MOTORS["BLM"].default, "ELU": 0.5}, head, angry)
    assert calm["eyebrow.lower.left"] == 0.0
    assert calm["eyelid.opening.left"] == 0.5
    assert calm["eyebrow.lower.right"] == angry["eyebrow.lower.right"]


def moved(code: str, value: float) -> np.ndarray:
    """(V, 3) mm that a motor moves the head's points."""
    head = face("head")
    before, after = head.shape(head.neutral), head.shape(played(code, value))
    assert isinstance(before, Mesh)
    return 1000.0 * (after.points - before.points)


def part_of(subject: Face, name: str) -> np.ndarray:
    return subject.shape(subject.neutral).part_vertices(name)


def brow_part(side: str, end: str) -> np.ndarray:
    """Vertices of an outer, middle or inner piece of an eyebrow."""
    vertices = part_of(face("head"), f"brow.{side}")
    out = np.abs(face("head").shape(face("head").neutral).points[vertices, 0])
    share = (out - out.min()) / (out.max() - out.min())
    low, high = {"medial": (-0.1, 0.2), "central": (0.4, 0.65), "lateral": (0.85, 1.1)}[end]
    return vertices[(share > low) & (share < high)]


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize(("letter", "end"), [("L", "lateral"), ("C", "central"), ("M", "medial")])
def test_the_heads_eyebrows_go_up_and_down_where_they_are_asked_to(letter: str, end: str, side: str) -> None:
    code = f"B{side[0].upper()}{letter}"
    others = [each for each in ("lateral", "central", "medial") if each != end]
    for value, sense in ((1.0, 1.0), (0.0, -1.0)):
        field = sense * moved(code, value)[:, 1]
        assert field[brow_part(side, end)].mean() > 2.0
        # The opposite end stays behind.
        far = "medial" if end == "lateral" else "lateral"
        assert field[brow_part(side, far)].mean() < field[brow_part(side, end)].mean() - 1.5, others


def test_the_heads_lids_shut_and_open() -> None:
    lashes = part_of(face("head"), "lash.left")
    assert moved("ELU", 0.0)[lashes, 1].min() < -5.0
    assert moved("ELU", 1.0)[lashes, 1].max() > 1.5
    assert played("ERU", 0.0)["eyelid.opening.right"] == 0.0
    assert moved("ERL", 1.0)[part_of(face("head"), "skin"), 1].max() > 1.0


@pytest.mark.parametrize(("code", "axis", "sign"), [("PLH", 0, -1), ("PRH", 0, -1), ("PLV", 1, 1), ("PRV", 1, 1)])
def test_the_heads_eyes_turn_as_one_sees_them(code: str, axis: int, sign: int) -> None:
    side = {"L": "left", "R": "right"}[code[1]]
    eye = part_of(face("head"), f"eye.{side}")
    front = eye[face("head").shape(face("head").neutral).points[eye, 2].argmax()]
    # The own left is +x: to the left as one sees it is -x.
    assert sign * moved(code, TURN_DEG)[front, axis] > 1.0
    assert sign * moved(code, -TURN_DEG)[front, axis] < -1.0


@pytest.mark.parametrize(("code", "axis", "sign"), [("HH", 0, -1), ("HV", 1, 1)])
def test_the_head_turns_as_one_sees_it(code: str, axis: int, sign: int) -> None:
    nose = face("head").shape(face("head").neutral).points[:, 2].argmax()
    assert sign * moved(code, TURN_DEG)[nose, axis] > 10.0
    assert sign * moved(code, -TURN_DEG)[nose, axis] < -10.0


def test_the_heads_mouth_goes_where_it_is_asked_to() -> None:
    corner = archive().vertex["m0_5"]
    for code, axis, away in (("MLH", 0, 1.0), ("MLV", 1, 1.0)):
        assert away * moved(code, 1.0)[corner, axis] > 2.0
        assert away * moved(code, 0.0)[corner, axis] < -2.0
    assert moved("MB", 1.0)[archive().vertex["m0_0"]].any() or moved("MB", 1.0)[:, 1].min() < -10.0


def test_codes_are_set_wherever_values_are() -> None:
    head, gus = face("head"), face("toon:gus")
    assert mien.make_pose(head, {"ELU": 0.0}) == played("ELU", 0.0)
    assert mien.make_pose(head, {"8-V": 0.0}) == played("ELU", 0.0)
    assert mien.make_pose(gus, {"ELU": 0.0}) == gus.neutral.replace({"eyelid.upper.left": 0.0})
    # A parameter's own name has the last word, wherever it stands.
    assert set_values({"eyelid.opening": 0.3, "ELU": 0.0}, head, head.neutral)["eyelid.opening.left"] == 0.3
    with pytest.raises(UnknownNameError, match="'ELX'"):
        mien.make_pose(head, {"ELX": 0.0})
    with pytest.raises(RangeError, match="ELU: 2 is out of range"):
        mien.make_pose(head, {"ELU": 2.0})
