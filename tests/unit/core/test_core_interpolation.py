"""Surfaces through given points: known limits, random points, corners, and what no surface passes through."""

import numpy as np
import pytest

from mien.core import Material, Mesh, build_topology, subdivide
from mien.core.interpolation import cage_through, limit_of

SMOOTH = Material(subdivide=True)


def board(count, creases=None):
    first = [row * count + column for row in range(count - 1) for column in range(count - 1)]
    quads = np.array([[n, n + 1, n + 1 + count, n + count] for n in first])
    return build_topology(count * count, [("board", quads, SMOOTH)], creases)


def rough(count, seed=0):
    generator = np.random.default_rng(seed)
    return np.array([[x, y, generator.normal()] for y in range(count) for x in range(count)]) * 0.02


def test_inside_a_board_the_limit_has_the_weights_of_bicubic_b_splines():
    weights = limit_of(board(5)).apply(np.eye(25))
    row = weights[12].reshape(5, 5)
    np.testing.assert_allclose(row[1:4, 1:4], np.outer([1, 4, 1], [1, 4, 1]) / 36.0, atol=1e-15)
    np.testing.assert_allclose(row.sum(), 1.0)
    edge = weights[2].reshape(5, 5)
    np.testing.assert_allclose(edge[0], np.array([0, 1, 4, 1, 0]) / 6.0, atol=1e-15)


@pytest.mark.parametrize("creases", [None, np.array([[6, 7], [7, 8], [12, 12]])])
def test_deep_subdivision_of_the_cage_comes_to_the_points(creases):
    topology, points = board(5, creases), rough(5)
    cage, missed = cage_through(topology, points)
    assert missed <= 1e-7
    mesh = subdivide(Mesh(topology, cage, np.ones((25, 3))), 5)
    inside = np.setdiff1d(np.arange(25), [6, 8] if creases is not None else [])  # a crease that ends is nearly met
    np.testing.assert_allclose(mesh.points[:25][inside], points[inside], atol=2e-4)


def test_triangles_and_fans_are_met_too():
    count = 9
    ring = [[np.cos(a), np.sin(a), 0.0] for a in 2.0 * np.pi * np.arange(count) / count]
    points = np.array([[0.0, 0.0, 0.4], *ring]) * 0.1
    fans = np.array([[0, 1 + k, 1 + (k + 1) % count] for k in range(count)])
    topology = build_topology(count + 1, [("fan", fans, SMOOTH)])
    cage, missed = cage_through(topology, points)
    assert missed <= 1e-7
    np.testing.assert_allclose(limit_of(topology).apply(cage), points, atol=1e-7)


def test_a_corner_is_left_where_it_is():
    points = rough(5, 1)
    assert np.array_equal(limit_of(board(5, np.array([[12, 12]]))).apply(points)[12], points[12])
    fine = subdivide(Mesh(board(5, np.array([[12, 12]])), points, np.ones((25, 3))), 2)
    np.testing.assert_array_equal(fine.points[12], points[12])


def test_parts_that_are_not_subdivided_stay():
    quads = np.array([[0, 1, 3, 2]])
    topology = build_topology(8, [("fine", quads, SMOOTH), ("plain", quads + 4, Material())])
    points = np.random.default_rng(3).random((8, 3))
    cage, _ = cage_through(topology, points)
    np.testing.assert_array_equal(cage[4:], points[4:])
    assert not np.array_equal(cage[:4], points[:4])


def test_where_no_surface_passes_through_the_cage_does_not_run_away():
    # Two triangles back to back: the limit of every cage is flat and its own mirror image.
    points = np.eye(3) * 0.1
    topology = build_topology(3, [("leaf", np.array([[0, 1, 2], [0, 2, 1]]), SMOOTH)])
    cage, missed = cage_through(topology, points)
    assert missed > 0.01
    assert np.abs(cage).max() < 1.0
