"""Motors in slices: Thórisson's own example, and what independence means."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.core import UnknownNameError
from mien.live import Motors, Way, count_slices

LOOP_S = 0.1


def test_an_eye_shuts_in_five_slices_of_a_fifth_of_the_way():
    lids = Motors([1.0])
    lids.move(0, Way(0.0, count_slices(0.5, LOOP_S)))
    assert lids.pending.tolist() == [5]
    seen = []
    while lids.moving:
        lids.step()
        seen.append(float(lids.values[0]))
    assert seen == pytest.approx([0.8, 0.6, 0.4, 0.2, 0.0])
    assert seen[-1] == 0.0


def test_both_eyes_shut_together_in_ten_slices():
    lids = Motors([1.0, 0.6])
    for lid in (0, 1):
        lids.move(lid, Way(0.0, count_slices(0.5, LOOP_S)))
    assert lids.pending.sum() == 10
    lids.step()
    assert lids.values.tolist() == pytest.approx([0.8, 0.48])
    assert lids.pending.tolist() == [4, 4]
    for _ in range(4):
        lids.step()
    assert lids.values.tolist() == [0.0, 0.0]
    assert not lids.moving


def test_a_new_command_takes_the_place_of_the_slices_of_its_motor_alone():
    motors = Motors([0.0, 0.0])
    motors.move(0, Way(1.0, 4), Way(5.0, 4))
    motors.move(1, Way(1.0, 4))
    motors.step()
    motors.move(0, Way(0.0, 1))
    motors.step()
    assert motors.values.tolist() == [0.0, 0.5]
    assert motors.pending.tolist() == [0, 2]


def test_change_functions_bend_the_way_and_keep_its_ends():
    motors = Motors([0.0, 0.0])
    motors.move(0, Way(1.0, 4, "cosine"))
    motors.move(1, Way(1.0, 4, "ease-in"))
    motors.step()
    assert motors.values.tolist() == pytest.approx([(1 - np.cos(np.pi / 4)) / 2, 1 - np.cos(np.pi / 8)])
    for _ in range(3):
        motors.step()
    assert motors.values.tolist() == [1.0, 1.0]


def test_ways_follow_one_another_and_waiting_is_one_of_them():
    motors = Motors([2.0])
    motors.move(0, Way(None, 2), Way(4.0, 2), Way(1.0, 1))
    assert motors.pending.tolist() == [5]
    seen = []
    for _ in range(6):
        motors.step()
        seen.append(float(motors.values[0]))
    assert seen == [2.0, 2.0, 3.0, 4.0, 1.0, 1.0]


def test_an_unknown_change_function_is_refused():
    with pytest.raises(UnknownNameError, match="did you mean 'cosine'"):
        Motors([0.0]).move(0, Way(1.0, 2, "cosin"))


@pytest.mark.parametrize(
    ("over_s", "loop_s", "slices"),
    [(0.5, 0.1, 5), (0.0, 0.1, 1), (0.11, 0.1, 2), (0.3, 0.1, 3), (0.5, 1 / 60, 30), (1 / 60, 1 / 60, 1)],
)
def test_durations_fill_whole_loops(over_s, loop_s, slices):
    assert count_slices(over_s, loop_s) == slices


@given(
    st.lists(
        st.tuples(st.integers(0, 2), st.floats(-1e6, 1e6), st.integers(1, 9), st.integers(0, 12)),
        min_size=1,
        max_size=12,
    )
)
def test_every_motor_ends_where_it_was_last_told_to(commands):
    motors = Motors([0.0, 0.0, 0.0])
    last = {0: 0.0, 1: 0.0, 2: 0.0}
    for motor, target, slices, steps in commands:
        motors.move(motor, Way(target, slices, "ease-out"))
        last[motor] = target
        for _ in range(steps):
            motors.step()
    for _ in range(9):
        motors.step()
    assert motors.values.tolist() == list(last.values())
    assert not motors.pending.any()
