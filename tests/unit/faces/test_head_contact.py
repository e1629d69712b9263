"""What meets stays together and does not pass through: lids and lips."""

import numpy as np
import pytest

from mien.core import subdivide
from mien.faces import load_face
from mien.faces.head import lids, lips
from mien.faces.head.measured import archive
from support import in_python, lip_gap_mm

HEAD = load_face("head")
TIGHT = {"eyelid.squint": 1.0, "cheek.raise": 1.0}


def margins(values):
    """(2, 5) m, heights of the left upper and lower margin where they meet."""
    points = HEAD.shape(HEAD.neutral.replace(values)).points
    pairs = [[archive().vertex[f"e0_{station}"] for station in pair] for pair in lids.MEETING_STATIONS]
    return points[np.array(pairs).T, 1]


@pytest.mark.parametrize("more", [{}, TIGHT, {"eyebrow.lower": 1.0}, {"eyebrow.inner_raise": 1.0}, {"nose.wrinkle": 1}])
def test_shut_lids_meet_as_they_do_at_rest_whatever_the_face_around_them_does(more):
    upper, lower = margins({"eyelid.opening": 0.0, **more})
    rest_upper, rest_lower = margins({"eyelid.opening": 0.0})
    np.testing.assert_allclose(lower - upper, rest_lower - rest_upper, atol=2e-5)


@pytest.mark.parametrize("opening", [0.0, 0.2, 0.4, 0.6])
def test_a_tight_lower_lid_never_passes_the_upper_one(opening):
    upper, lower = margins({"eyelid.opening": opening, **TIGHT})
    shut_upper, shut_lower = margins({"eyelid.opening": 0.0})
    assert (lower - upper - (shut_lower - shut_upper)).max() < 2e-5


def test_margins_part_by_half_each_and_their_rings_by_their_shares():
    points = np.zeros((10, 3))
    points[5:, 1] = 0.002
    pairs, gaps = np.array([[[0, 1, 2, 3, 4], [5, 6, 7, 8, 9]]]), np.array([[0.0, 0.0, 0.0, 1.0]])
    in_python(lids.meet_lids)(points, pairs, gaps, (0.0, 0.0))
    np.testing.assert_allclose(points[:5, 1], 0.001 * np.array(lids.MEETING_SHARES))
    np.testing.assert_allclose(points[5:, 1], 0.002 - 0.001 * np.array(lids.MEETING_SHARES))


def test_a_hairline_between_the_lips_is_shut_and_a_parted_mouth_is_not():
    gap = {
        name: lip_gap_mm(subdivide(HEAD.shape(HEAD.neutral.replace(values)), 2).points)
        for name, values in (("rest", {}), ("cheeks", {"cheek.raise": 1.0}), ("parted", {"jaw.rotation": 2.0}))
    }
    assert gap["cheeks"] < gap["rest"] + 0.1
    assert gap["parted"] > gap["rest"] + 1.0


@pytest.mark.parametrize("more", [{"mouth.upper_raise": 1.0}, {"mouth.upper_raise": 0.86, "nose.wrinkle": 0.6}])
def test_an_upper_lip_rolled_in_and_raised_stays_in_front_of_the_teeth(more):
    points = HEAD.shape(HEAD.neutral.replace({"mouth.roll_upper": 1.0, **more})).points
    span, lower = HEAD._layout.span["teeth"], HEAD._layout.lower["teeth"]
    teeth = points[span][~lower]
    for ring in ("mh", "m1"):
        lip = points[archive().vertex[f"{ring}_0"]]
        front = teeth[(np.abs(teeth[:, 0]) < 0.004) & (teeth[:, 1] < lip[1] + 0.002)]
        assert lip[2] > front[:, 2].max()


def torn_lips(held, lower_at):
    """Points of a pair, upper then lower, that a shape left so (m), once they are sealed."""
    rings = len(lips.CONTACT_RINGS)
    points = np.zeros((2 * rings, 3))
    points[rings:] = lower_at
    shares = np.array(list(lips.CONTACT_RINGS.values()))
    numbers, touching = np.arange(2 * rings).reshape(1, 2, rings), np.array([[held, 0.0, 0.0, 0.0]])
    in_python(lips.seal_lips)(points, numbers, shares, touching)
    return points[:rings], points[rings:]


def test_a_lip_that_was_left_behind_comes_forward_and_the_other_one_stays():
    upper, lower = torn_lips(1.0, (0.0, 0.0, 0.001))
    np.testing.assert_allclose(upper[:, 2], (0.001 - lips.WHOLE_M) * np.array(list(lips.CONTACT_RINGS.values())))
    np.testing.assert_allclose(lower[:, 2], 0.001)


def test_inner_edges_of_torn_lips_reach_past_one_another_up_to_a_most():
    for torn_m, lock_m in ((0.0011, 0.0015), (0.010, lips.LOCK_M)):
        upper, lower = torn_lips(1.0, (torn_m, 0.0, 0.0))
        reached = (lower - upper)[:, 1]
        assert reached[lips.INNER] == pytest.approx(lock_m)
        assert np.count_nonzero(reached) == 1


def test_lips_that_are_open_are_left_as_they_are():
    upper, lower = torn_lips(0.0, (0.001, -0.004, 0.003))
    assert not upper.any()
    np.testing.assert_array_equal(lower, np.tile((0.001, -0.004, 0.003), (len(lower), 1)))
