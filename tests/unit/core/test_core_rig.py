"""Rigid parts of a face: how they have moved is read off three points."""

from __future__ import annotations

import numpy as np
import pytest

from mien.core import Joint, MienError, Motion, Parameter, ParameterTable, Pose, Rig
from mien.core.rig import find_pivot, pick_anchors, quaternion, unmoved, unturned

# Corners of the body, then of the arm, which hangs on it.
REST = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 0, 0], [3, 0, 0], [2, 1, 0], [1, 0, 0]])
BODY = Joint("body", None, (0.0, 0.0, 0.0), (0, 1, 2), ("body.turn",))
ARM = Joint("arm", "body", (2.0, 0.0, 0.0), (3, 4, 5), ("arm.turn",))
SHARES = np.array([[1.0, 0]] * 3 + [[0, 1.0]] * 3 + [[0.5, 0.5]])
RIG = Rig((BODY, ARM), SHARES)

QUARTER = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
"""A quarter turn about z."""


def moved() -> np.ndarray:
    """The body turned by a quarter about its corner and raised by 1; the arm turned by another quarter."""
    points = REST @ QUARTER.T + [0, 0, 1.0]
    points[3:6] = (points[3:6] - points[3]) @ QUARTER.T + points[3]
    return points


def test_turns_and_shifts_are_found() -> None:
    motion = RIG.motion(REST, moved())
    np.testing.assert_allclose(motion.turns, [QUARTER, QUARTER @ QUARTER], atol=1e-15)
    np.testing.assert_allclose(motion.shifts, [[0, 0, 1], [2, 2, 1]], atol=1e-15)


def test_a_joint_is_seen_from_its_parent() -> None:
    turns, places = RIG.steps(RIG.motion(REST, moved()))
    half = np.sqrt(0.5)
    np.testing.assert_allclose(turns, [[0, 0, half, half]] * 2, atol=1e-15)
    np.testing.assert_allclose(places, [[0, 0, 1], [2, 0, 0]], atol=1e-15)


def test_points_go_back_to_rest_whatever_their_shares() -> None:
    motion = RIG.motion(REST, moved())
    points = np.einsum("vj,jvk->vk", SHARES, np.einsum("jab,vb->jva", motion.turns, REST) + motion.shifts[:, None])
    np.testing.assert_allclose(unmoved(points, SHARES, motion), REST, atol=1e-14)


def test_directions_are_turned_back_and_not_shifted() -> None:
    motion = Motion(np.array([QUARTER]), np.array([[5.0, 5, 5]]))
    directions = unturned(np.array([[0.0, 1, 0], [0, 0, 0]]), np.ones((2, 1)), motion)
    np.testing.assert_allclose(directions, [[1, 0, 0], [0, 0, 0]], atol=1e-15)


@pytest.mark.parametrize("axis", range(3))
def test_quaternion_of_a_half_turn(axis: int) -> None:
    turn = -np.eye(3)
    turn[axis, axis] = 1.0
    assert np.abs(quaternion(turn)).tolist() == [float(k == axis) for k in range(4)]


def test_quaternion_of_no_turn() -> None:
    assert quaternion(np.eye(3)) == (0.0, 0.0, 0.0, 1.0)


def test_anchors_lie_far_from_one_another() -> None:
    points = np.array([[9.0, 9, 9], [0, 0, 0], [0.1, 0, 0], [1, 0, 0], [0.5, 0.01, 0], [0.5, 0.7, 0]])
    assert pick_anchors(points, np.arange(1, 6)) == (1, 3, 5)


def test_the_pivot_is_where_nothing_moves() -> None:
    centre = np.array([0.3, -0.2, 0.1])
    about_z = Motion(QUARTER[None], (centre - QUARTER @ centre)[None])
    about_x = Motion(np.roll(QUARTER, (1, 1), (0, 1))[None], (centre - np.roll(QUARTER, (1, 1), (0, 1)) @ centre)[None])
    np.testing.assert_allclose(find_pivot([about_z, about_x]), centre, atol=1e-8)
    np.testing.assert_allclose(find_pivot([about_z]), [0.3, -0.2, 0.0], atol=1e-8)  # an axis, at the origin's height
    assert find_pivot([]) == (0.0, 0.0, 0.0)


def test_joints_at_rest_have_their_defaults() -> None:
    table = ParameterTable(tuple(Parameter(name, -1, 1) for name in ("body.turn", "arm.turn", "smile")))
    pose = Pose.neutral(table).replace({"arm.turn": 1.0, "smile": 0.5})
    assert RIG.rest(pose).changed() == {"smile": 0.5}


def test_a_child_before_its_parent_is_refused() -> None:
    with pytest.raises(MienError, match="joint 'arm' comes before 'body', which carries it"):
        Rig((ARM, BODY), SHARES)


def test_shares_of_other_joints_are_refused() -> None:
    with pytest.raises(MienError, match=r"shares of 2 joints have the shape \(7, 1\)"):
        Rig((BODY, ARM), SHARES[:, :1])
