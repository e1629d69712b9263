"""Laws of the classic skin's polygons: nearly plane where the face is smooth."""

import numpy as np

from breaking import parke_pose
from mien.faces.head import Head
from mien.faces.head.measured import archive
from planarity import PLANE_DEG, bent_share, smooth_bends_deg, smooth_quads
from soundness import Posed, bends_deg

HEAD = Head(hair="bald", kind="surface")


def test_smooth_skin_is_plane_at_rest():
    bends = smooth_bends_deg(Posed(HEAD, HEAD.neutral))
    assert len(bends) == 154
    assert bends.max() < PLANE_DEG


def test_moves_are_small_and_leave_lids_alone():
    face = archive()
    points = face.floats("surface")
    assert np.abs(face.measured("surface").points - points).max() < 0.0012
    moved = np.flatnonzero(np.abs(face.floats("surface_flatter")).max(axis=1))
    assert set(moved) <= set(face.quads[smooth_quads(face)].ravel())
    assert not set(moved) & set(face.ints("lid_index"))


def test_moves_are_symmetric():
    moves, mirror = archive().floats("surface_flatter"), archive().mirror
    np.testing.assert_array_equal(moves[mirror] * [-1.0, 1.0, 1.0], moves)


def test_share_that_bends_in_poses():
    """Moves of mouth, cheeks and the scale of the head bend polygons anew: random poses have all of them at once."""
    shares = [bent_share(parke_pose(HEAD, seed)) for seed in range(100)]
    assert np.mean(shares) < 0.42


def test_points_on_the_reference_are_not_plane():
    face = archive()
    bends = bends_deg(face.floats("surface"), face.quads[smooth_quads(face)])
    assert (bends > PLANE_DEG).mean() > 0.2
