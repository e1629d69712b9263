"""The turn of a drawn head: known answers, senses, and that rest is left alone to the bit."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mien import load_face
from mien.faces.toon.records import Head
from mien.faces.toon.turning import turn

HEAD = Head(center=(200.0, 215.0), radius=(90.0, 110.0), pivot=(200.0, 340.0))
CENTER = np.array([HEAD.center])


def test_no_turn_is_the_same_to_the_bit() -> None:
    points = np.random.default_rng(1).uniform(-50.0, 450.0, (500, 2))
    assert np.array_equal(turn(points, HEAD, 0.3, 0.5, 1.0, 0.0, 0.0, 0.0), points)
    # One angle at rest leaves its own direction alone, whatever the others do.
    assert np.array_equal(turn(points, HEAD, 0.3, 0.5, 1.0, 20.0, 0.0)[:, 1], points[:, 1])
    assert np.array_equal(turn(points, HEAD, 0.3, 0.5, 1.0, 0.0, 20.0)[:, 0], points[:, 0])


def test_the_centre_on_the_axis_stays() -> None:
    assert np.array_equal(turn(CENTER, HEAD, 0.0, 0.0, 1.0, 25.0, -13.0), CENTER)


def test_a_point_in_front_goes_with_the_turn_by_its_depth() -> None:
    # sin 30 deg = 1/2: left as seen by 90 * 0.4 / 2 = 18, up (y down) by 110 * 0.4 / 2 = 22.
    np.testing.assert_allclose(turn(CENTER, HEAD, 0.4, 0.0, 1.0, 30.0, 0.0), [[182.0, 215.0]], rtol=0, atol=1e-12)
    np.testing.assert_allclose(turn(CENTER, HEAD, 0.4, 0.0, 1.0, 0.0, 30.0), [[200.0, 193.0]], rtol=0, atol=1e-12)
    # The bulge counts whole in the middle, and a point behind goes the other way.
    np.testing.assert_allclose(turn(CENTER, HEAD, 0.1, 0.3, 1.0, 30.0, 0.0), [[182.0, 215.0]], rtol=0, atol=1e-12)
    np.testing.assert_allclose(turn(CENTER, HEAD, -0.4, 0.0, 1.0, 30.0, 0.0), [[218.0, 215.0]], rtol=0, atol=1e-12)


def test_a_flat_disc_narrows_by_the_cosine() -> None:
    side = np.array([[290.0, 215.0], [110.0, 215.0]])
    np.testing.assert_allclose(
        turn(side, HEAD, 0.0, 0.0, 1.0, 60.0, 0.0), [[245.0, 215.0], [155.0, 215.0]], rtol=0, atol=1e-12
    )
    np.testing.assert_array_equal(turn(side, HEAD, 0.0, 0.0, 0.0, 60.0, 0.0), side)


def test_a_tilt_turns_about_the_pivot_towards_the_own_left_shoulder() -> None:
    turned = turn(CENTER, HEAD, 0.3, 0.0, 0.4, 0.0, 0.0, 90.0)
    np.testing.assert_allclose(turned, [[325.0, 340.0]], rtol=0, atol=1e-12)
    # The own left is the right of the picture, and so on the head that is not drawn.
    head = load_face("head").unsubdivided
    rest, tilted = (head.shape(pose).points for pose in (head.neutral, head.neutral.replace({"head.tilt": 10.0})))
    top = int(np.argmax(rest[:, 1]))
    assert tilted[top, 0] > rest[top, 0]


def test_polygons_turn_in_one_call_as_they_do_alone() -> None:
    random = np.random.default_rng(2)
    pieces = [random.uniform(80.0, 320.0, (n, 2)) for n in (3, 40, 7)]
    depths = [(0.1, 0.0, 0.4), (0.3, 0.5, 1.0), (-0.5, 0.0, 0.2)]
    alone = [turn(piece, HEAD, *depth, 11.0, -7.0, 4.0) for piece, depth in zip(pieces, depths, strict=True)]
    rows = np.repeat(depths, [len(piece) for piece in pieces], axis=0)
    together = turn(np.concatenate(pieces), HEAD, *rows.T, 11.0, -7.0, 4.0)
    assert np.array_equal(together, np.concatenate(alone))


@pytest.mark.parametrize("angles", [(89.0, 0.0, 0.0), (-180.0, 90.0, 45.0)])
def test_points_outside_the_ellipsoid_have_no_bulge_and_no_nan(angles: tuple[float, float, float]) -> None:
    outside = np.array([[0.0, 0.0], [400.0, 440.0], [290.0 + 1e-9, 215.0]])
    turned = turn(outside, HEAD, 0.2, 0.9, 0.5, *angles)
    assert np.isfinite(turned).all()
    np.testing.assert_array_equal(turned, turn(outside, HEAD, 0.2, 0.0, 0.5, *angles))


def test_turning_does_not_change_what_it_is_given() -> None:
    points = np.array([[150.0, 200.0], [math.pi, 1.0]])
    before = points.copy()
    turn(points, HEAD, 0.3, 0.3, 1.0, 20.0, 10.0, 5.0)
    assert np.array_equal(points, before)
