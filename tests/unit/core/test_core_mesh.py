"""Topologies and meshes: polygons of any size, parts, errors."""

import numpy as np
import pytest

from mien.core import Material, Mesh, MienError, Part, Topology, UnknownNameError, build_topology

QUAD, TRIANGLE, PENTAGON = [0, 1, 2, 3], [1, 4, 2], [5, 6, 7, 8, 9]
SHINY = Material(gloss=0.5)


@pytest.fixture
def topology():
    """A square and a triangle that share an edge, and a pentagon alone."""
    skin = np.array([QUAD, [*TRIANGLE, TRIANGLE[-1]]])
    return build_topology(10, [("skin", skin, Material()), ("eye", np.array([PENTAGON]), SHINY)])


def mesh_of(topology, colors=None):
    count = topology.vertex_count
    return Mesh(topology, np.zeros((count, 3)), np.zeros((count, 3)) if colors is None else colors)


def test_a_repeated_last_vertex_only_pads(topology):
    assert [topology.polygon(number).tolist() for number in range(3)] == [QUAD, TRIANGLE, PENTAGON]
    assert topology.starts.tolist() == [0, 4, 7, 12]
    assert topology.polygon_count == 3


def test_parts_are_runs_of_polygons(topology):
    assert topology.parts == (Part("skin", 0, 2, Material()), Part("eye", 2, 3, SHINY))
    assert topology.part("eye").material.gloss == 0.5
    assert topology.part_of_polygon.tolist() == [0, 0, 1]
    with pytest.raises(UnknownNameError, match="unknown part 'eyes' — did you mean 'eye'"):
        topology.part("eyes")


def test_corners_know_their_polygon_and_the_next_corner(topology):
    assert topology.polygon_of_corner.tolist() == [0] * 4 + [1] * 3 + [2] * 5
    assert topology.next_corner.tolist() == [1, 2, 3, 0, 5, 6, 4, 8, 9, 10, 11, 7]


def test_polygons_fall_into_fans_of_triangles(topology):
    assert topology.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [1, 4, 2], [5, 6, 7], [5, 7, 8], [5, 8, 9]]
    assert topology.triangle_corners.tolist() == [[0, 1, 2], [0, 2, 3], [4, 5, 6], [7, 8, 9], [7, 9, 10], [7, 10, 11]]
    assert topology.polygon_of_triangle.tolist() == [0, 0, 1, 2, 2, 2]


def test_fans_keep_the_area_of_a_convex_polygon():
    angles = np.arange(7) * 2 * np.pi / 7
    points = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    topology = build_topology(7, [("disc", np.arange(7)[None], Material())])
    a, b, c = (points[topology.triangles[:, k]] for k in range(3))
    area = 0.5 * np.cross(b - a, c - a)[:, 2]
    assert (area > 0).all()
    assert area.sum() == pytest.approx(7 / 2 * np.sin(2 * np.pi / 7))


def test_the_vertices_of_a_part(topology):
    mesh = mesh_of(topology)
    assert mesh.part_vertices("skin").tolist() == [0, 1, 2, 3, 4]
    assert mesh.part_vertices("eye").tolist() == [5, 6, 7, 8, 9]


def test_a_polygon_cannot_name_a_vertex_that_is_not_there():
    with pytest.raises(MienError, match=r"not in 0\.\.2"):
        build_topology(3, [("skin", np.array([[0, 1, 3]]), Material())])
    with pytest.raises(MienError, match=r"not in 0\.\.2"):
        build_topology(3, [("skin", np.array([[0, 1, -1]]), Material())])


@pytest.mark.parametrize(
    "parts",
    [(), (Part("a", 0, 1),), (Part("a", 0, 1), Part("b", 0, 2)), (Part("b", 1, 2), Part("a", 0, 1))],
    ids=["none", "gap", "overlap", "order"],
)
def test_parts_must_cover_the_polygons_in_order(parts):
    corners, starts = np.array([0, 1, 2, 0, 2, 1]), np.array([0, 3, 6])
    with pytest.raises(MienError, match="cover its polygons in order"):
        Topology(3, corners, starts, parts)


def test_colours_belong_to_vertices_or_to_polygons(topology):
    assert not mesh_of(topology).colored_by_polygon
    assert mesh_of(topology, np.zeros((3, 3))).colored_by_polygon
    with pytest.raises(MienError, match=r"colors have shape \(4, 3\), wanted \(10, 3\) or \(3, 3\)"):
        mesh_of(topology, np.zeros((4, 3)))


def test_points_and_normals_must_fit_the_topology(topology):
    with pytest.raises(MienError, match=r"normals have shape \(3,\), wanted \(10, 3\)"):
        Mesh(topology, np.zeros((10, 3)), np.zeros((10, 3)), np.zeros(3))
    with pytest.raises(MienError, match=r"points have shape \(9, 3\), wanted \(10, 3\)"):
        Mesh(topology, np.zeros((9, 3)), np.zeros((10, 3)))


def test_moving_makes_a_new_mesh(topology):
    mesh = mesh_of(topology)
    moved = mesh.moved(mesh.points + 1)
    assert (mesh.points == 0).all()
    assert (moved.points == 1).all()
    assert moved.topology is topology


def test_a_mesh_with_some_of_its_polygons(topology):
    colors = np.arange(9.0).reshape(3, 3) / 10.0
    kept = mesh_of(topology, colors).keeping(np.array([False, True, True]))
    assert [kept.topology.polygon(number).tolist() for number in range(2)] == [TRIANGLE, PENTAGON]
    assert [(part.name, part.first, part.last) for part in kept.topology.parts] == [("skin", 0, 1), ("eye", 1, 2)]
    np.testing.assert_array_equal(kept.colors, colors[1:])
    assert len(kept.points) == 10


def test_a_mesh_without_a_part(topology):
    left = mesh_of(topology).without(["skin"])
    assert [(part.name, part.first, part.last) for part in left.topology.parts] == [("eye", 0, 1)]
    assert left.topology.polygon(0).tolist() == PENTAGON
    assert len(left.colors) == 10
    with pytest.raises(UnknownNameError, match="did you mean 'skin'"):
        mesh_of(topology).without(["skim"])
