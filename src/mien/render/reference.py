"""The plain rasteriser: one triangle after the other, in NumPy, to be read and believed. The fast one must equal it.

A pixel belongs to a triangle when its centre lies inside; a centre on an edge belongs to the triangle whose left or
top edge it is, so that neighbours share every centre out among them. Source: Pineda 1988 (edge functions).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .camera import SUBPIXELS
from .triangles import Triangles

Floats32 = NDArray[np.float32]
Ints = NDArray[np.int64]


def rasterise(triangles: Triangles, width: int, height: int) -> tuple[Floats32, NDArray[np.bool_]]:
    """(H, W, 3) linear samples, and (H, W) which of them a triangle covers; the nearest triangle wins."""
    depth = np.zeros((height, width), dtype=np.float32)
    samples = np.zeros((height, width, 3), dtype=np.float32)
    for corners, color_of in zip(triangles.corners, triangles.color_of, strict=True):
        _draw(
            triangles.places[corners].astype(np.int64),
            triangles.inverse[corners],
            triangles.colors[color_of],
            depth,
            samples,
        )
    return samples, depth > 0.0


def coverage(places: Ints, width: int, height: int) -> tuple[slice, slice, NDArray[np.bool_]]:
    """Rows and columns around a triangle (3, 2), 1/256 pixels, and which centres in them it covers."""
    low = np.maximum(-(-(places.min(axis=0) - SUBPIXELS // 2) // SUBPIXELS), 0)
    high = np.minimum((places.max(axis=0) - SUBPIXELS // 2) // SUBPIXELS + 1, (width, height))
    columns, rows = slice(low[0], max(high[0], low[0])), slice(low[1], max(high[1], low[1]))
    x = np.arange(columns.start, columns.stop) * SUBPIXELS + SUBPIXELS // 2
    y = (np.arange(rows.start, rows.stop) * SUBPIXELS + SUBPIXELS // 2)[:, None]
    (ax, ay), (bx, by), (cx, cy) = places
    ring = places if (bx - ax) * (cy - ay) - (cx - ax) * (by - ay) > 0 else places[::-1]
    covered = np.ones((y.shape[0], x.shape[0]), dtype=bool)
    for (px, py), (qx, qy) in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        side = (qx - px) * (y - py) - (qy - py) * (x - px)
        # Clockwise on a screen whose y runs down: left edges go up, top edges go right.
        owned = qy < py or (qy == py and qx > px)
        covered &= (side >= 0) if owned else (side > 0)
    return rows, columns, covered


def _draw(
    places: Ints,
    inverse: NDArray[np.float64],
    colors: NDArray[np.float64],
    depth: Floats32,
    samples: Floats32,
) -> None:
    height, width = depth.shape
    rows, columns, covered = coverage(places, width, height)
    drawn = covered.any(axis=1)
    if not drawn.any():
        return
    first = covered.argmax(axis=1)
    centre_y = np.arange(rows.start, rows.stop) * SUBPIXELS + SUBPIXELS // 2
    centre_x = (columns.start + first) * SUBPIXELS + SUBPIXELS // 2
    steps = (np.arange(covered.shape[1]) - first[:, None]).astype(np.float32)
    # Colour over depth is linear on the screen, colour is not: perspective-correct. Source: Blinn 1992.
    values = [inverse, *(colors[:, c] * inverse for c in range(3))]
    (ax, ay), (bx, by), (cx, cy) = places.astype(np.float64)
    area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
    planes = []
    for at_a, at_b, at_c in values:
        along, across = at_b - at_a, at_c - at_a
        slope_x = (along * (cy - ay) - across * (by - ay)) / area
        slope_y = (across * (bx - ax) - along * (cx - ax)) / area
        start = (at_a + slope_y * (centre_y - ay)) + slope_x * (centre_x - ax)
        planes.append(start.astype(np.float32)[:, None] + np.float32(slope_x * SUBPIXELS) * steps)
    near = covered & (planes[0] > depth[rows, columns])
    depth[rows, columns][near] = planes[0][near]
    scale = np.float32(1.0) / planes[0][near]
    for c in range(3):
        samples[rows, columns, c][near] = planes[c + 1][near] * scale
