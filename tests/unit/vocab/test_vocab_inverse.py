"""Values under names from poses: the way back of ``pose_from``."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.core import Pose
from mien.vocab import load_rules, pose_from, settle, vocabulary
from mien.vocab.inverse import PRICE, Inverse
from mien.vocab.loss import fits_on, nearest_shares
from mien.vocab.rules import Rule, companions, unsettle
from support import face

FACES = ("head", "toon:pip", "toon:gus")
NEAR = 0.025
"""What the price of a name takes off its value, at most, where it moves a fifth of a range and more."""

TOON_TWINS = {"mouthDimpleLeft": "mouthStretchLeft", "mouthDimpleRight": "mouthStretchRight"}
"""On drawings, what does the same as another name that does more of it."""


def far(inverse, pose, again):
    """The greatest difference of two poses in a parameter that the names move, as a share of its range."""
    spans = pose.table.highs - pose.table.lows
    return float(np.abs((pose.values - again.values) / spans)[inverse._effects.any(axis=0)].max())


@pytest.mark.parametrize("name", ["arkit", "vrm"])
@pytest.mark.parametrize("subject", FACES)
def test_nothing_is_found_in_a_face_at_rest(subject, name):
    found = Inverse(name, face(subject)).find(face(subject).neutral)
    assert found == dict.fromkeys(vocabulary(name).names, 0.0)


def test_each_name_of_arkit_is_found_again_on_the_head():
    subject, inverse = face("head"), Inverse("arkit", face("head"))
    for name, fit in fits_on("arkit", subject).items():
        assert fit != "stand-in"
        given = {**dict.fromkeys(companions("arkit", name), 0.9), name: 0.7}
        found = {each: value for each, value in inverse.find(pose_from("arkit", given, subject)).items() if value}
        assert found == pytest.approx(given, abs=NEAR), name


@pytest.mark.parametrize("subject", ["toon:pip", "toon:gus"])
@pytest.mark.parametrize("name", ["jawOpen", "mouthSmileLeft", "eyeBlinkRight", "browInnerUp", "mouthPucker"])
def test_what_a_drawing_shows_by_one_name_is_found_again(subject, name):
    found = Inverse("arkit", face(subject)).find(pose_from("arkit", {name: 0.7}, face(subject)))
    assert {each: value for each, value in found.items() if value > NEAR} == pytest.approx({name: 0.7}, abs=NEAR)


@pytest.mark.parametrize("subject", FACES)
@pytest.mark.parametrize("given", [{"happy": 0.7}, {"sad": 0.5, "blinkLeft": 1.0}, {"aa": 0.6}, {"ou": 0.8}])
def test_expressions_of_vrm_are_found_again(subject, given):
    inverse = Inverse("vrm", face(subject), ["blink"])
    found = inverse.find(pose_from("vrm", given, face(subject)))
    assert {each: value for each, value in found.items() if value > NEAR} == pytest.approx(given, abs=2 * NEAR)


@pytest.mark.parametrize("subject", ["toon:pip", "toon:gus"])
def test_what_a_drawing_only_stands_in_for_is_left_out(subject):
    fits = fits_on("arkit", face(subject))
    found = Inverse("arkit", face(subject)).find(pose_from("arkit", {"cheekPuff": 1.0, "jawLeft": 1.0}, face(subject)))
    assert fits["cheekPuff"] == "stand-in"
    assert all(found[name] == 0.0 for name, fit in fits.items() if fit == "stand-in")


def test_names_that_do_the_same_go_together_and_of_different_sizes_the_greater_goes():
    subject = face("toon:gus")
    inverse = Inverse("arkit", subject)
    found = inverse.find(pose_from("arkit", {"mouthLowerDownLeft": 1.0}, subject))
    assert found["mouthLowerDownLeft"] == found["mouthLowerDownRight"]
    for small, great in TOON_TWINS.items():
        found = inverse.find(pose_from("arkit", {small: 1.0}, subject))
        assert found[great] > 0.3
        assert found[small] == 0.0


@pytest.mark.parametrize("subject", ["head", "toon:pip"])
@given(data=st.data())
def test_some_names_of_arkit_at_once_make_nearly_the_same_pose_again(subject, data):
    """The head's parameters are nearly one a name; a drawing's are shared by many, and ways to their ends bend."""
    names = [name for name, fit in fits_on("arkit", face(subject)).items() if fit != "stand-in"]
    given = data.draw(st.dictionaries(st.sampled_from(names), st.floats(0.05, 0.6), max_size=4))
    inverse = Inverse("arkit", face(subject))
    pose = pose_from("arkit", given, face(subject))
    again = pose_from("arkit", inverse.find(pose), face(subject))
    assert far(inverse, pose, again) < (0.006 if subject == "head" else 0.2)


@pytest.mark.parametrize("name", ["arkit", "vrm"])
@pytest.mark.parametrize("subject", FACES)
def test_no_pose_gives_values_out_of_range(subject, name):
    inverse, table, chance = Inverse(name, face(subject)), face(subject).parameters, np.random.default_rng(3)
    for _ in range(20):
        pose = Pose(table, chance.uniform(table.lows, table.highs))
        assert all(0.0 <= value <= 1.0 for value in inverse.find(pose).values())


def test_it_finds_the_same_wherever_it_began():
    subject = face("head")
    pose = pose_from("arkit", {"jawOpen": 0.5, "mouthSmileLeft": 0.8, "mouthStretchLeft": 0.3}, subject)
    fresh, used = Inverse("arkit", subject), Inverse("arkit", subject)
    used.find(pose_from("arkit", {"mouthFrownLeft": 1.0, "mouthDimpleLeft": 1.0}, subject))
    assert used.find(pose) == pytest.approx(fresh.find(pose), abs=0.01)


def test_the_price_of_a_name_by_hand():
    """One that moves a parameter all of its range loses the price; one that moves half of it loses twice as much."""
    square = np.diag([1.0, 0.25])
    products = np.array([0.7, 0.25 * 0.7]) - PRICE * np.array([1.0, 0.5])
    np.testing.assert_allclose(nearest_shares(square, products), [0.7 - PRICE, 0.7 - 2 * PRICE])


def test_shares_are_the_same_from_any_start_and_stop_when_they_stand_still():
    square, products = np.array([[2.0, 1.0], [1.0, 2.0]]), np.array([1.2, 0.9])
    want = [0.5, 0.2]  # by hand: 2 * 0.5 + 0.2 = 1.2 and 0.5 + 2 * 0.2 = 0.9
    for start in ([0.0, 0.0], [1.0, 1.0], [0.5, 0.2]):
        np.testing.assert_allclose(nearest_shares(square, products, np.array(start), 1e-9), want, atol=1e-8)
    rough = nearest_shares(square, products, np.array([0.0, 0.0]), 1.0)
    np.testing.assert_allclose(rough, [0.6, 0.15])


@given(st.fixed_dictionaries({"jawOpen": st.floats(0.2, 1), "mouthSmileLeft": st.floats(0, 1)}), st.floats(0, 0.2))
def test_rules_are_undone(given, small):
    values = {**given, "mouthClose": small, "cheekSquintLeft": small, "mouthDimpleLeft": small, "tongueOut": small}
    rules = load_rules("arkit")
    assert unsettle(settle(values, rules), rules) == pytest.approx(values)


def test_rules_are_undone_by_hand():
    half = (Rule("a", "is part of", "b", 0.5, ""),)
    assert settle({"a": 0.2, "b": 0.4}, half) == pytest.approx({"a": 0.35, "b": 0.4})
    assert unsettle({"a": 0.35, "b": 0.4}, half) == pytest.approx({"a": 0.2, "b": 0.4})
    whole = (Rule("a", "gives way to", "b", 1.0, ""),)
    assert unsettle({"a": 0.0, "b": 1.0}, whole) == {"a": 0.0, "b": 1.0}
    assert unsettle({"a": 0.5}, (Rule("a", "is part of", "b", 1.0, ""),)) == {"a": 0.0}
