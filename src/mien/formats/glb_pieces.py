"""A mesh cut into what glTF can hold: vertices with one normal and one colour, triangles of one material and joint."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.core import Material, Mesh, Part, Topology
from mien.core.mesh import Ints

from .obj import corner_normals

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

MIXED = -1
"""In the place of a joint: several joints, or morph targets, move the piece."""

REFLECTANCE = 0.04
"""What a surface of glTF mirrors of light from straight ahead."""


@dataclass(frozen=True, eq=False)
class Vertices:
    """The N vertices of a mesh as glTF has them.

    Attributes:
        vertex: (N,) vertex of the mesh.
        normal: (N,) row of the normals that ``corner_normals`` gives.
        color: (N,) row of the mesh's colours.
        of_corner: (C,) which of them each corner of a polygon is.
    """

    vertex: Ints
    normal: Ints
    color: Ints
    of_corner: Ints


@dataclass(frozen=True, eq=False)
class Piece:
    """Triangles of one part that one joint moves.

    Attributes:
        part: of the mesh.
        joint: number of the joint, or ``MIXED``.
        rows: (N,) vertices, of those of the whole mesh.
        triangles: (T, 3) numbers in ``rows``.
    """

    part: Part
    joint: int
    rows: Ints
    triangles: Ints


def split_vertices(mesh: Mesh) -> tuple[Vertices, Floats]:
    """The vertices of a mesh, each with one normal and one colour, and the normals (M, 3)."""
    topology = mesh.topology
    normals, normal_of = corner_normals(mesh)
    color = topology.polygon_of_corner if mesh.colored_by_polygon else topology.corners
    key = (topology.corners * len(normals) + normal_of) * len(mesh.colors) + color
    _, first, of_corner = np.unique(key, return_index=True, return_inverse=True)
    return Vertices(topology.corners[first], normal_of[first], color[first], of_corner.reshape(-1)), normals


def cut_pieces(topology: Topology, vertices: Vertices, shares: Floats, moved: Flags) -> list[Piece]:
    """The pieces of a mesh, part after part.

    Args:
        topology: of the mesh.
        vertices: of it.
        shares: (V, J) how much of each of its vertices goes with each joint.
        moved: (V,) which of them a morph target moves.
    """
    joint = np.where((shares.max(axis=1) == 1.0) & ~moved, shares.argmax(axis=1), MIXED)[topology.corners]
    triangles = vertices.of_corner[topology.triangle_corners]
    owner = topology.part_of_polygon[topology.polygon_of_triangle]
    joints = joint[topology.triangle_corners]
    one = np.where((joints == joints[:, :1]).all(axis=1), joints[:, 0], MIXED)
    pieces = []
    for number, part in enumerate(topology.parts):
        inside = owner == number
        # A part stays in one piece rather than tear where one joint takes over from another.
        whole = bool((one[inside] == MIXED).any())
        for joint_number in [MIXED] if whole else np.unique(one[inside]).tolist():
            chosen = triangles[inside & (whole | (one == joint_number))]
            rows, local = np.unique(chosen, return_inverse=True)
            pieces.append(Piece(part, joint_number, rows, local.reshape(-1, 3)))
    return pieces


def describe_material(material: Material, name: str) -> dict[str, object]:
    """A glTF material that takes the light as one of ours does; the colour comes with the vertices.

    Roughness is that of a lobe as wide as the power of our highlight, and the strength is chosen so that it is as
    bright beside the diffuse light: ``gloss = strength F / (4 alpha^2)`` with ``alpha = roughness^2``.

    Source: Walter et al. 2007 (alpha^2 = 2 / (power + 2)); Khronos, KHR_materials_specular and KHR_materials_unlit.
    """
    alpha_squared = 2.0 / (material.gloss_power + 2.0)
    strength = min(material.gloss * 4.0 * alpha_squared / REFLECTANCE, 1.0)
    out: dict[str, object] = {
        "name": name,
        "pbrMetallicRoughness": {
            "metallicFactor": 0.0,
            "roughnessFactor": round(float(np.sqrt(np.sqrt(alpha_squared))), 6),
        },
    }
    if material.two_sided:
        out["doubleSided"] = True
    if not material.lit:
        out["extensions"] = {"KHR_materials_unlit": {}}
    elif strength < 1.0:
        out["extensions"] = {"KHR_materials_specular": {"specularFactor": round(strength, 6)}}
    return out
