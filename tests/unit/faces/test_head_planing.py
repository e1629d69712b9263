"""Polygons are made plane: by how much, what stays, and what is left alone."""

import numpy as np
import pytest

from mien.faces.head import planing
from mien.faces.head.measured import archive
from mien.faces.head.planing import MOST, planes_of
from support import in_python

SIDE_M = 0.012
SQUARE = SIDE_M * np.array([(1.0, 0.0, 0.0), (2.0, 0.0, 0.0), (2.0, 1.0, 0.0), (1.0, 1.0, 0.0)])
MIRROR = np.array([-1.0, 1.0, 1.0])
PAIR = np.array([[[0, 1, 2, 3], [4, 5, 6, 7]]])
NO_SCALE = np.ones(3)


def both(left):
    """A polygon and its mirror image."""
    return np.concatenate([left, left * MIRROR])


def raised(height_m):
    """A square with a corner raised, on both sides."""
    square = SQUARE.copy()
    square[2, 2] = height_m
    return both(square)


def planed(points, free=None, scale=NO_SCALE, pairs=PAIR):
    """What becomes of points."""
    out = points.copy()
    free = np.ones(len(points)) if free is None else np.array(free)
    in_python(planing.plane_skin)(out, pairs, free, scale, np.empty((8, 3)), np.empty((8, 2)))
    return out


def bend(points):
    """Angle between the triangles on both sides of the diagonal from the second corner, radians."""
    a, b, c, d = points[:4]
    first, second = np.cross(b - a, d - a), np.cross(c - b, d - b)
    return np.arccos(first @ second / np.linalg.norm(first) / np.linalg.norm(second))


def test_a_bent_square_is_bent_less_by_all_its_corners_alike():
    """Its diagonals are at a gap of half the height; it bends by as much as the height over that of its corner."""
    height = 0.003
    out = planed(raised(height))
    assert bend(raised(height)) == pytest.approx(np.arctan(np.sqrt(2.0) * height / SIDE_M))
    assert bend(out) < MOST
    moves = (out - raised(height))[:4, 2]
    np.testing.assert_allclose(moves, moves[0] * np.array([1.0, -1.0, 1.0, -1.0]), rtol=1e-9)
    assert -height / 4.0 * 1.3 < moves[0] < -height / 8.0


def test_mirror_images_stay_mirror_images():
    out = planed(raised(0.003))
    np.testing.assert_array_equal(out[4:], out[:4] * MIRROR)


def test_what_is_plane_enough_is_left_alone():
    points = raised(0.95 * MOST * SIDE_M / np.sqrt(2.0))
    np.testing.assert_array_equal(planed(points), points)
    assert not np.array_equal(planed(1.2 * points), planed(points))


def test_fixed_corners_stay_and_the_others_do_their_work():
    out = planed(raised(0.003), [0.0, 1.0, 0.0, 1.0] * 2)
    np.testing.assert_array_equal(out[[0, 2]], raised(0.003)[[0, 2]])
    assert bend(out) < MOST
    np.testing.assert_array_equal(planed(raised(0.003), np.zeros(8)), raised(0.003))


def test_planes_are_plane_once_the_head_is_scaled():
    points, deep = raised(0.95 * MOST * SIDE_M / np.sqrt(2.0)), np.array([1.0, 1.0, 2.0])
    out = planed(points, scale=deep)
    assert bend(points * deep) > MOST > bend(out * deep)


def crossing(points):
    """Where the diagonals of a polygon in the plane z = 0 cross: share of the first, and of the second."""
    first, second = points[2] - points[0], points[3] - points[1]
    return np.linalg.solve(np.stack([first, -second], axis=1)[:2], (points[1] - points[0])[:2])


def test_a_twisted_polygon_is_untwisted():
    twisted = SIDE_M * np.array([(2.0, 0.0, 0.0), (3.0, 0.2, 0.0), (3.0, 0.0, 0.0), (2.0, 1.0, 0.0)])
    np.testing.assert_allclose(crossing(twisted), [1.25, -0.25])
    shares = crossing(planed(both(twisted)))
    assert np.minimum(shares, 1.0 - shares).max() > 0.1


def test_neighbours_meet_in_between():
    """A roof of two polygons a side, whose common edge is askew."""
    strip = SIDE_M * np.array([(1, 0, 0), (2, 0, 0.3), (3, 0, 0), (1, 1, 0), (2, 1, -0.3), (3, 1, 0)], dtype=float)
    pairs = np.array([[[0, 1, 4, 3], [6, 7, 10, 9]], [[1, 2, 5, 4], [7, 8, 11, 10]]])
    out = planed(both(strip), pairs=pairs)
    assert bend(both(strip)[[0, 1, 4, 3]]) > 0.3
    assert max(bend(out[[0, 1, 4, 3]]), bend(out[[1, 2, 5, 4]])) < MOST


def test_a_cage_has_none():
    planes = planes_of(archive(), "cage")
    assert planes.pairs.shape == (0, 2, 4)


def test_a_skin_moves_most_where_all_polygons_are_to_be_plane_and_never_at_lips_lids_and_ears():
    face, planes = archive(), planes_of(archive(), "surface")
    assert planes.pairs.shape == (77, 2, 4)
    assert planes.free.max() == 1.0
    np.testing.assert_array_equal(planes.free[face.mirror], planes.free)
    assert not planes.free[face.ints("lid_index")].any()
    for group in ("ear", "lips", "mouth", "nostril"):
        assert not planes.free[face.quads[face.groups == face.group_names.index(group)]].any()
