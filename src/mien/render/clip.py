"""Polygons and edges clipped to the viewing pyramid and its near plane, many at a time.

Source: Sutherland and Hodgman 1974, reentrant polygon clipping: one plane after the other.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .camera import NEAR_M, Camera

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

PLANES = 5
"""Near, left, right, bottom, top: the near plane first, so that the others only meet what lies before the viewer."""


def plane_distance(camera: Camera, view: Floats, plane: int) -> Floats:
    """Signed distance, up to a factor, of points (..., 3+) of the camera's frame from a plane; inside is >= 0."""
    x, y, z = view[..., 0], view[..., 1], view[..., 2]
    if plane == 0:
        return z - NEAR_M
    across, side = (x, camera.width) if plane < 3 else (y, camera.height)
    sign = camera.scale if plane in (1, 3) else -camera.scale
    return z * (side * 0.5) + across * sign


def outcodes(camera: Camera, view: Floats) -> NDArray[np.uint8]:
    """(V,) one bit for each plane that a point lies outside of."""
    codes = np.zeros(len(view), dtype=np.uint8)
    for plane in range(PLANES):
        codes |= (plane_distance(camera, view, plane) < 0.0).astype(np.uint8) << np.uint8(plane)
    return codes


def clip_polygons(camera: Camera, polygons: Floats) -> tuple[Floats, Ints]:
    """Convex polygons inside the pyramid: (n, m, K) padded corners and (n,) how many of them count.

    Args:
        camera: whose pyramid it is.
        polygons: (n, m, K) corners: the camera's frame first, then whatever else is interpolated along the edges.
    """
    counts = np.full(len(polygons), polygons.shape[1], dtype=np.int64)
    for plane in range(PLANES):
        polygons, counts = _clip_by(camera, polygons, counts, plane)
    return polygons, counts


def _clip_by(camera: Camera, polygons: Floats, counts: Ints, plane: int) -> tuple[Floats, Ints]:
    number, size, width = polygons.shape
    slots = np.arange(size)
    used = slots[None, :] < counts[:, None]
    following = np.where(slots[None, :] + 1 < counts[:, None], slots[None, :] + 1, 0)
    ends = np.take_along_axis(polygons, following[:, :, None], axis=1)
    here = plane_distance(camera, polygons, plane)
    there = np.take_along_axis(here, following, axis=1)
    inside = here >= 0.0
    crossing = (inside != (there >= 0.0)) & used
    # Every neighbour must find the same point on a shared edge: always from its inner end to its outer one.
    inner, outer = np.where(inside, here, there), np.where(inside, there, here)
    share = inner / np.where(crossing, inner - outer, 1.0)
    first = np.where(inside[:, :, None], polygons, ends)
    last = np.where(inside[:, :, None], ends, polygons)
    cut = first + (last - first) * share[:, :, None]

    emitted = np.stack([inside & used, crossing], axis=2).reshape(number, 2 * size)
    candidates = np.stack([polygons, cut], axis=2).reshape(number, 2 * size, width)
    slot = np.cumsum(emitted, axis=1) - 1
    out = np.zeros((number, size + 1, width))
    rows, columns = np.nonzero(emitted)
    out[rows, slot[rows, columns]] = candidates[rows, columns]
    return out, emitted.sum(axis=1)


def clip_segments(camera: Camera, starts: Floats, ends: Floats) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """Straight edges inside the pyramid: their ends (n, 3) each, and (n,) whether anything is left of them."""
    left = np.ones(len(starts), dtype=bool)
    for plane in range(PLANES):
        a, b = plane_distance(camera, starts, plane), plane_distance(camera, ends, plane)
        left &= (a >= 0.0) | (b >= 0.0)
        apart = np.where((a < 0.0) != (b < 0.0), a - b, 1.0)
        cut = starts + (ends - starts) * (a / apart)[:, None]
        starts, ends = (
            np.where(((a < 0.0) & (b >= 0.0))[:, None], cut, starts),
            np.where(((b < 0.0) & (a >= 0.0))[:, None], cut, ends),
        )
    return starts, ends, left
