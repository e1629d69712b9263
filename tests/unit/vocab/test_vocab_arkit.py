"""ARKit's 52 blend shapes, and the way that a face takes values under other names."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import Parameter, Pose, RangeError, UnknownNameError
from mien.vocab import families, load_remap, pose_from, vocabularies, vocabulary
from mien.vocab.fields import angle_deg, displacement, longest
from mien.vocab.posing import combine
from support import face

ARKIT = vocabulary("arkit").names
SIDED = [
    name.removesuffix("Left")
    for name in ARKIT
    if name.endswith("Left") and name.removesuffix("Left") + "Right" in ARKIT
]


def test_there_are_52_names() -> None:
    assert len(ARKIT) == 52
    assert sum(name.startswith("mouth") for name in ARKIT) == 23
    assert sum(name.startswith("eye") for name in ARKIT) == 14
    assert len(set(load_remap("arkit", "head").from_names)) == 52


@pytest.mark.parametrize("name", ARKIT)
def test_every_name_is_seen(name: str) -> None:
    assert longest(displacement("arkit", name, face("head"))) >= 0.5


@pytest.mark.parametrize("stem", SIDED)
def test_left_is_right_in_the_mirror(stem: str) -> None:
    head = face("head")
    left, right = (pose_from("arkit", {stem + side: 0.7}, head) for side in ("Left", "Right"))
    assert left != head.neutral
    offset = left.mirrored().values - head.neutral.mirrored().values
    np.testing.assert_allclose(offset, right.values - head.neutral.values, rtol=0, atol=1e-15)


@pytest.mark.parametrize("alias", ["eyeBlink_L", "EyeBlinkLeft", "eyeBlinkLeft"])
def test_names_of_other_programs_are_read(alias: str) -> None:
    assert pose_from("arkit", {alias: 1.0}, face("head")).changed() == {"eyelid.opening.left": 0.0}


def test_looking_in_turns_each_eye_towards_the_nose() -> None:
    pose = pose_from("arkit", {"eyeLookInLeft": 1.0, "eyeLookInRight": 0.5}, face("head"))
    assert pose.changed() == {"eye.turn.left": -30.0, "eye.turn.right": 15.0}


def test_opposite_names_meet_in_the_middle() -> None:
    assert pose_from("arkit", {"jawLeft": 0.6, "jawRight": 0.6}, face("head")) == face("head").neutral


@pytest.mark.parametrize(
    ("jaw", "close", "closure"),
    [(0.5, 0.5, 1.0), (0.5, 0.25, 0.5), (1.0, 0.25, 0.25), (0.2, 0.6, 1.0), (0.0, 1.0, 0.0)],
)
def test_mouth_close_counts_as_a_part_of_the_open_jaw(jaw: float, close: float, closure: float) -> None:
    pose = pose_from("arkit", {"jawOpen": jaw, "mouthClose": close}, face("head"))
    assert pose["mouth.closure"] == pytest.approx(closure)


def test_a_smile_that_raises_the_cheek_leaves_less_to_the_cheek() -> None:
    pose = pose_from("arkit", {"mouthSmileLeft": 1.0, "cheekSquintLeft": 1.0, "cheekSquintRight": 1.0}, face("head"))
    assert pose["cheek.raise.left"] == pytest.approx(0.55)
    assert pose["cheek.raise.right"] == 1.0


def test_names_come_on_top_of_another_pose() -> None:
    head = face("head")
    base = head.neutral.replace({"eyebrow.lower": 0.5, "jaw.rotation": 4.0, "eyelid.opening": 0.6})
    pose = pose_from("arkit", {"browDownLeft": 0.5, "eyeBlinkLeft": 0.5}, head, base)
    # Half of the way that is left to the end; half of the opening that is left.
    assert pose["eyebrow.lower.left"] == 0.75
    assert pose["eyelid.opening.left"] == pytest.approx(0.3)
    assert (pose["eyebrow.lower.right"], pose["jaw.rotation"]) == (0.5, 4.0)


def test_what_is_not_a_name_or_not_a_share_is_refused() -> None:
    with pytest.raises(UnknownNameError, match="eyeBlinkLeft"):
        pose_from("arkit", {"eyeBlinkLef": 1.0}, face("head"))
    with pytest.raises(RangeError, match="jawOpen"):
        pose_from("arkit", {"jawOpen": 1.5}, face("head"))
    with pytest.raises(UnknownNameError, match="arkit"):
        pose_from("arkti", {"jawOpen": 1.0}, face("head"))


ROW = Parameter("x", -2.0, 8.0, 3.0)


@pytest.mark.parametrize(
    ("pushes", "value"),
    [
        ([], 3.0),
        ([(5.0, 0.5)], 5.5),
        ([(5.0, 0.5), (5.0, 0.5)], 6.75),  # the second takes half of the half that is left
        ([(2.0, 1.0), (5.0, 1.0)], 8.0),
        ([(100.0, 0.5)], 5.5),  # a full one goes to the end, half of it goes half as far
        ([(5.0, 0.5), (-5.0, 0.5)], 3.0),
        ([(1.0, 2.0)], 5.0),  # degrees, not shares
        ([(1.0, -2.0)], 1.0),
        ([(1.0, 20.0)], 8.0),
        ([(-5.0, 1.0), (-5.0, 1.0)], -2.0),
    ],
)
def test_pushes_are_combined(pushes: list[tuple[float, float]], value: float) -> None:
    assert combine(ROW, pushes) == value


@settings(deadline=None, max_examples=100)
@given(st.lists(st.tuples(st.floats(-20.0, 20.0), st.floats(0.0, 1.0)), max_size=6))
def test_combined_pushes_stay_in_range_in_any_order_and_more_is_more(pushes: list[tuple[float, float]]) -> None:
    value = combine(ROW, pushes)
    assert ROW.low <= value <= ROW.high
    assert combine(ROW, pushes[::-1]) == pytest.approx(value, abs=1e-12)
    steps = [combine(ROW, [*pushes, (5.0, amount)]) for amount in np.linspace(0.0, 1.0, 5)]
    assert all(a <= b + 1e-12 for a, b in pairwise(steps))


@pytest.mark.parametrize("name", [name for name in vocabularies() if "head" in families(name)])
def test_any_values_give_a_pose_in_range(name: str) -> None:
    table, head, random = vocabulary(name), face("head"), np.random.default_rng(4)
    for _ in range(50):
        values = {
            row.name: float(random.choice([row.low, row.high, random.uniform(row.low, row.high)])) for row in table
        }
        assert isinstance(pose_from(name, values, head), Pose)


def test_angle_between_fields() -> None:
    east, north = np.zeros((2, 3)), np.zeros((2, 3))
    east[0, 0], north[1, 1] = 0.002, 0.001
    assert angle_deg(east, north) == pytest.approx(90.0)
    assert angle_deg(east, 3.0 * east) == pytest.approx(0.0, abs=1e-5)
    assert angle_deg(east, east + 2.0 * north) == pytest.approx(45.0)
    assert angle_deg(east, 0.0 * east) == 90.0
    assert longest(east + north) == pytest.approx(2.0)
