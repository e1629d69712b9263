"""Action units: how they are written, what they do to the head, what happens where they fight."""

import numpy as np
import pytest

from mien.core import MienError, UnknownNameError
from mien.vocab import load_remap, load_rules, pose_from, settle, vocabulary
from mien.vocab.facs import INTENSITIES, parse_units
from mien.vocab.fields import displacement, longest
from mien.vocab.rules import Rule
from support import face

UNITS = load_remap("facs", "head").from_names
PROMISED = {1, 2, *range(4, 8), *range(9, 21), *range(22, 31), *range(32, 36), 38, 39, *range(41, 47), *range(51, 59)}


def units(text: str):
    return pose_from("facs", parse_units(text), face("head"))


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("12=0.8,6=0.5", {"AU12": 0.8, "AU6": 0.5}),
        ("1+2+5B+26", {"AU1": 1.0, "AU2": 1.0, "AU5": 0.4, "AU26": 1.0}),
        ("L14C, 4D", {"AU14L": 0.6, "AU4": 0.8}),
        ("AU12R=.25", {"AU12R": 0.25}),
        ("30L", {"AU30L": 1.0}),
    ],
)
def test_units_are_read_as_coders_write_them(text: str, values: dict[str, float]) -> None:
    assert parse_units(text) == values


@pytest.mark.parametrize("text", ["", "12F", "12=x", "L12R", "12D=0.5", "12==1", "twelve", "1,,2", "12=0.5=1"])
def test_what_is_no_unit_is_refused_with_an_example(text: str) -> None:
    with pytest.raises(MienError, match=r"12=0\.8"):
        parse_units(text)


@pytest.mark.parametrize("text", ["3", "99", "17L", "30"])
def test_unknown_units_and_sides_are_refused(text: str) -> None:
    with pytest.raises(UnknownNameError, match="AU"):
        parse_units(text)


def test_letters_are_fifths() -> None:
    assert [*INTENSITIES.values()] == pytest.approx([k / 5 for k in range(1, 6)])


def test_the_promised_units_are_listed() -> None:
    numbers = {int(name.removeprefix("AU").split(".")[0].rstrip("LR")) for name in vocabulary("facs").names}
    assert PROMISED | set(range(61, 67)) <= numbers


@pytest.mark.parametrize("name", UNITS)
def test_every_unit_is_seen_on_the_head(name: str) -> None:
    assert longest(displacement("facs", name, face("head"))) >= 0.5


def test_sides_are_the_own_ones() -> None:
    assert units("12L").changed() == {"mouth.expression.left": 0.0}
    assert units("61").changed() == {"eye.turn.left": 30.0, "eye.turn.right": 30.0}
    looking_left = displacement("facs", "AU61", face("head"))
    # The own left is +x: the front of the eyes goes there.
    assert looking_left[np.abs(looking_left).sum(axis=1).argmax(), 0] > 0.004
    turned_left = displacement("facs", "AU51", face("head"))
    assert turned_left[face("head").shape(face("head").neutral).points[:, 2].argmax(), 0] > 0.05


def test_a_smile_and_its_opposite_meet_half_way() -> None:
    assert units("12=1,15=1").changed() == {
        name: 0.5 for side in ("left", "right") for name in (f"mouth.expression.{side}", f"mouth.frown.{side}")
    }
    # The stronger one keeps its sense, and one side does not know of the other.
    pose = units("12=1,L15=0.2")
    assert pose["mouth.expression.left"] == pytest.approx(0.1)
    assert pose["mouth.expression.right"] == 0.0
    assert pose["mouth.frown.left"] == pytest.approx(0.1)


def test_real_combinations_are_left_alone() -> None:
    assert units("1+2+4").changed() == {**units("1").changed(), **units("2").changed(), **units("4").changed()}


def test_shut_eyes_stay_shut_however_wide_they_would_be() -> None:
    assert units("5+43")["eyelid.opening.left"] == 0.0
    assert units("5+41")["eyelid.opening.left"] == pytest.approx(0.6)


@pytest.mark.parametrize(("text", "without"), [("24+25", "24"), ("24+19", "19"), ("19+28", "19"), ("24+27", "27")])
def test_lips_do_one_thing_at_a_time(text: str, without: str) -> None:
    assert units(text) == units(without)


def test_opposite_turns_cancel() -> None:
    assert units("61+62=0.5")["eye.turn.left"] == 15.0
    assert units("51=0.4+52=0.4") == face("head").neutral


def test_a_wide_jaw_takes_a_dropped_one_along_and_stays_in_range() -> None:
    assert units("26")["jaw.rotation"] == 9.0
    assert 9.0 < units("26+27=0.5")["jaw.rotation"] < 19.0
    assert units("25+26+27")["jaw.rotation"] == 20.0


def test_rules_look_at_values_as_given() -> None:
    rules = [Rule("a", "gives way to", "b", 0.5, ""), Rule("b", "gives way to", "a", 1.0, "")]
    assert settle({"a": 0.8, "b": 0.5}, rules) == settle({"a": 0.8, "b": 0.5}, rules[::-1])
    assert settle({"a": 0.8, "b": 0.5}, rules) == pytest.approx({"a": 0.6, "b": 0.1})
    assert settle({"a": 0.8}, rules) == {"a": 0.8}
    assert settle({"a": 0.8}, [Rule("a", "is part of", "b", 1.0, "")]) == {"a": 0.0}


def test_every_rule_says_why() -> None:
    assert all(len(rule.source) > 10 for rule in load_rules("facs"))
