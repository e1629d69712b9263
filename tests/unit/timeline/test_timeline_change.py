"""Parke's change functions at hand-computed values."""

import math

import numpy as np
import pytest

from mien.core import UnknownNameError
from mien.timeline.change import CHANGE_NAMES, CHANGES, change_code

HALF = math.sqrt(0.5)


@pytest.mark.parametrize(
    ("name", "quarter", "third", "half"),
    [
        ("linear", 0.25, 1 / 3, 0.5),
        ("cosine", (1 - HALF) / 2, 0.25, 0.5),  # (1 - cos 60 deg) / 2 = 1/4
        ("ease-in", 1 - math.sqrt(2 + math.sqrt(2)) / 2, 1 - math.sqrt(3) / 2, 1 - HALF),  # 1 - cos 22.5, 30, 45 deg
        ("ease-out", math.sqrt(2 - math.sqrt(2)) / 2, 0.5, HALF),  # sin 22.5, 30, 45 deg
    ],
)
def test_known_values(name, quarter, third, half):
    np.testing.assert_allclose(CHANGES[name]([0.25, 1 / 3, 0.5]), [quarter, third, half], rtol=0, atol=4e-16)


@pytest.mark.parametrize("name", CHANGE_NAMES)
def test_ends_are_exact_and_held_and_the_way_between_rises(name):
    assert CHANGES[name]([-3.0, 0.0, 1.0, 7.0]).tolist() == [0.0, 0.0, 1.0, 1.0]
    way = CHANGES[name](np.linspace(0, 1, 1001))
    assert np.all(np.diff(way) > 0)


def test_speed_at_the_ends_is_what_the_names_say():
    step = 1e-4
    start = {name: float(change(step)) / step for name, change in CHANGES.items()}
    end = {name: (1 - float(change(1 - step))) / step for name, change in CHANGES.items()}
    assert start["cosine"] < 0.001
    assert end["cosine"] < 0.001
    assert start["ease-in"] < 0.001
    assert end["ease-in"] == pytest.approx(math.pi / 2, rel=1e-3)
    assert start["ease-out"] == pytest.approx(math.pi / 2, rel=1e-3)
    assert end["ease-out"] < 0.001


def test_unknown_change_function_is_refused_with_near_matches():
    with pytest.raises(UnknownNameError, match=r"change function 'cosin' — did you mean 'cosine' or"):
        change_code("cosin")


def test_row_numbers_do_not_move():
    assert CHANGE_NAMES == ("linear", "cosine", "ease-in", "ease-out")
