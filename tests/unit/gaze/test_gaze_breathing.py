"""Breaths: as many as people draw, at rest at both ends, the same for the same seed."""

import numpy as np

from mien.gaze.breathing import RISE_DEG, breathing


def test_breaths_are_as_many_as_people_draw():
    values = breathing(600.0, 2).evaluate(np.arange(0.0, 600.0, 0.05))[0]
    tops = (values[1:-1] > values[:-2]) & (values[1:-1] >= values[2:]) & (values[1:-1] > 0.3)
    assert 12 * 10 <= tops.sum() <= 18 * 10
    assert 0.0 <= values.min() <= values.max() <= 1.25 * RISE_DEG


def test_a_stretch_begins_and_ends_at_rest():
    for length_s in (1.0, 10.0, 30.0):
        track = breathing(length_s, 7)
        assert track.evaluate([0.0, track.length_s])[0].tolist() == [0.0, 0.0]
        assert track.length_s == length_s


def test_seeds_decide():
    assert breathing(30.0, 1) == breathing(30.0, 1) != breathing(30.0, 2)
