"""What holds for every pose of every parameter table: toy tables and the tables of all installed faces."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import Parameter, ParameterTable, Pose, RangeError, UnknownNameError, both_sides, color
from support import FACE_NAMES, face, poses

TOYS = {
    "empty": ParameterTable(()),
    "one row": ParameterTable((Parameter("jaw.rotation", 0, 20, 0, "deg"),)),
    "no room": ParameterTable((Parameter("stuck", 0.1, 0.1, 0.1),)),
    "sides, odd and colours": ParameterTable(
        (
            Parameter("jaw.rotation", 0, 20, 0, "deg"),
            *both_sides(Parameter("eyelid.opening", 0, 1, 0.7)),
            *both_sides(Parameter("eye.turn", -40, 40, 0, unit="deg", odd=True)),
            Parameter("head.turn", -60, 60, 0, "deg", odd=True),
            *color("skin.color", (0.5, 0.3, 0.2)),
        ),
        {"ELU": "eyelid.opening.left"},
    ),
}
TABLES = {**TOYS, **{name: face(name).parameters for name in FACE_NAMES}}
ROOM = {"light", "viewer", "target"}
"""Places that need not be in the middle: the light comes from one side."""

every_table = pytest.mark.parametrize("table", TABLES.values(), ids=TABLES)
few = settings(max_examples=6)


@every_table
@few
@given(data=st.data())
def test_mirroring_twice_changes_nothing(table, data):
    pose = data.draw(poses(table))
    np.testing.assert_array_equal(pose.mirrored().mirrored().values, pose.values)


@every_table
@few
@given(data=st.data())
def test_a_mirrored_pose_stays_in_range(table, data):
    mirrored = data.draw(poses(table)).mirrored()
    assert mirrored == mirrored.clamped()


@every_table
def test_neutral_is_default_and_its_own_mirror_image_but_for_what_differs_among_people(table):
    neutral = Pose.neutral(table)
    assert [neutral[row.name] for row in table] == [row.default for row in table]
    assert neutral.changed() == {}
    lopsided = [name for name in Pose(table, neutral.mirrored().values).changed() if not table[name].spread]
    assert {name.rpartition(".")[0] for name in lopsided} <= ROOM


@every_table
def test_twins_share_range_unit_and_sense(table):
    for row in table:
        twin = table[row.mirror]
        assert twin.mirror == row.name
        assert (twin.odd, twin.unit) == (row.odd, row.unit), row.name
        sign = -1.0 if row.odd else 1.0
        assert sorted((sign * twin.low, sign * twin.high)) == [row.low, row.high], row.name


@every_table
@few
@given(data=st.data())
def test_clamping_is_idempotent_and_leaves_poses_in_range_alone(table, data):
    pose = data.draw(poses(table))
    assert pose.clamped() == pose
    wild = Pose(table, data.draw(st.floats(-100, 100)) * (1.0 + pose.values))
    clamped = wild.clamped()
    assert clamped.clamped() == clamped
    assert (table.lows <= clamped.values).all()
    assert (clamped.values <= table.highs).all()


@every_table
@few
@given(data=st.data())
def test_a_blend_starts_at_one_pose_and_ends_at_the_other(table, data):
    first, second = data.draw(poses(table)), data.draw(poses(table))
    assert first.blend(second, 0.0) == first
    assert first.blend(second, 1.0) == second


@every_table
@few
@given(data=st.data())
def test_a_blend_stays_between_its_poses(table, data):
    first, second = data.draw(poses(table)), data.draw(poses(table))
    between = first.blend(second, data.draw(st.floats(0, 1))).values
    slack = 1e-12 * np.maximum(1.0, np.abs(between))
    assert (between >= np.minimum(first.values, second.values) - slack).all()
    assert (between <= np.maximum(first.values, second.values) + slack).all()


@every_table
@few
@given(data=st.data())
def test_what_changed_makes_the_pose_again(table, data):
    pose = data.draw(poses(table))
    assert Pose.neutral(table).replace(pose.changed()) == pose


@every_table
def test_a_value_just_out_of_range_is_refused(table):
    neutral = Pose.neutral(table)
    for row in table:
        for value in (math.nextafter(row.high, math.inf), math.nextafter(row.low, -math.inf), math.nan, math.inf):
            with pytest.raises(RangeError, match=row.name.replace(".", r"\.")):
                neutral.replace({row.name: value})
        assert neutral.replace({row.name: row.low})[row.name] == row.low
        assert neutral.replace({row.name: row.high})[row.name] == row.high


@every_table
def test_a_misspelt_name_is_refused_and_the_right_one_offered(table):
    for row in table.rows[::7]:
        name = row.name + "x"
        with pytest.raises(UnknownNameError) as caught:
            Pose.neutral(table).replace({name: row.default})
        assert repr(row.name.removesuffix(".left").removesuffix(".right"))[:-1] in str(caught.value)


@every_table
@few
@given(data=st.data())
def test_a_symmetric_name_makes_both_sides_equal(table, data):
    for name, (left, right) in table.symmetric.items():
        row = table[left]
        value = data.draw(st.floats(row.low, row.high))
        pose = Pose.neutral(table).replace({name: value})
        assert pose[left] == pose[right] == value


@every_table
def test_fingerprints_tell_tables_apart(table):
    same = [name for name, other in TABLES.items() if other.fingerprint == table.fingerprint]
    twins = {tuple((row.name, row.low, row.high, row.default) for row in TABLES[name]) for name in same}
    assert len(twins) == 1
