"""Tables of parameters: names, sides, aliases, errors' texts, fingerprints."""

import math

import numpy as np
import pytest

from mien.core import MienError, Parameter, ParameterTable, RangeError, UnknownNameError, both_sides, color


def table_of(*rows, **aliases):
    return ParameterTable(tuple(rows), aliases)


@pytest.fixture
def table():
    return table_of(
        Parameter("jaw.rotation", 0, 20, unit="deg", group="jaw"),
        *both_sides(Parameter("eyelid.opening", 0, 1, 0.7, group="eyes", doc="Opening of the {side} lid.")),
        Parameter("head.turn", -90, 90, unit="deg", group="head", odd=True),
        ELU="eyelid.opening.left",
    )


def test_a_row_outside_its_own_range_is_refused():
    with pytest.raises(RangeError, match=r"^jaw.rotation: default 21 is not in 0\.\.20$"):
        Parameter("jaw.rotation", 0, 20, 21)


def test_the_twin_of_a_side_is_the_other_side():
    left, right = both_sides(Parameter("eyelid.opening", 0, 1))
    middle = Parameter("jaw.rotation", 0, 20)
    assert (left.mirror, right.mirror, middle.mirror) == ("eyelid.opening.right", "eyelid.opening.left", "jaw.rotation")


def test_both_sides_name_their_side_in_the_doc(table):
    assert table["eyelid.opening.left"].doc == "Opening of the left lid."
    assert table["eyelid.opening.right"].doc == "Opening of the right lid."


def test_a_colour_is_three_rows_of_linear_light():
    rows = color("iris.color", (0.1, 0.2, 0.3), doc="Iris", group="eyes")
    assert [(row.name, row.default, row.group) for row in rows] == [
        ("iris.color.red", 0.1, "eyes"),
        ("iris.color.green", 0.2, "eyes"),
        ("iris.color.blue", 0.3, "eyes"),
    ]
    assert rows[0].doc == "Iris (red, linear light)"


@pytest.mark.parametrize("value", [0, 20, 7.5, np.float32(3)])
def test_a_value_in_range_comes_back_as_a_float(table, value):
    checked = table["jaw.rotation"].check(value)
    assert type(checked) is float
    assert checked == value


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (25, "jaw.rotation: 25 is out of range — it goes from 0 to 20 deg"),
        (-0.5, "jaw.rotation: -0.5 is out of range — it goes from 0 to 20 deg"),
        (math.nan, "jaw.rotation: nan is not a finite number — it goes from 0 to 20 deg"),
        (math.inf, "jaw.rotation: inf is not a finite number — it goes from 0 to 20 deg"),
    ],
)
def test_a_refused_value_names_row_value_range_and_unit(table, value, text):
    with pytest.raises(RangeError) as caught:
        table["jaw.rotation"].check(value)
    assert str(caught.value) == text


def test_an_unknown_name_gets_near_matches(table):
    with pytest.raises(UnknownNameError) as caught:
        table["jaw.rotatoin"]
    assert str(caught.value) == "unknown parameter 'jaw.rotatoin' — did you mean 'jaw.rotation'?"


def test_near_matches_include_symmetric_names_and_aliases(table):
    with pytest.raises(UnknownNameError, match=r"'eyelid\.opening'"):
        table.resolve("eyelid.openin")
    with pytest.raises(UnknownNameError, match="'ELU'"):
        table.resolve("elu2")


def test_a_name_near_nothing_gets_the_list(table):
    with pytest.raises(UnknownNameError, match=r"there is jaw\.rotation, eyelid\.opening\.left"):
        table["zzzz"]


def test_a_symmetric_name_stands_for_two_rows_but_is_no_row(table):
    assert table.resolve("eyelid.opening") == ("eyelid.opening.left", "eyelid.opening.right")
    assert "eyelid.opening" in table
    with pytest.raises(UnknownNameError, match=r"eyelid\.opening\.left"):
        table["eyelid.opening"]


def test_an_alias_answers_wherever_its_row_does(table):
    assert table["ELU"] is table["eyelid.opening.left"]
    assert table.resolve("ELU") == ("eyelid.opening.left",)
    assert "ELU" in table
    assert "ELU" not in table.names


def test_a_table_refuses_a_name_twice():
    with pytest.raises(MienError, match=r"'jaw\.rotation' is in the table twice"):
        table_of(Parameter("jaw.rotation", 0, 20), Parameter("jaw.rotation", 0, 1))


def test_a_table_refuses_a_side_without_its_twin():
    with pytest.raises(MienError, match=r"'cheek.puff.left' has no twin 'cheek.puff.right'"):
        table_of(Parameter("cheek.puff.left", 0, 1))


def test_a_table_refuses_an_alias_of_nothing():
    with pytest.raises(UnknownNameError, match=r"parameter behind alias 'JR' 'jaw\.rotate'.*'jaw\.rotation'"):
        table_of(Parameter("jaw.rotation", 0, 20), JR="jaw.rotate")


def test_arrays_follow_the_order_of_the_rows(table):
    assert table.names == ("jaw.rotation", "eyelid.opening.left", "eyelid.opening.right", "head.turn")
    assert table.defaults.tolist() == [0, 0.7, 0.7, 0]
    assert table.lows.tolist() == [0, 0, 0, -90]
    assert table.highs.tolist() == [20, 1, 1, 90]
    assert table.mirror_index.tolist() == [0, 2, 1, 3]
    assert table.mirror_sign.tolist() == [1, 1, 1, -1]
    assert len(table) == 4
    assert [row.name for row in table] == list(table.names)


def test_arrays_cannot_be_written(table):
    for array in (table.defaults, table.lows, table.highs, table.mirror_sign):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


def test_groups_keep_the_order_of_the_rows(table):
    assert {group: [row.name for row in rows] for group, rows in table.groups().items()} == {
        "jaw": ["jaw.rotation"],
        "eyes": ["eyelid.opening.left", "eyelid.opening.right"],
        "head": ["head.turn"],
    }


def test_the_fingerprint_is_the_same_for_the_same_rows():
    first, second = (table_of(Parameter("jaw.rotation", 0, 20, unit="deg")) for _ in range(2))
    assert first.fingerprint == second.fingerprint
    assert len(first.fingerprint) == 12


@pytest.mark.parametrize(
    "other",
    [
        Parameter("jaw.rotate", 0, 20, unit="deg"),
        Parameter("jaw.rotation", -1, 20, unit="deg"),
        Parameter("jaw.rotation", 0, 21, unit="deg"),
        Parameter("jaw.rotation", 0, 20, 1, unit="deg"),
        Parameter("jaw.rotation", 0, 20, unit="rad"),
        Parameter("jaw.rotation", 0, 20, unit="deg", odd=True),
    ],
)
def test_the_fingerprint_changes_with_what_a_saved_file_depends_on(other):
    assert table_of(Parameter("jaw.rotation", 0, 20, unit="deg")).fingerprint != table_of(other).fingerprint


def test_the_fingerprint_does_not_depend_on_wording():
    plain = table_of(Parameter("jaw.rotation", 0, 20))
    worded = table_of(Parameter("jaw.rotation", 0, 20, doc="Opens the mouth.", source="Parke 1974", group="jaw"))
    assert plain.fingerprint == worded.fingerprint
