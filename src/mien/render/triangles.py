"""A mesh as triangles on the raster: what both rasterisers, the plain and the fast one, are given."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mien.core import Mesh, Scene, exact

from .camera import Camera
from .clip import clip_polygons, outcodes
from .plan import Plan, plan_shading
from .shade import facing_viewer, polygon_normals
from .values import corner_values
from .wire import edge_ribbons, paper_colors

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Ints32 = NDArray[np.int32]
Bytes = NDArray[np.uint8]
Light = Callable[[Mesh, Floats, Plan, Scene, Ints], tuple[Floats, Ints32]]
Place = Callable[[Floats, Plan, Camera], "Placed"]

ALL_EDGES = 7
"""One bit an edge: from the first corner to the second, and so on."""

HIDDEN, FRONT, BACK = 0, 1, 2
"""What is seen of a triangle that lies wholly in the picture."""


@dataclass(frozen=True, eq=False)
class Triangles:
    """Triangles that are in the picture, in the order in which they win ties of depth.

    Attributes:
        places: (P, 2) 1/256 pixels of the raster, x right and y down.
        inverse: (P,) 1 / depth, 1/m.
        corners: (T, 3) numbers of places.
        values: (S, 3 G) what is interpolated.
        value_of: (T, 3) numbers of values.
        borders: (T,) edges beyond which the surface does not go on as it is seen, one bit each.
    """

    places: Ints32
    inverse: Floats
    corners: Ints32
    values: Floats
    value_of: Ints32
    borders: Bytes

    def followed_by(self, other: Triangles) -> Triangles:
        """These triangles, then others."""
        return Triangles(
            np.concatenate([self.places, other.places]),
            np.concatenate([self.inverse, other.inverse]),
            np.concatenate([self.corners, other.corners + np.int32(len(self.places))]),
            np.concatenate([self.values, other.values]),
            np.concatenate([self.value_of, other.value_of + np.int32(len(self.values))]),
            np.concatenate([self.borders, other.borders]),
        )


@dataclass(frozen=True, eq=False)
class Placed:
    """Points before the camera, and which triangles of a plan are to be drawn.

    Attributes:
        points: (V, 3) m, on their grid.
        view: (V, 3) m, the camera's frame.
        places: (V, 2) 1/256 pixels.
        inverse: (V,) 1 / depth, 1/m.
        drawn: numbers of the triangles that lie in the picture and are seen, then of those that its border cuts.
        corners: (n, 3) vertices of the n that are seen whole.
        borders: (n,) edges of theirs, as in ``Triangles``.
    """

    points: Floats
    view: Floats
    places: Ints32
    inverse: Floats
    drawn: Ints
    corners: Ints32
    borders: Bytes


def place_mesh(points: Floats, plan: Plan, camera: Camera) -> Placed:
    """Where points (V, 3) m fall, and what becomes of the plan's triangles."""
    points = exact.round_points(points)
    view = camera.view(points)
    codes = outcodes(camera, view)
    places, inverse = camera.project(view)
    first, second, third = (codes[row] for row in plan.triangles)
    outside = first | second | third
    sides = np.where(outside == 0, _seen_side(places, plan.triangles, plan.triangle_two_sided), HIDDEN)
    whole = np.flatnonzero(sides)
    beyond = plan.neighbours[whole]
    ends = (beyond < 0) | (sides[beyond] != sides[whole][:, None])
    borders = (ends * np.array([1, 2, 4])).sum(axis=1).astype(np.uint8)
    corners = np.ascontiguousarray(plan.triangles[:, whole].T, dtype=np.int32)
    cut = np.flatnonzero((outside != 0) & ((first & second & third) == 0))
    return Placed(points, view, places, inverse, np.concatenate([whole, cut]), corners, borders)


def make_triangles(
    mesh: Mesh, scene: Scene, camera: Camera, light: Light = corner_values, place: Place = place_mesh
) -> Triangles:
    """The mesh, projected by ``place``, lit by ``light``, clipped, without what turns its back."""
    topology = mesh.topology
    plan = plan_shading(topology, scene.shading in ("polygon", "wire"), mesh.colored_by_polygon)
    if scene.shading == "wire":
        mesh = replace(mesh, colors=paper_colors(mesh.colors))
    placed = place(mesh.points, plan, camera)
    points = placed.points
    values, value_of = light(mesh, points, plan, scene, placed.drawn)
    whole = len(placed.corners)
    result = Triangles(placed.places, placed.inverse, placed.corners, values, value_of[:whole], placed.borders)
    cut = placed.drawn[whole:]
    if len(cut):
        carried = values[value_of[whole:]]
        corner_places = placed.view[plan.triangles[:, cut].T]
        result = result.followed_by(
            _clipped(camera, np.concatenate([corner_places, carried], axis=2), plan.triangle_two_sided[cut])
        )
    if scene.shading == "wire":
        facing = facing_viewer(mesh, points, polygon_normals(points, plan, topology.polygon_count), scene)
        ribbons = edge_ribbons(topology, placed.view, facing, plan, camera)
        result = result.followed_by(Triangles(*ribbons, _all_borders(ribbons[2])))
    return result


def _seen_side(places: Ints32, corners: Ints, two_sided: NDArray[np.bool_]) -> Ints:
    """What is seen of triangles (3, T) that have an area on the raster: front is anticlockwise."""
    x, y = places[:, 0].astype(np.float64), places[:, 1].astype(np.float64)
    ax, ay = x[corners[0]], y[corners[0]]
    # Whole numbers below 2^25: their products are exact.
    area = (x[corners[1]] - ax) * (y[corners[2]] - ay) - (x[corners[2]] - ax) * (y[corners[1]] - ay)
    return np.where(area < 0, FRONT, np.where((area > 0) & two_sided, BACK, HIDDEN))


def _clipped(camera: Camera, corner_values: Floats, two_sided: NDArray[np.bool_]) -> Triangles:
    """Triangles of what is inside the pyramid; values (n, 3, 3 + K) are places in the camera's frame, then the rest."""
    polygons, counts = clip_polygons(camera, corner_values)
    size = polygons.shape[1]
    flat = polygons.reshape(-1, polygons.shape[2])
    places, inverse = camera.project(flat)
    first = np.arange(len(polygons)) * size
    fans = [np.zeros((0, 4), dtype=np.int64)]
    for k in range(1, size - 1):
        rows = np.flatnonzero(counts > k + 1)
        fans.append(np.stack([first[rows], first[rows] + k, first[rows] + k + 1, rows], axis=1))
    fan = np.concatenate(fans)
    fan = fan[np.argsort(fan[:, 3], kind="stable")]
    corners = fan[_seen_side(places, fan[:, :3].T, two_sided[fan[:, 3]]) != HIDDEN, :3].astype(np.int32)
    return Triangles(places, inverse, corners, np.ascontiguousarray(flat[:, 3:]), corners, _all_borders(corners))


def _all_borders(corners: Ints32) -> Bytes:
    return np.full(len(corners), ALL_EDGES, dtype=np.uint8)
