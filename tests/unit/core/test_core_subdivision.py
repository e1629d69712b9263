"""Catmull-Clark: known answers on a cube, boundaries, creases, doubled vertices, partition of unity."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.core import Material, Mesh, build_topology, subdivide
from mien.core.subdivision import refine

SOFT, HARD = Material(subdivide=True), Material()

CUBE_POINTS = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
CUBE_POLYGONS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


def mesh_of(points, polygons, colors=None, creases=None, material=SOFT):
    topology = build_topology(len(points), [("skin", polygons, material)], creases)
    return Mesh(topology, points, np.ones_like(points) * 0.5 if colors is None else colors)


def grid(width, height, *, lift=0.0):
    """A sheet of ``width x height`` unit squares; ``lift`` raises its inner vertices."""
    x, y = np.meshgrid(np.arange(width + 1.0), np.arange(height + 1.0))
    inner = (x > 0) & (x < width) & (y > 0) & (y < height)
    points = np.stack([x, y, lift * inner], axis=2).reshape(-1, 3)
    corner = (np.arange(height)[:, None] * (width + 1) + np.arange(width)).reshape(-1, 1)
    return points, corner + np.array([0, 1, width + 2, width + 1])


def matrix_as_dense(matrix):
    return matrix.apply(np.eye(matrix.shape[1]))


def test_one_level_of_a_cube_by_hand():
    fine = subdivide(mesh_of(CUBE_POINTS, CUBE_POLYGONS), 1)
    assert fine.topology.polygon_count == 24
    assert len(fine.points) == 8 + 6 + 12
    # A corner: mean of face points (1/3, ..), of edge midpoints (2/3, ..): (Q + 2R + 0 S) / 3 = 5/9.
    np.testing.assert_allclose(fine.points[:8], CUBE_POINTS * 5 / 9, rtol=1e-14)
    # A face point is the middle of its face, an edge point (1 + 1/2) / 2 = 3/4 out on both its axes.
    np.testing.assert_allclose(np.sort(np.abs(fine.points[8:14]), axis=1), [[0, 0, 1]] * 6, atol=1e-15)
    np.testing.assert_allclose(np.sort(np.abs(fine.points[14:]), axis=1), [[0, 0.75, 0.75]] * 12, atol=1e-15)


def test_a_finer_cube_keeps_facing_outwards():
    fine = subdivide(mesh_of(CUBE_POINTS, CUBE_POLYGONS), 2)
    a, b, c = (fine.points[fine.topology.triangles[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    assert (volume > 0).all()
    assert 8 * 0.3 < volume.sum() < 8 * 0.6


def test_a_boundary_is_a_spline_of_its_own():
    points, polygons = grid(4, 4, lift=7.0)
    fine = subdivide(mesh_of(points, polygons), 1)
    # Whatever the inside does: (1 6 1)/8 at old vertices, midpoints between, and corners move inwards.
    assert fine.points[2].tolist() == [2, 0, 0]
    assert fine.points[0].tolist() == [0.125, 0.125, 0]
    on_edge = fine.points[(fine.points[:, 1] == 0)]
    assert np.sort(on_edge[:, 0]).tolist() == [0.5, 1, 1.5, 2, 2.5, 3, 3.5]
    assert (on_edge[:, 2] == 0).all()


def test_a_crease_stays_sharp_and_a_smooth_edge_does_not():
    points, polygons = grid(2, 2)
    roof = points.copy()
    roof[[3, 4, 5], 2] = 1.0
    ridge = np.array([[3, 4], [5, 4]])
    smooth = subdivide(mesh_of(roof, polygons), 2)
    sharp = subdivide(mesh_of(roof, polygons, creases=ridge), 2)
    assert sharp.points[4, 2] == 1.0
    assert smooth.points[4, 2] < 0.8


def test_an_end_of_one_crease_alone_is_smooth():
    points, polygons = grid(2, 2, lift=1.0)
    plain = subdivide(mesh_of(points, polygons), 1)
    dart = subdivide(mesh_of(points, polygons, creases=np.array([[3, 4]])), 1)
    assert dart.points[4].tolist() == plain.points[4].tolist()
    assert dart.points[:, 2].max() > plain.points[:, 2].max() - 1e-12
    assert not np.array_equal(dart.points, plain.points)


def test_where_three_creases_meet_the_vertex_stays():
    points, polygons = grid(2, 2, lift=1.0)
    fine = subdivide(mesh_of(points, polygons, creases=np.array([[3, 4], [4, 5], [4, 7]])), 2)
    assert fine.points[4].tolist() == points[4].tolist()


def test_doubled_vertices_leave_no_crack():
    # Two rings of quads, a tube and its brim, that meet in a circle; each has vertices of its own there.
    angles = np.arange(8) * np.pi / 4
    around = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    tube = np.concatenate([around, around + np.array([0, 0, 1])])
    brim = np.concatenate([2 * around, around])
    next_one = (np.arange(8) + 1) % 8
    ring = np.stack([np.arange(8), next_one, next_one + 8, np.arange(8) + 8], axis=1)
    for levels in (1, 2, 3):
        fine = subdivide(mesh_of(np.concatenate([tube, brim]), np.concatenate([ring, ring + 16])), levels)
        radius = np.hypot(fine.points[:, 0], fine.points[:, 1])
        meeting = fine.points[(fine.points[:, 2] == 0.0) & (radius <= 1.0)]
        _, times = np.unique(meeting, axis=0, return_counts=True)
        assert times.tolist() == [2] * 8 * 2**levels


@given(width=st.integers(1, 4), height=st.integers(1, 4))
def test_rows_are_affine_and_not_negative(width, height):
    points, polygons = grid(width, height)
    dense = matrix_as_dense(refine(mesh_of(points, polygons).topology).matrix)
    np.testing.assert_allclose(dense.sum(axis=1), 1.0, atol=1e-14)
    assert dense.min() >= 0.0


def test_rows_of_a_closed_mesh_with_odd_valences_add_up_to_one():
    triangles = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
    topology = build_topology(4, [("skin", triangles, SOFT)])
    dense = matrix_as_dense(refine(topology).matrix)
    np.testing.assert_allclose(dense.sum(axis=1), 1.0, atol=1e-14)
    assert refine(topology).topology.polygon_count == 12


def test_other_parts_pass_through():
    points, polygons = grid(2, 2, lift=1.0)
    eye = np.array([[0.0, 0, 5], [1, 0, 5], [0, 1, 5]])
    parts = [("eye", np.array([[9, 10, 11]]), HARD), ("skin", polygons, SOFT)]
    topology = build_topology(12, parts)
    fine = subdivide(Mesh(topology, np.concatenate([points, eye]), np.full((12, 3), 0.5)), 2)
    assert [(part.name, part.last - part.first) for part in fine.topology.parts] == [("eye", 1), ("skin", 64)]
    assert fine.topology.polygon(0).tolist() == [9, 10, 11]
    np.testing.assert_array_equal(fine.points[9:12], eye)


def test_no_level_and_no_soft_part_change_nothing():
    mesh = mesh_of(CUBE_POINTS, CUBE_POLYGONS)
    assert subdivide(mesh, 0) is mesh
    hard = subdivide(mesh_of(CUBE_POINTS, CUBE_POLYGONS, material=HARD), 2)
    np.testing.assert_array_equal(hard.points, CUBE_POINTS)
    assert [hard.topology.polygon(number).tolist() for number in range(6)] == CUBE_POLYGONS.tolist()


def test_colours_of_vertices_are_smoothed_and_stay_in_range():
    colors = (CUBE_POINTS + 1) / 2
    fine = subdivide(mesh_of(CUBE_POINTS, CUBE_POLYGONS, colors), 1)
    np.testing.assert_allclose(fine.colors, (fine.points + 1) / 2, atol=1e-15)
    assert not fine.colored_by_polygon


def test_colours_of_polygons_go_to_their_children():
    colors = np.arange(18.0).reshape(6, 3)
    fine = subdivide(mesh_of(CUBE_POINTS, CUBE_POLYGONS, colors), 1)
    assert fine.colored_by_polygon
    np.testing.assert_array_equal(fine.colors, np.repeat(colors, 4, axis=0))
    centre = fine.points[fine.topology.corners.reshape(-1, 4)].mean(axis=1)
    parent = CUBE_POINTS[CUBE_POLYGONS].mean(axis=1).repeat(4, axis=0)
    assert (np.einsum("ij,ij->i", centre, parent) > 0.5).all()


def test_normals_of_round_parts_move_along():
    points, polygons = grid(1, 1)
    eye = np.array([[0.0, 0, 5], [1, 0, 5], [0, 1, 5]])
    parts = [("skin", polygons, SOFT), ("eye", np.array([[4, 5, 6]]), Material(round=True))]
    normals = np.tile([0.0, 0.0, 1.0], (7, 1))
    mesh = Mesh(build_topology(7, parts), np.concatenate([points, eye]), np.full((7, 3), 0.5), normals)
    fine = subdivide(mesh, 2)
    assert fine.normals.shape == fine.points.shape
    np.testing.assert_array_equal(fine.normals[4:7], normals[4:7])


def test_the_matrix_is_made_once():
    topology = build_topology(8, [("skin", CUBE_POLYGONS, SOFT)])
    assert refine(topology) is refine(topology)


@pytest.mark.parametrize("levels", [1, 2])
def test_a_symmetric_mesh_stays_symmetric(levels):
    points, polygons = grid(4, 2, lift=1.0)
    points[:, 0] -= 2
    fine = subdivide(mesh_of(points, polygons), levels).points
    mirrored = fine * [-1, 1, 1]
    key = lambda p: p[np.lexsort(np.round(p, 9).T)]  # noqa: E731 — an order for two equal sets of points
    np.testing.assert_allclose(key(fine), key(mirrored), atol=1e-12)
