"""Colours of polygons that flow into one another: the weights of a B-spline, borders between tints."""

from dataclasses import replace

import numpy as np

from mien.core import Material, Mesh, build_topology, subdivide
from mien.core.subdivision import refine


def board(columns, rows, tints, **material):
    """A board of squares, numbered row by row."""
    across = columns + 1
    first = [row * across + column for row in range(rows) for column in range(columns)]
    quads = np.array([[n, n + 1, n + 1 + across, n + across] for n in first])
    topology = build_topology(across * (rows + 1), [("board", quads, Material(subdivide=True, **material))])
    points = np.array([[x, y, 0.0] for y in range(rows + 1) for x in range(across)])
    return replace(topology, tints=np.array(tints)), points


def test_inside_a_board_the_weights_are_those_of_a_quadratic_b_spline():
    topology, _ = board(3, 3, [0] * 9)
    lit = np.zeros((9, 3))
    lit[4] = 16.0
    fine = refine(topology)
    children = fine.tint(lit)[:, 0].reshape(9, 4)
    np.testing.assert_allclose(children[4], [9.0] * 4)
    assert sorted(children[1]) == [0.0, 0.0, 3.0, 3.0]
    assert sorted(children[0]) == [0.0, 0.0, 0.0, 1.0]
    # No light is lost.
    np.testing.assert_allclose(children.sum(), 4.0 * 16.0)


def test_colours_keep_to_their_tint():
    topology, points = board(2, 1, [0, 1])
    mesh = subdivide(Mesh(topology, points, np.array([[0.2] * 3, [0.8] * 3])), 2)
    np.testing.assert_allclose(mesh.colors[:, 0], np.repeat([0.2, 0.8], 16), atol=1e-15)
    flowing, _ = board(2, 1, [3, 3])
    mesh = subdivide(Mesh(flowing, points, np.array([[0.2] * 3, [0.8] * 3])), 2)
    assert len(set(np.round(mesh.colors[:, 0], 9))) > 3
    assert mesh.colors.min() > 0.2 - 1e-12
    assert mesh.colors.max() < 0.8 + 1e-12


def test_without_a_number_nothing_flows():
    topology, points = board(2, 1, [-1, -1])
    mesh = subdivide(Mesh(topology, points, np.array([[0.2] * 3, [0.8] * 3])), 1)
    np.testing.assert_array_equal(mesh.colors, np.repeat([[0.2] * 3, [0.8] * 3], 4, axis=0))


def test_parts_that_are_not_subdivided_keep_their_colours():
    quads = np.array([[0, 1, 3, 2]])
    topology = build_topology(8, [("fine", quads, Material(subdivide=True)), ("plain", quads + 4, Material())])
    topology = replace(topology, tints=np.array([0, 0]))
    colors = np.array([[0.25] * 3, [0.75] * 3])
    assert refine(topology).tint(colors).tolist() == [[0.25] * 3] * 4 + [[0.75] * 3]
