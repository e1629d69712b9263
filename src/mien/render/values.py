"""What the corners of triangles carry: light for smooth pictures, the surface itself for light on every pixel.

Values are in the units of samples: see ``pixels``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mien.core import Mesh, Scene

from .pixels import ONE, POWER_STEP, WHOLE
from .plan import Plan
from .shade import (
    Shades,
    facing_viewer,
    light_mesh,
    node_colors,
    polygon_normals,
    shade_normals,
)

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Ints32 = NDArray[np.int32]


def corner_values(mesh: Mesh, points: Floats, plan: Plan, scene: Scene, triangles: Ints) -> tuple[Floats, Ints32]:
    """A list of values (S, 3) or (S, 9), and which of them each corner of these triangles (n,) has, (n, 3).

    Three are linear RGB as it is seen; nine are what ``pixels.light_samples`` makes it of, in groups of three.
    """
    if scene.shading == "smooth+":
        return surface_values(mesh, points, plan, scene, triangles)
    shades = light_mesh(mesh, points, plan, scene)
    shade_of = choose_shades(mesh, plan, shades.faces_viewer, triangles)
    if mesh.colored_by_polygon:
        return seen_colors_of_polygons(mesh, shades, shade_of, triangles), every_corner(triangles)
    return (node_colors(mesh, plan) * shades.diffuse + shades.highlight) * ONE, shade_of


def choose_shades(mesh: Mesh, plan: Plan, faces_viewer: NDArray[np.bool_], triangles: Ints) -> Ints32:
    """(n, 3) number of the shade that each corner has, of the side that is seen."""
    shade_of = plan.triangle_front[triangles]
    if len(plan.back):
        behind = np.flatnonzero(~faces_viewer[mesh.topology.polygon_of_triangle[triangles]])
        shade_of[behind] = plan.triangle_back[triangles[behind]]
    return shade_of


def seen_colors_of_polygons(mesh: Mesh, shades: Shades, shade_of: Ints32, triangles: Ints) -> Floats:
    """(3 n, 3) colours of all corners of triangles where a colour belongs to a polygon."""
    own = mesh.colors[mesh.topology.polygon_of_triangle[triangles]][:, None, :]
    colors = own * shades.diffuse[shade_of] + shades.highlight[shade_of]
    return colors.reshape(-1, 3) * ONE


def surface_values(mesh: Mesh, points: Floats, plan: Plan, scene: Scene, triangles: Ints) -> tuple[Floats, Ints32]:
    """The same for light on every pixel: own colour; normal; gloss, its power, whether light falls on it."""
    normals = polygon_normals(points, plan, mesh.topology.polygon_count)
    shade_of = choose_shades(mesh, plan, facing_viewer(mesh, points, normals, scene), triangles)
    directions = np.stack(shade_normals(mesh, normals, plan), axis=1)
    material = np.stack([plan.gloss * WHOLE, plan.power * POWER_STEP, plan.lit * WHOLE], axis=1)
    surface = np.concatenate([(directions + 1.0) * (0.5 * WHOLE), material], axis=1)
    if not mesh.colored_by_polygon:
        return np.concatenate([node_colors(mesh, plan) * ONE, surface], axis=1), shade_of
    own = np.repeat(mesh.colors[mesh.topology.polygon_of_triangle[triangles]] * ONE, 3, axis=0)
    return np.concatenate([own, surface[shade_of.reshape(-1)]], axis=1), every_corner(triangles)


def every_corner(triangles: Ints) -> Ints32:
    """(n, 3) number of the value that each corner has where all have their own."""
    return np.arange(3 * len(triangles), dtype=np.int32).reshape(-1, 3)
