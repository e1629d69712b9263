"""Exaggeration at values worked out by hand."""

import numpy as np
import pytest

from mien.core import Parameter, ParameterTable, Pose, RangeError, caricature, color, exaggerate
from mien.core.exaggeration import stretch

TABLE = ParameterTable(
    (
        Parameter("smile", 0, 1),
        Parameter("brow", -10, 30, 0),
        Parameter("lid", 0, 1, 0.75, closed=0.0),
        Parameter("look", -40, 40, 0, role="gaze"),
        Parameter("seal", 0, 1, 0, role="contact"),
        Parameter("nose", 0, 1, 0.6, role="shape", usual=0.5),
        Parameter("target.x", -9, 9, 0, role="scene"),
        *color("skin", (0.5, 0.4, 0.3)),
    )
)


def pose(**values):
    return Pose.neutral(TABLE).replace({name.replace("_", "."): value for name, value in values.items()})


def test_half_the_way_at_twice_the_amount():
    # u' = 2 * 0.5 / (1 + 15 / 16) ** (1 / 4)
    assert exaggerate(pose(smile=0.5), 2.0)["smile"] == pytest.approx((16.0 / 31.0) ** 0.25)


def test_a_small_distance_is_multiplied():
    assert exaggerate(pose(brow=0.01), 3.0)["brow"] == pytest.approx(0.03, rel=1e-9)
    assert exaggerate(pose(brow=-0.01), 3.0)["brow"] == pytest.approx(-0.03, rel=1e-9)


def test_each_side_has_its_own_room():
    up, down = exaggerate(pose(brow=6.0), 2.0)["brow"], exaggerate(pose(brow=-6.0), 2.0)["brow"]
    assert 11.5 < up < 12.0  # a fifth of the way up has room
    assert -10.0 < down < -9.0  # three fifths of the way down come near to the end


def test_less_is_a_plain_share_of_the_distance():
    softer = exaggerate(pose(smile=1.0, brow=-6.0, lid=1.0), 0.5)
    assert (softer["smile"], softer["brow"], softer["lid"]) == (0.5, -3.0, 0.875)


@pytest.mark.parametrize("amount", [0.0, 0.3, 0.9, 1.7, 3.0])
def test_a_shut_lid_stays_shut_and_an_open_one_open(amount):
    assert exaggerate(pose(lid=0.0), amount)["lid"] == 0.0
    assert 0.0 < exaggerate(pose(lid=0.3), amount)["lid"] < 0.75 + (amount == 0.0)


@pytest.mark.parametrize("amount", [0.0, 0.5, 3.0])
def test_only_what_expresses_is_moved(amount):
    other = {"look": 20.0, "seal": 0.5, "nose": 0.9, "target.x": 2.0, "skin.red": 0.9}
    still = pose().replace(other)
    assert exaggerate(still, amount) == still


def test_a_person_is_measured_from_the_mean_of_people():
    # From the mean 0.5, not from the person's own 0.6: 0.7 is two fifths of the way to 1.
    louder = caricature(pose(nose=0.7, smile=0.4), 2.0)
    assert louder["nose"] == pytest.approx(0.5 + 0.5 * 0.8 / (1.0 + 15.0 * 0.4**4) ** 0.25)
    assert louder["smile"] == 0.4
    assert caricature(Pose.neutral(TABLE), 0.0)["nose"] == 0.5


def test_values_beyond_the_end_stay_where_they_are():
    np.testing.assert_array_equal(stretch(np.array([1.5, -0.2]), 2.0, rest=0.0, low=0.0, high=1.0), [1.5, -0.2])


@pytest.mark.parametrize("amount", [-0.1, 3.01, float("nan"), float("inf")])
def test_other_amounts_are_refused(amount):
    with pytest.raises(RangeError, match=r"exaggeration .* goes from 0 to 3"):
        exaggerate(pose(), amount)
    with pytest.raises(RangeError):
        caricature(pose(), amount)
