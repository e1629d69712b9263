"""Meshes as bytes: in the setup how a cage becomes a surface, in each frame the cage and what else has changed."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.core import Mesh, MienError, Scene, Topology
from mien.core.sparse import SparseMatrix
from mien.core.subdivision import Refinement, refine
from mien.render.pixels import to_srgb
from mien.render.plan import plan_shading
from mien.render.shade import own_normals

from .quantising import Steps

Ints = NDArray[np.int64]
Arrays = Mapping[str, NDArray[Any]]

COUNTS = struct.Struct("<f5I")
"""Step, 0 for a mesh, points, normals, runs of changed colours, colours in them."""

MOST_COLORS = 1 << 16
"""A run begins at a number of sixteen bits."""

LIVELY = 0.25
"""Colours of a larger share of places than this belong into a setup, once they do not change from frame to frame."""


class MeshFrames:
    """Setup and frames of meshes of one topology; whose colours stay, mostly, those of the first."""

    def __init__(self, mesh: Mesh, scene: Scene) -> None:
        self._topology, self._scene = mesh.topology, scene
        self._surface = describe_surface(mesh.topology, scene, mesh.colored_by_polygon)
        self._steps = Steps((mesh.points.min(axis=0) + mesh.points.max(axis=0)) * 0.5)
        self._given, self._sent = mesh.colors, self._surface.tint(mesh.colors)
        if len(self._sent) > MOST_COLORS:
            raise MienError(f"a mesh of {len(self._sent)} colours cannot be sent — at most {MOST_COLORS} can")
        self._colors = self._last = self._sent
        self._codes = to_srgb(self._colors)

    def describe(self) -> dict[str, Any]:
        """Camera, light and parts."""
        return {"shape": "mesh", **describe_scene(self._scene), "middle": self._steps.middle.tolist()} | {
            "parts": self._surface.parts,
            "colored_by": "polygon" if self._surface.colored_by_polygon else "vertex",
            "points": self._topology.vertex_count,
            "refined_points": self._surface.refined_points,
        }

    def arrays(self) -> Arrays:
        """What makes a surface of a cage, and colours."""
        return {**self._surface.arrays, "colors": self._codes}

    def encode(self, mesh: Mesh) -> bytes | None:
        """Step, counts, points, runs of changed colours, normals of round parts, changed colours.

        None where the topology is another one, or the colours are other ones for good.
        """
        if mesh.topology is not self._topology or len(mesh.colors) != len(self._given):
            return None
        if mesh.colors is not self._given:
            self._given, self._sent = mesh.colors, self._surface.tint(mesh.colors)
        colors, last = self._sent, self._last
        self._last = colors
        changed, most = _find_differing(colors, self._colors), LIVELY * len(colors)
        if len(changed) > most and len(_find_differing(colors, last)) <= most:
            return None
        codes = to_srgb(colors[changed])
        seen = (codes != self._codes[changed]).any(axis=1)
        changed, codes = changed[seen], codes[seen]
        points, runs = self._steps.encode(mesh.points), _find_runs(changed)
        vertices = self._surface.round_vertices
        normals = own_normals(mesh)[vertices] if len(vertices) else np.zeros((0, 3))
        if not np.isfinite(normals).all():
            raise MienError("a face to be sent has a normal that is not a finite number")
        counts = COUNTS.pack(self._steps.step, 0, len(points), len(normals), len(runs), len(codes))
        rounded = np.rint(normals * 127.0).astype(np.int8)
        return b"".join((counts, points.tobytes(), runs.tobytes(), rounded.tobytes(), codes.tobytes()))


def _find_differing(colors: NDArray[np.float64], others: NDArray[np.float64]) -> Ints:
    """Numbers of those that differ.

    Raises:
        MienError: one of them is not a finite number.
    """
    if colors is others:
        return np.zeros(0, dtype=np.int64)
    channels = colors != others
    differing = np.flatnonzero(channels[:, 0] | channels[:, 1] | channels[:, 2])
    if not np.isfinite(colors[differing]).all():
        raise MienError("a face to be sent has a colour that is not a finite number")
    return differing


def _find_runs(numbers: Ints) -> NDArray[np.uint16]:
    """(R, 2) first number and how many follow one another, of ascending numbers."""
    first = np.flatnonzero(np.diff(numbers, prepend=-2) != 1)
    lengths = np.diff(first, append=len(numbers))
    return np.stack([numbers[first], lengths], axis=1).astype("<u2")


def describe_scene(scene: Scene) -> dict[str, Any]:
    """Camera, lamps, ambient light and background as JSON."""
    return {
        "camera": {"position": scene.position, "at": scene.at, "fov_deg": scene.fov_deg},
        "background": scene.behind(),
        "lamps": [{"position": lamp.position, "color": lamp.color, "wrap": lamp.wrap} for lamp in scene.lamps],
        "lamps_follow": not scene.lights,
        "ambient": scene.ambient,
        "cosine_power": scene.cosine_power,
    }


@dataclass(frozen=True, eq=False)
class Surface:
    """What a viewer does with every cage, and what the parts of the surface are made of.

    Attributes:
        parts: rows for JSON, in the order of drawing.
        arrays: for the viewer; docs/frames.md says of what.
        refined_points: of the surface.
        round_vertices: (Q,) vertices of the cage whose normals are sent.
        colored_by_polygon: whether a colour belongs to a polygon of the cage, not to a vertex.
        tinted: the steps of subdivision in which colours flow into one another, so that those of the surface's
            polygons are sent; none where those of the cage are.
    """

    parts: list[dict[str, Any]]
    arrays: Arrays
    refined_points: int
    round_vertices: Ints
    colored_by_polygon: bool
    tinted: tuple[Refinement, ...] = ()

    def tint(self, colors: NDArray[np.float64]) -> NDArray[np.float64]:
        """(N, 3) the colours that are sent."""
        for step in self.tinted:
            colors = step.tint(colors)
        return colors


def describe_surface(topology: Topology, scene: Scene, colored_by_polygon: bool) -> Surface:
    """The surface that subdivision makes of a topology, as ``render.plan`` lights it."""
    return _describe(topology, scene.subdivide, scene.shading == "polygon", scene.gloss, colored_by_polygon)


# Other colours make another setup, of the same surface; to describe it takes longer than many loops.
@lru_cache(maxsize=4)
def _describe(topology: Topology, subdivide: int, flat: bool, gloss: float, colored_by_polygon: bool) -> Surface:
    fine, matrix, parents, steps = _refine(topology, subdivide)
    tinted = steps if colored_by_polygon and topology.tints is not None else ()
    plan = plan_shading(fine, flat, colored_by_polygon)
    corner_point, corner_node = plan.triangles.T, plan.triangle_front.astype(np.int64)
    polygon = fine.polygon_of_triangle[:, None]
    if colored_by_polygon:
        color = np.broadcast_to(polygon if tinted else parents[polygon], corner_point.shape)
    else:
        # Colours of a flat polygon are the mean of its corners': it is named by a number below 0.
        color = np.where(plan.polygon[corner_node] >= 0, -1 - polygon, corner_point)
    lowest = int(color.min(initial=0))
    span = int(color.max(initial=0)) - lowest + 1
    key = (corner_point * len(plan.vertex) + corner_node) * span + (color - lowest)
    _, first, triangles = np.unique(key, return_index=True, return_inverse=True)
    rows, starts, columns, weights = matrix.mixed
    sums = plan.normal_sum
    arrays = {
        "matrix_rows": rows,
        "matrix_starts": starts,
        "matrix_columns": columns,
        "matrix_weights": weights.astype(np.float32),
        "polygon_starts": fine.starts,
        "polygon_corners": fine.corners,
        "node_starts": sums.starts,
        "node_polygons": sums.columns,
        "round_nodes": plan.round,
        "vertex_points": corner_point.ravel()[first],
        "vertex_nodes": corner_node.ravel()[first],
        "vertex_colors": color.ravel()[first].astype(np.int32),
        "triangles": triangles.reshape(-1),
    }
    small = {name: _smallest(array) for name, array in arrays.items()}
    vertices = plan.vertex[plan.round]
    return Surface(_parts(fine, gloss), small, fine.vertex_count, vertices, colored_by_polygon, tinted)


def _refine(topology: Topology, levels: int) -> tuple[Topology, SparseMatrix, Ints, tuple[Refinement, ...]]:
    """The finer topology, one matrix (V', V) of all steps, the first polygon (F',) that each comes from; the steps."""
    count = topology.vertex_count
    every = np.arange(count)
    matrix = SparseMatrix.from_entries(every, every, np.ones(count), (count, count))
    parents = np.arange(topology.polygon_count)
    steps = []
    for _ in range(levels):
        steps.append(refine(topology))
        topology, parents = steps[-1].topology, parents[steps[-1].polygon_parent]
        matrix = steps[-1].matrix.after(matrix)
    return topology, matrix, parents, tuple(steps)


def _parts(topology: Topology, gloss: float) -> list[dict[str, Any]]:
    """Name, material and run of triangles of every part; ``gloss`` is a factor on all highlights."""
    ends = np.concatenate([[0], np.cumsum(np.diff(topology.starts) - 2)])
    return [
        {
            "name": part.name,
            "first": int(ends[part.first]),
            "count": int(ends[part.last] - ends[part.first]),
            "gloss": part.material.gloss * gloss,
            "power": part.material.gloss_power,
            "lit": part.material.lit,
            "two_sided": part.material.two_sided,
        }
        for part in topology.parts
    ]


def _smallest(array: NDArray[Any]) -> NDArray[Any]:
    """The same whole numbers from 0 in 16 or 32 bits; others as they are."""
    if array.dtype.kind == "f" or array.dtype == np.int32:
        return array
    return array.astype(np.uint16 if array.max(initial=0) < 1 << 16 else np.uint32)
