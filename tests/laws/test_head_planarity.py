"""Laws of the classic skin's polygons: nearly plane where the face is smooth."""

import numpy as np
import pytest

from breaking import corner_pose, parke_names, parke_pose
from mien.faces.head import Head
from mien.faces.head.measured import archive
from mien.faces.head.planing import planes_of
from planarity import PLANE_DEG, bent_head, bent_share, smooth_bends_deg, smooth_quads
from soundness import Posed, bends_deg, through_skin_mm

HEAD = Head(hair="bald", kind="surface")
BENT = bent_head(HEAD)
POSES = 60


def moves_mm(pose):
    """(V,) how far planes move each point of the classic head."""
    return 1000.0 * np.linalg.norm(HEAD.shape(pose).points - BENT.shape(pose).points, axis=1)


def test_smooth_skin_is_plane_at_rest():
    bends = smooth_bends_deg(Posed(HEAD, HEAD.neutral))
    assert len(bends) == 154
    assert bends.max() < PLANE_DEG
    np.testing.assert_array_equal(HEAD.shape(HEAD.neutral).points, BENT.shape(BENT.neutral).points)


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


def test_the_polygons_of_the_data_are_those_where_the_face_is_smooth():
    face = archive()
    wanted = {frozenset(row) for row in face.quads[smooth_quads(face)].tolist()}
    assert {frozenset(row) for row in planes_of(face, "surface").pairs.reshape(-1, 4).tolist()} == wanted


def test_hardly_a_polygon_bends_in_random_poses():
    """Random poses have moves of everything at once; without planes 38 % of the polygons bend."""
    posed = [parke_pose(HEAD, seed) for seed in range(POSES)]
    assert np.mean([bent_share(each) for each in posed]) < 0.006
    assert np.mean([bent_share(Posed(BENT, each.pose)) for each in posed]) > 0.3


def test_few_polygons_bend_with_everything_at_an_end():
    assert np.mean([bent_share(corner_pose(HEAD, seed)) for seed in range(30)]) < 0.03


@pytest.mark.parametrize("end", ["low", "high"])
def test_no_parameter_bends_a_polygon_by_itself(end):
    for name in parke_names(HEAD.parameters):
        pose = HEAD.neutral.replace({name: getattr(HEAD.parameters[name], end)})
        assert bent_share(Posed(HEAD, pose)) == 0.0, name
        assert moves_mm(pose).max() < 7.5, name


def test_points_go_a_few_millimetres_for_that_in_random_poses():
    most = [moves_mm(parke_pose(HEAD, seed).pose).max() for seed in range(POSES)]
    assert np.median(most) < 4.7
    assert max(most) < 15.0


def test_teeth_do_not_come_through_for_that():
    poses = [parke_pose(HEAD, seed).pose for seed in range(0, POSES, 2)]
    through = {head: [through_skin_mm(Posed(head, pose), "teeth", "gums") for pose in poses] for head in (HEAD, BENT)}
    assert (np.array(through[HEAD]) > 0.5).sum() <= (np.array(through[BENT]) > 0.5).sum()


def test_planes_grow_with_what_bends_them():
    """No point jumps on the way from one pose to another."""
    start, end = parke_pose(HEAD, 2).pose.values, parke_pose(HEAD, 52).pose.values
    for steps, most_mm in ((200, 2.5), (20000, 0.05)):
        share = 0.5 + (np.arange(201)[:, None] - 100.0) / steps
        points = HEAD.shapes(start * (1.0 - share) + end * share)
        assert 1000.0 * np.linalg.norm(np.diff(points, axis=0), axis=2).max() < most_mm


def test_points_on_the_reference_are_not_plane():
    face = archive()
    bends = bends_deg(face.floats("surface"), face.quads[smooth_quads(face)])
    assert (bends > PLANE_DEG).mean() > 0.2
