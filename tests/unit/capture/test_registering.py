"""Moments laid onto one another."""

from __future__ import annotations

import numpy as np
import pytest

from mien.capture.registering import Motion, fit_motion, fit_similarity, register
from mien.core import MienError

QUARTER = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
"""A quarter of a turn about z."""


def cloud(count: int) -> np.ndarray:
    """(count, 3) m, as large as a head."""
    return np.random.default_rng(3).normal(0.0, 0.06, (count, 3))


def test_a_quarter_turn_and_a_shift_are_found():
    points = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]])
    motion = fit_motion(points, points @ QUARTER.T + [0.0, 0.0, 5.0])
    np.testing.assert_allclose(motion.turn, QUARTER, atol=1e-12)
    np.testing.assert_allclose(motion.shift, [0.0, 0.0, 5.0], atol=1e-12)


def test_a_mirror_image_is_not_a_motion():
    points = cloud(20)
    assert np.linalg.det(fit_motion(points, points * [-1.0, 1.0, 1.0]).turn) == pytest.approx(1.0)


def test_one_motion_after_another():
    first, second = Motion(QUARTER, np.array([1.0, 0.0, 0.0])), Motion(QUARTER, np.array([0.0, 2.0, 0.0]))
    np.testing.assert_allclose(second.after(first).apply(np.array([[1.0, 0.0, 0.0]])), [[-1.0, 3.0, 0.0]], atol=1e-12)


def test_scale_of_something_twice_as_large():
    points = cloud(9)
    motion, scale = fit_similarity(points, 2.0 * points @ QUARTER.T + [0.1, 0.2, 0.3])
    assert scale == pytest.approx(2.0)
    np.testing.assert_allclose(motion.apply(scale * points), 2.0 * points @ QUARTER.T + [0.1, 0.2, 0.3], atol=1e-12)


def test_a_face_that_opens_its_mouth_does_not_swim():
    rest = cloud(40)
    moved = rest.copy()
    moved[:15] += [0.0, -0.02, -0.01]
    names = tuple(str(k) for k in range(40))
    motions = register({"rest": rest, "open": moved @ QUARTER.T + [0.01, 0.0, 0.02]}, names)
    np.testing.assert_allclose(motions["open"].apply(moved @ QUARTER.T + [0.01, 0.0, 0.02])[15:], rest[15:], atol=1e-6)


def test_still_points_are_believed_even_where_they_are_few():
    rest = cloud(30)
    moved = rest + np.array([0.0, 0.01, 0.0])
    moved[:4] = rest[:4]
    names = tuple(str(k) for k in range(30))
    motions = register({"rest": rest, "smile": moved}, names, ("0", "1", "2", "3"))
    np.testing.assert_allclose(motions["smile"].shift, 0.0, atol=1e-9)
    np.testing.assert_allclose(register({"rest": rest, "smile": moved}, names)["smile"].shift[1], -0.01, atol=1e-6)


def test_points_that_were_not_found_take_no_part():
    rest = cloud(12)
    seen = rest + np.array([0.0, 0.0, 0.1])
    seen[5] = np.nan
    motions = register({"rest": rest, "blink": seen}, tuple("abcdefghijkl"))
    np.testing.assert_allclose(motions["blink"].shift, [0.0, 0.0, -0.1], atol=1e-9)


def test_two_still_points_hold_no_head():
    rest = cloud(6)
    with pytest.raises(MienError, match=r"moment 'smile' has 2 still points .* wanted at least 3 — click more"):
        register({"rest": rest, "smile": rest}, tuple("abcdef"), ("a", "b"))


def test_points_on_a_line_leave_a_turn_free():
    line = np.arange(5.0)[:, None] * [0.01, 0.0, 0.0]
    with pytest.raises(MienError, match="on a line"):
        fit_motion(line, line)
