"""A lit mesh as triangles on the raster: what both rasterisers, the plain and the fast one, are given."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.core import Mesh, Scene, exact

from .camera import Camera
from .clip import clip_polygons, outcodes
from .plan import Plan, plan_shading
from .shade import Shades, light_mesh, polygon_means
from .wire import edge_ribbons, paper_colors

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Ints32 = NDArray[np.int32]
Light = Callable[[Mesh, Floats, Plan, Scene], Shades]
Place = Callable[[Floats, Plan, Camera], "Placed"]


@dataclass(frozen=True, eq=False)
class Triangles:
    """Triangles that are in the picture, in the order in which they win ties of depth.

    Attributes:
        places: (P, 2) 1/256 pixels of the raster, x right and y down.
        inverse: (P,) 1 / depth, 1/m.
        corners: (T, 3) numbers of places.
        colors: (S, 3) linear RGB.
        color_of: (T, 3) numbers of colours.
    """

    places: Ints32
    inverse: Floats
    corners: Ints32
    colors: Floats
    color_of: Ints32

    def followed_by(self, other: Triangles) -> Triangles:
        """These triangles, then others."""
        return Triangles(
            np.concatenate([self.places, other.places]),
            np.concatenate([self.inverse, other.inverse]),
            np.concatenate([self.corners, other.corners + np.int32(len(self.places))]),
            np.concatenate([self.colors, other.colors]),
            np.concatenate([self.color_of, other.color_of + np.int32(len(self.colors))]),
        )


@dataclass(frozen=True, eq=False)
class Placed:
    """Points before the camera, and which triangles of a plan are to be drawn.

    Attributes:
        view: (V, 3) m, the camera's frame.
        places: (V, 2) 1/256 pixels.
        inverse: (V,) 1 / depth, 1/m.
        whole: numbers of the triangles that lie in the picture and are seen.
        corners: (n, 3) their vertices.
        cut: numbers of the triangles that the picture's border cuts.
    """

    view: Floats
    places: Ints32
    inverse: Floats
    whole: Ints
    corners: Ints32
    cut: Ints


def place_mesh(points: Floats, plan: Plan, camera: Camera) -> Placed:
    """Where points (V, 3) m fall, and what becomes of the plan's triangles."""
    view = camera.view(points)
    codes = outcodes(camera, view)
    places, inverse = camera.project(view)
    first, second, third = (codes[row] for row in plan.triangles)
    outside = first | second | third
    whole = np.flatnonzero((outside == 0) & _is_seen(places, plan.triangles, plan.triangle_two_sided))
    corners = np.ascontiguousarray(plan.triangles[:, whole].T, dtype=np.int32)
    cut = np.flatnonzero((outside != 0) & ((first & second & third) == 0))
    return Placed(view, places, inverse, whole, corners, cut)


def make_triangles(
    mesh: Mesh, scene: Scene, camera: Camera, light: Light = light_mesh, place: Place = place_mesh
) -> Triangles:
    """The mesh, lit by ``light``, projected by ``place``, clipped, without what turns its back."""
    topology = mesh.topology
    points = exact.round_points(mesh.points)
    plan = plan_shading(topology, scene.shading != "smooth")
    if scene.shading == "wire":
        mesh = Mesh(topology, mesh.points, paper_colors(mesh.colors), mesh.normals)
    shades = light(mesh, points, plan, scene)
    placed = place(points, plan, camera)
    view, cut = placed.view, placed.cut
    colors, color_of = _corner_colors(mesh, plan, shades, placed.whole)
    result = Triangles(placed.places, placed.inverse, placed.corners, colors, color_of)
    if len(cut):
        colors, color_of = _corner_colors(mesh, plan, shades, cut)
        corner_values = np.concatenate([view[plan.triangles[:, cut].T], colors[color_of]], axis=2)
        result = result.followed_by(_clipped(camera, corner_values, plan.triangle_two_sided[cut]))
    if scene.shading == "wire":
        result = result.followed_by(Triangles(*edge_ribbons(topology, view, shades.faces_viewer, plan, camera)))
    return result


def _is_seen(places: Ints32, corners: Ints, two_sided: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Whether triangles (3, T) have an area on the raster and show their front, anticlockwise, or may show both."""
    x, y = places[:, 0].astype(np.float64), places[:, 1].astype(np.float64)
    ax, ay = x[corners[0]], y[corners[0]]
    # Whole numbers below 2^25: their products are exact.
    area = (x[corners[1]] - ax) * (y[corners[2]] - ay) - (x[corners[2]] - ax) * (y[corners[1]] - ay)
    seen: NDArray[np.bool_] = (area < 0) | ((area > 0) & two_sided)
    return seen


def _corner_colors(mesh: Mesh, plan: Plan, shades: Shades, triangles: Ints) -> tuple[Floats, Ints32]:
    """A list of colours, and which of them each corner of these triangles (n,) has, (n, 3)."""
    polygon = mesh.topology.polygon_of_triangle[triangles]
    shade_of = plan.triangle_front[triangles]
    if len(plan.back):
        behind = np.flatnonzero(~shades.faces_viewer[polygon])
        shade_of[behind] = plan.triangle_back[triangles[behind]]
    if mesh.colored_by_polygon:
        own = mesh.colors[polygon][:, None, :]
        colors = own * shades.diffuse[shade_of] + shades.highlight[shade_of]
        return colors.reshape(-1, 3), np.arange(3 * len(triangles), dtype=np.int32).reshape(-1, 3)
    own = mesh.colors[plan.vertex]
    in_polygons = np.flatnonzero(plan.vertex < 0)
    if len(in_polygons):
        own[in_polygons] = polygon_means(mesh.colors, plan, mesh)[plan.polygon[in_polygons]]
    own = np.concatenate([own, own[plan.back]])
    return own * shades.diffuse + shades.highlight, shade_of


def _clipped(camera: Camera, corner_values: Floats, two_sided: NDArray[np.bool_]) -> Triangles:
    """Triangles of what is inside the pyramid; values (n, 3, 6) are places in the camera's frame, then colours."""
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
    corners = fan[_is_seen(places, fan[:, :3].T, two_sided[fan[:, 3]]), :3].astype(np.int32)
    return Triangles(places, inverse, corners, np.ascontiguousarray(flat[:, 3:]), corners)
