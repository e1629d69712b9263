"""Poses: known answers on a table of four rows. Their laws are in tests/laws."""

import numpy as np
import pytest

from mien.core import MienError, Parameter, ParameterTable, Pose, RangeError, UnknownNameError, both_sides

TABLE = ParameterTable(
    (
        Parameter("jaw.rotation", 0, 20),
        *both_sides(Parameter("eyelid.opening", 0, 1, 0.7)),
        Parameter("head.turn", -90, 90, odd=True),
    ),
    {"ELU": "eyelid.opening.left"},
)
NEUTRAL = Pose.neutral(TABLE)


def test_a_symmetric_name_sets_both_sides():
    pose = NEUTRAL.replace({"eyelid.opening": 0.2})
    assert pose.values.tolist() == [0, 0.2, 0.2, 0]


def test_of_two_names_for_one_row_the_later_wins():
    assert NEUTRAL.replace({"eyelid.opening": 0.2, "ELU": 0.5}).values.tolist() == [0, 0.5, 0.2, 0]
    assert NEUTRAL.replace({"ELU": 0.5, "eyelid.opening": 0.2}).values.tolist() == [0, 0.2, 0.2, 0]


def test_replacing_leaves_the_first_pose_alone():
    NEUTRAL.replace({"jaw.rotation": 8})
    assert NEUTRAL["jaw.rotation"] == 0
    with pytest.raises(ValueError, match="read-only"):
        NEUTRAL.values[0] = 8


def test_a_pose_does_not_follow_the_array_it_was_made_from():
    values = TABLE.defaults.copy()
    pose = Pose(TABLE, values)
    values[0] = 5
    assert pose["jaw.rotation"] == 0


def test_a_value_is_read_by_name_or_alias():
    pose = NEUTRAL.replace({"eyelid.opening.left": 0.1})
    assert pose["eyelid.opening.left"] == pose["ELU"] == 0.1
    with pytest.raises(UnknownNameError):
        pose["eyelid"]


def test_one_refused_value_refuses_the_whole_change():
    with pytest.raises(RangeError, match=r"head\.turn: 91 is out of range"):
        NEUTRAL.replace({"jaw.rotation": 8, "head.turn": 91})
    with pytest.raises(UnknownNameError, match=r"'head\.turn'"):
        NEUTRAL.replace({"jaw.rotation": 8, "head.trun": 9})


def test_a_mirror_swaps_sides_and_turns_the_head_the_other_way():
    pose = NEUTRAL.replace({"jaw.rotation": 8, "eyelid.opening.left": 0.1, "head.turn": 30})
    assert pose.mirrored().values.tolist() == [8, 0.7, 0.1, -30]


def test_a_blend_goes_part_of_the_way():
    pose = NEUTRAL.blend(NEUTRAL.replace({"jaw.rotation": 8, "head.turn": -40}), 0.25)
    np.testing.assert_allclose(pose.values, [2, 0.7, 0.7, -10], rtol=1e-15)


def test_poses_of_two_tables_do_not_blend():
    other = Pose.neutral(ParameterTable(TABLE.rows))
    with pytest.raises(MienError, match="poses of different faces cannot be blended"):
        NEUTRAL.blend(other, 0.5)


def test_clamping_brings_every_value_into_its_range():
    pose = Pose(TABLE, np.array([-5.0, 2.0, 0.3, 1000.0]))
    assert pose.clamped().values.tolist() == [0, 1, 0.3, 90]


def test_changed_lists_what_differs_from_the_defaults():
    assert NEUTRAL.changed() == {}
    assert NEUTRAL.replace({"ELU": 0.1, "head.turn": 0}).changed() == {"eyelid.opening.left": 0.1}


def test_a_pose_of_the_wrong_length_is_refused():
    with pytest.raises(MienError, match=r"a pose of 4 parameters cannot hold values of shape \(3,\)"):
        Pose(TABLE, np.zeros(3))


def test_equal_poses_are_one_key():
    first, second = (NEUTRAL.replace({"jaw.rotation": 8}) for _ in range(2))
    assert first == second
    assert len({first, second, NEUTRAL}) == 2
    assert first != NEUTRAL
    assert first != "a pose"


def test_a_pose_shows_what_it_changes_and_not_its_whole_table():
    table = ParameterTable((Parameter("jaw.rotation", 0, 20), Parameter("mouth.width", 0.5, 1.5, 1)))
    neutral = Pose.neutral(table)
    assert repr(neutral) == "<Pose of 2 parameters: neutral>"
    assert repr(neutral.replace({"jaw.rotation": 8})) == "<Pose of 2 parameters: jaw.rotation=8>"


def test_a_text_is_no_value():
    table = ParameterTable((Parameter("jaw.rotation", 0, 20),))
    with pytest.raises(RangeError, match="is a text"):
        Pose.neutral(table).replace({"jaw.rotation": "8"})
