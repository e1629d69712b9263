"""Meshes cut into what glTF can hold."""

from __future__ import annotations

import numpy as np
import pytest

from mien.core import Material, Mesh, build_topology
from mien.formats.glb_pieces import MIXED, cut_pieces, describe_material, split_vertices

# Two squares of one part beside one another; the second hangs on nothing of the first.
POINTS = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [3, 0, 0], [3, 1, 0], [2, 1, 0]])
SQUARES = np.array([[0, 1, 2, 3], [4, 5, 6, 7]])
STILL = np.zeros(8, dtype=bool)


def squares(colors: np.ndarray | None = None, **more: object) -> Mesh:
    topology = build_topology(8, [("teeth", SQUARES, Material(**more))])  # type: ignore[arg-type]
    return Mesh(topology, POINTS, np.full((8, 3), 0.5) if colors is None else colors)


def one_each(first: int, second: int) -> np.ndarray:
    """(8, 3) shares: each square goes with one joint."""
    return np.eye(3)[[first] * 4 + [second] * 4]


def test_a_part_is_cut_where_joints_differ() -> None:
    mesh = squares()
    vertices, _ = split_vertices(mesh)
    upper, lower = cut_pieces(mesh.topology, vertices, one_each(1, 2), STILL)
    assert (upper.joint, lower.joint) == (1, 2)
    assert vertices.vertex[upper.rows].tolist() == [0, 1, 2, 3]
    assert vertices.vertex[lower.rows].tolist() == [4, 5, 6, 7]
    assert upper.triangles.tolist() == lower.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]


@pytest.mark.parametrize("why", ["a vertex between joints", "a vertex that a target moves", "a polygon between joints"])
def test_a_part_that_moves_stays_whole(why: str) -> None:
    mesh, shares, moved = squares(), one_each(1, 2), STILL.copy()
    if why == "a vertex between joints":
        shares[0] = 0.5, 0.5, 0.0
    elif why == "a vertex that a target moves":
        moved[7] = True
    else:
        shares[3] = np.eye(3)[2]
    (piece,) = cut_pieces(mesh.topology, split_vertices(mesh)[0], shares, moved)
    assert (piece.joint, len(piece.rows), len(piece.triangles)) == (MIXED, 8, 4)


def test_colours_of_polygons_do_not_bleed() -> None:
    corners = np.array([[0, 1, 2, 3], [1, 4, 5, 2]])
    topology = build_topology(6, [("skin", corners, Material())])
    points = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]])
    vertices, _ = split_vertices(Mesh(topology, points, np.array([[1.0, 0, 0], [0, 0, 1]])))
    assert len(vertices.vertex) == 8  # the shared two come in both colours
    np.testing.assert_array_equal(vertices.color[vertices.of_corner], [0] * 4 + [1] * 4)


def test_flat_parts_have_a_normal_a_polygon() -> None:
    folded = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [1, 0, -1], [1, 1, -1]])
    topology = build_topology(6, [("skin", np.array([[0, 1, 2, 3], [1, 4, 5, 2]]), Material(flat=True))])
    vertices, normals = split_vertices(Mesh(topology, folded, np.full((6, 3), 0.5)))
    assert len(vertices.vertex) == 8
    np.testing.assert_allclose(normals[vertices.normal[vertices.of_corner]], [[0, 0, 1]] * 4 + [[1, 0, 0]] * 4)


def test_materials() -> None:
    # alpha^2 = 2 / (14 + 2) = 1/8: roughness is its fourth root; strength 0.02 * 4 / 8 / 0.04.
    skin = describe_material(Material(gloss=0.02, gloss_power=14), "skin")
    assert skin == {
        "name": "skin",
        "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": pytest.approx(0.125**0.25, abs=1e-6)},
        "extensions": {"KHR_materials_specular": {"specularFactor": pytest.approx(0.25)}},
    }
    assert "extensions" not in describe_material(Material(gloss=0.2, gloss_power=14), "tooth")  # as bright as glTF can
    assert describe_material(Material(two_sided=True), "hair")["doubleSided"] is True
    assert describe_material(Material(lit=False), "spot")["extensions"] == {"KHR_materials_unlit": {}}
