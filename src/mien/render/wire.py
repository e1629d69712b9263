"""Wireframe: the edges of polygons as thin ribbons just before the surface, which hides what lies behind."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from mien.core import Topology

from .camera import SUBPIXELS, Camera
from .clip import clip_segments, outcodes
from .pixels import ONE
from .plan import Plan

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Ints32 = NDArray[np.int32]

LINE_SHARE = 1.0 / 700.0
"""Width of a line as a share of the picture's shorter side, but never less than ``LEAST_PX`` of the raster."""

LEAST_PX = 1.2

LIFT_M = 0.0012
"""How much nearer to the viewer than its polygons an edge is drawn, metres, so that no half of it sinks in."""

INK = (0.012, 0.014, 0.020)
"""Colour of the lines, linear RGB."""

PAPER = 0.72
"""What all colours of the polygons are mixed towards, linear, by the share ``PALENESS``."""

PALENESS = 0.80


def paper_colors(colors: Floats) -> Floats:
    """Colours (n, 3) as the pale tone that lines are drawn on."""
    return colors * (1.0 - PALENESS) + PAPER * PALENESS


@lru_cache(maxsize=16)
def polygon_edges(topology: Topology) -> tuple[Ints, Ints, Ints]:
    """Edges of polygons: (E, 2) vertex numbers, and (C,) edge and (C,) polygon of every corner."""
    pairs = np.stack([topology.corners, topology.corners[topology.next_corner]], axis=1)
    edges, edge = np.unique(np.sort(pairs, axis=1), axis=0, return_inverse=True)
    return edges, edge.reshape(-1), topology.polygon_of_corner


def edge_ribbons(
    topology: Topology, view: Floats, faces_viewer: NDArray[np.bool_], plan: Plan, camera: Camera
) -> tuple[Ints32, Floats, Ints32, Floats, Ints32]:
    """Two triangles for every edge that can be seen, as the fields of ``Triangles``.

    Args:
        topology: whose edges.
        view: (V, 3) points in the camera's frame.
        faces_viewer: (F,) whether a polygon shows its front.
        plan: says which polygons are two-sided.
        camera: whose raster.
    """
    edges, edge, polygon = polygon_edges(topology)
    drawn = np.zeros(len(edges), dtype=bool)
    drawn[edge[(faces_viewer | plan.two_sided)[polygon]]] = True
    codes = outcodes(camera, view)
    edges = edges[drawn & ((codes[edges[:, 0]] & codes[edges[:, 1]]) == 0)]
    starts, ends, left = clip_segments(camera, view[edges[:, 0]], view[edges[:, 1]])
    starts, ends = starts[left], ends[left]

    (a, a_inverse), (b, b_inverse) = camera.project(starts), camera.project(ends)
    way = (b - a).astype(np.float64)
    length = np.sqrt(way[:, 0] * way[:, 0] + way[:, 1] * way[:, 1])
    keep = length > 0.0
    a, b, a_inverse, b_inverse = a[keep], b[keep], a_inverse[keep], b_inverse[keep]
    way, length = way[keep], length[keep]
    half = max(LEAST_PX, min(camera.width, camera.height) * LINE_SHARE) * SUBPIXELS / 2.0
    along = way * (half / length)[:, None]
    aside = np.stack([-along[:, 1], along[:, 0]], axis=1)
    # Ends reach half a width further, so that the ribbons around a vertex leave no notch.
    corners = np.stack([a - along - aside, a - along + aside, b + along + aside, b + along - aside], axis=1)
    lifted = [1.0 / np.maximum(1.0 / inverse - LIFT_M, LIFT_M) for inverse in (a_inverse, b_inverse)]
    inverse = np.stack([lifted[0], lifted[0], lifted[1], lifted[1]], axis=1)
    first = 4 * np.arange(len(a), dtype=np.int32)
    triangles = np.concatenate([first[:, None] + [0, 1, 2], first[:, None] + [0, 2, 3]]).astype(np.int32)
    return (
        np.rint(corners).astype(np.int32).reshape(-1, 2),
        inverse.reshape(-1),
        triangles,
        np.array([INK]) * ONE,
        np.zeros_like(triangles),
    )
