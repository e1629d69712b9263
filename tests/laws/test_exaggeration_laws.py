"""What holds for exaggeration on every face, from its table: identity, limits, order, closures."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import Pose, caricature, exaggerate
from mien.vocab import families, load_remap
from support import FACE_NAMES, face, poses

TABLES = {name: face(name).parameters for name in FACE_NAMES}
PLAYED = [name for name in FACE_NAMES if face(name).family in families("channels")]
CLOSING = ("closure", "tuck", "blink.left", "blink.right")

amounts = st.floats(0.0, 3.0)
scales = st.sampled_from([exaggerate, caricature])
every_table = pytest.mark.parametrize("table", TABLES.values(), ids=TABLES)
few = settings(max_examples=8, deadline=None)


@every_table
@few
@given(data=st.data())
def test_one_is_the_pose_to_the_bit(table, data):
    pose = data.draw(poses(table))
    assert data.draw(scales)(pose, 1.0).values.tobytes() == pose.values.tobytes()


@every_table
@few
@given(data=st.data(), amount=amounts)
def test_the_range_is_kept_and_neutral_stays(table, data, amount):
    louder = exaggerate(data.draw(poses(table)), amount)
    assert louder == louder.clamped()
    assert exaggerate(Pose.neutral(table), amount) == Pose.neutral(table)
    person = caricature(data.draw(poses(table)), amount)
    assert person == person.clamped()


@every_table
@few
@given(data=st.data(), amount=amounts)
def test_values_keep_their_order(table, data, amount):
    scale = data.draw(scales)
    one, other = (data.draw(poses(table)) for _ in range(2))
    before = np.sign(one.values - other.values)
    gap = scale(one, amount).values - scale(other, amount).values
    assert np.all(before * gap >= -1e-9 * (table.highs - table.lows))


@every_table
def test_twice_of_nearly_everything_is_not_clipped_flat(table):
    motion = np.array([row.role == "motion" for row in table])
    for end in (table.lows, table.highs):
        room = np.abs(end - table.defaults)
        nine, most = (exaggerate(Pose(table, table.defaults + s * (end - table.defaults)), 2.0) for s in (0.9, 0.99))
        step = np.abs(most.values - nine.values)
        assert np.all(step[motion] >= 0.004 * room[motion])
        assert np.all(np.abs(most.values - table.defaults)[motion] <= room[motion])


@every_table
@few
@given(data=st.data(), first=st.floats(1.0, 1.7), second=st.floats(1.0, 1.7))
def test_one_amount_after_another_is_their_product(table, data, first, second):
    pose = data.draw(poses(table))
    twice = exaggerate(exaggerate(pose, first), second)
    np.testing.assert_allclose(twice.values, exaggerate(pose, first * second).values, rtol=1e-9, atol=1e-9)


@every_table
@few
@given(data=st.data(), amount=amounts)
def test_a_mirrored_pose_is_exaggerated_in_the_mirror(table, data, amount):
    pose = data.draw(poses(table))
    lopsided = [r.default != table[r.mirror].default * (-1.0) ** r.odd or r.role == "scene" for r in table]
    mine, theirs = exaggerate(pose, amount).mirrored().values, exaggerate(pose.mirrored(), amount).values
    np.testing.assert_allclose(np.where(lopsided, 0.0, mine), np.where(lopsided, 0.0, theirs), atol=1e-12)


@pytest.mark.parametrize("name", PLAYED)
@pytest.mark.parametrize("amount", [0.0, 0.5, 2.0, 3.0])
def test_what_speech_and_blinks_shut_stays_shut(name, amount):
    """A full closing channel on top of any expression: what it brings to 0 is 0 at every amount."""
    subject = face(name)
    table = subject.parameters
    remap = load_remap("channels", subject.family).on(table)
    for preset in subject.presets.values():
        if preset.kind != "expression":
            continue
        for channel in (channel for channel in CLOSING if channel in remap.index):
            pose = Pose.neutral(table).replace(preset.values)
            factors = remap.scale({channel: 1.0})
            shut = {row: pose[row] * factor for row, factor in factors.items() if row in table}
            louder = exaggerate(pose.replace(shut), amount)
            for row, factor in factors.items():
                if row in table and factor == 0.0:
                    assert louder[row] == 0.0, (preset.name, row)


@pytest.mark.parametrize("name", PLAYED)
def test_the_table_knows_every_closure_of_the_channels(name):
    """A row that a channel multiplies by 0 has rest there, or its table says that it is closed there."""
    subject = face(name)
    table = subject.parameters
    remap = load_remap("channels", subject.family).on(table)
    for channel in remap.from_names:
        for row, factor in remap.scale({channel: 1.0}).items():
            if factor == 0.0 and row in table and table[row].default != 0.0:
                assert table[row].closed == 0.0, (channel, row)


@pytest.mark.parametrize("name", PLAYED)
def test_what_the_channels_turn_the_eyes_with_is_gaze(name):
    subject = face(name)
    table = subject.parameters
    remap = load_remap("channels", subject.family).on(table)
    aims = [row for row in remap.reached_by(c for c in ("eye_turn", "eye_nod") if c in remap.index) if row in table]
    if not aims:
        pytest.skip("its eyes are part of its skin")
    assert {table[row].role for row in aims} == {"gaze"}
