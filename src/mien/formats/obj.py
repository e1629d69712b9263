"""Meshes as Wavefront OBJ: points with colours, normals, polygons as they are, one group a part.

Colours follow the points, ``v x y z r g b``. That is an extension, but a common one (MeshLab, ZBrush, Blender); Blender
takes such colours as sRGB, and so they are.

Source: Wavefront Technologies, Advanced Visualizer manual, appendix B1 (object files); P. Bourke 2020 (colours).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mien.core import Mesh, MienError
from mien.render.pixels import to_srgb
from mien.render.plan import plan_shading
from mien.render.shade import own_normals, polygon_normals

from .atomic import writing
from .numbers import format_number

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

FRAME = "Metres; x to the face's own left, y up, z forward out of the face. Colours: sRGB after the coordinates."


@dataclass(frozen=True, eq=False)
class Model:
    """A posed mesh that can be written.

    Attributes:
        mesh: points, polygons, colours, as they are.
        notes: text that goes into the file: what made it, which face.
    """

    mesh: Mesh
    notes: Mapping[str, str] = field(default_factory=dict)

    def write(self, path: Path | str) -> None:
        """Writes an OBJ file.

        Raises:
            MienError: the place cannot be written, or a number of the mesh is not finite.
        """
        text = self.to_obj()
        with writing(path) as temporary:
            temporary.write_text(text, encoding="utf-8", newline="\n")

    def to_obj(self) -> str:
        """The text of an OBJ file; the same mesh has the same text."""
        mesh = self.mesh
        if not (np.isfinite(mesh.points).all() and np.isfinite(mesh.colors).all()):
            raise MienError("a mesh to be written has a point or a colour that is not a finite number")
        vertices, codes, vertex_of = colored_vertices(mesh)
        normals, normal_of = corner_normals(mesh)
        lines = [f"# {key}: {' '.join(value.split())}" for key, value in self.notes.items()]
        lines.append(f"# {FRAME}")
        for place, color in zip(mesh.points[vertices].tolist(), (codes / 255.0).tolist(), strict=True):
            lines.append(f"v {_numbers(place, 6)} {_numbers(color, 4)}")
        lines += [f"vn {_numbers(normal, 4)}" for normal in normals.tolist()]
        lines += _groups(mesh, vertex_of, normal_of)
        return "\n".join([*lines, ""])


def colored_vertices(mesh: Mesh) -> tuple[Ints, NDArray[np.uint8], Ints]:
    """(n,) vertices and (n, 3) their sRGB codes, and (C,) which of them each corner has.

    A vertex at which polygons of several colours meet comes once for each colour.
    """
    corners = mesh.topology.corners
    colored = mesh.topology.polygon_of_corner if mesh.colored_by_polygon else corners
    codes = to_srgb(mesh.colors.astype(np.float32))
    red, green, blue = (codes[colored, k].astype(np.int64) for k in range(3))
    key = ((corners * 256 + red) * 256 + green) * 256 + blue
    _, first, vertex_of = np.unique(key, return_index=True, return_inverse=True)
    return corners[first], codes[colored[first]], vertex_of.reshape(-1)


def corner_normals(mesh: Mesh) -> tuple[Floats, Ints]:
    """(N, 3) unit normals and (C,) which of them each corner has: those that the picture is lit with."""
    topology = mesh.topology
    plan = plan_shading(topology, False)
    normals = plan.normal_sum.apply(polygon_normals(mesh.points, plan, topology.polygon_count))
    if len(plan.round):
        normals[plan.round] = own_normals(mesh)[plan.vertex[plan.round]]
    x, y, z = normals.T
    length = np.sqrt((x * x + y * y) + z * z)
    normals[length == 0.0] = (0.0, 0.0, 1.0)  # of polygons without area; readers divide by the length
    normal_of = np.zeros(len(topology.corners), dtype=np.int64)
    normal_of[topology.triangle_corners] = plan.triangle_front
    return normals / np.where(length == 0.0, 1.0, length)[:, None], normal_of


def _groups(mesh: Mesh, vertex_of: Ints, normal_of: Ints) -> Iterator[str]:
    topology = mesh.topology
    corners = [f"{v + 1}//{n + 1}" for v, n in zip(vertex_of.tolist(), normal_of.tolist(), strict=True)]
    starts = topology.starts.tolist()
    for part in topology.parts:
        yield f"g {'_'.join(part.name.split())}"
        for polygon in range(part.first, part.last):
            around = corners[starts[polygon] : starts[polygon + 1]]
            if len(around) >= 3:
                yield f"f {' '.join(around)}"


def _numbers(values: list[float], decimals: int) -> str:
    return " ".join(format_number(value, decimals) for value in values)
