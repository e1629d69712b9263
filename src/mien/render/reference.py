"""The plain rasteriser: one triangle after the other, in NumPy, to be read and believed. The fast one must equal it.

A sample belongs to a triangle when it lies inside; one on an edge belongs to the triangle whose left or top edge it is,
so that neighbours share every sample out among them. Source: Pineda 1988 (edge functions).

One sample in the middle of a pixel is enough inside of a surface. Where the border of something runs through a pixel,
four others take its place.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from .camera import SUBPIXELS, Camera
from .pixels import OFFSETS, ONE, WHOLE, Samples, average
from .triangles import Triangles

Floats32 = NDArray[np.float32]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Light = Callable[[Samples, Floats32, tuple[int, int]], Samples]
"""From groups of samples (G, H, W, 4), their 1 / depth and where in their pixels they lie to samples (H, W, 4)."""

CENTRE = (SUBPIXELS // 2, SUBPIXELS // 2)

BEND = 0.5
"""Tangent of the angle by which a surface may turn from one pixel to the next without being marked."""

HIDDEN_PX = 32.0
"""An edge so many pixels behind what is seen is hidden. The edge of a ball lies up to the root of its radius behind."""


def rasterise(triangles: Triangles, camera: Camera, behind: Samples, light: Light, smooth: bool) -> Samples:
    """(H, W, 4) samples of the picture.

    Args:
        triangles: with their values.
        camera: whose raster.
        behind: (H, 4) what is seen where no triangle is.
        light: what becomes of samples with more than one group of values.
        smooth: whether pixels on borders have four samples.
    """
    depth, groups = draw(triangles, camera, behind, CENTRE)
    samples = light(groups, depth, CENTRE)
    if not smooth:
        return samples
    marked = mark_edges(triangles, camera, depth) | mark_kinks(depth, np.float32(camera.scale))
    fine = []
    for offset in OFFSETS:
        depth, groups = draw(triangles, camera, behind, offset)
        fine.append(light(groups, depth, offset))
    return np.where(marked[..., None], average(np.stack(fine)), samples)


def draw(triangles: Triangles, camera: Camera, behind: Samples, offset: tuple[int, int]) -> tuple[Floats32, Samples]:
    """1 / depth (H, W) and groups of values (G, H, W, 4) of one sample a pixel; the nearest triangle wins."""
    width, height = camera.width, camera.height
    depth = np.zeros((height, width), dtype=np.float32)
    groups = np.repeat(behind[:, None], width, axis=1)[None].repeat(triangles.values.shape[1] // 3, axis=0)
    for corners, value_of in zip(triangles.corners, triangles.value_of, strict=True):
        places = triangles.places[corners].astype(np.int64)
        _draw(places, triangles.inverse[corners], triangles.values[value_of], offset, depth, groups)
    return depth, groups


def coverage(places: Ints, width: int, height: int, offset: tuple[int, int] = CENTRE) -> tuple[slice, slice, Bools]:
    """Rows and columns around a triangle (3, 2), 1/256 pixels, and which samples in them it covers."""
    low = np.maximum(-(-(places.min(axis=0) - offset) // SUBPIXELS), 0)
    high = np.minimum((places.max(axis=0) - offset) // SUBPIXELS + 1, (width, height))
    columns, rows = slice(low[0], max(high[0], low[0])), slice(low[1], max(high[1], low[1]))
    x = np.arange(columns.start, columns.stop) * SUBPIXELS + offset[0]
    y = (np.arange(rows.start, rows.stop) * SUBPIXELS + offset[1])[:, None]
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
    values: NDArray[np.float64],
    offset: tuple[int, int],
    depth: Floats32,
    groups: Samples,
) -> None:
    height, width = depth.shape
    rows, columns, covered = coverage(places, width, height, offset)
    if not covered.any():
        return
    x = np.arange(columns.start, columns.stop) * SUBPIXELS + offset[0]
    y = np.arange(rows.start, rows.stop) * SUBPIXELS + offset[1]
    spans = _Spans(x, covered.argmax(axis=1)) if offset == CENTRE else None
    z = _plane(places, inverse, x, y, np.float64, spans)
    near = covered & (z > depth[rows, columns])
    depth[rows, columns][near] = z[near]
    scale = np.float32(1.0) / z[near]
    for group, samples in enumerate(groups):
        most = np.float32(WHOLE if group else ONE)
        for v in range(3):
            # A value over depth is linear on the screen, the value is not. Source: Blinn 1992.
            over_depth = _plane(places, values[:, 3 * group + v] * inverse, x, y, np.float32, spans)
            samples[rows, columns, v][near] = np.clip(over_depth[near] * scale, np.float32(0.0), most).astype(np.int64)
        samples[rows, columns, 3][near] = ONE


class _Spans:
    """Rows of samples that are worked out from their first covered one on, step by step, as the fast rasteriser does.

    Attributes:
        first: (rows, 1) places of the first, 1/256 pixels.
        steps: (rows, columns) from there to each sample.
    """

    def __init__(self, x: Ints, first: Ints) -> None:
        self.first = x[first][:, None]
        self.steps = (np.arange(len(x)) - first[:, None]).astype(np.float32)


def _plane(
    places: Ints,
    ends: NDArray[np.float64],
    x: Ints,
    y: Ints,
    kind: type[np.float32 | np.float64],
    spans: _Spans | None,
) -> Floats32:
    """(rows, columns) a value at samples in columns x and rows y, 1/256 pixels; at the corners it is ``ends`` (3,)."""
    (ax, ay), (bx, by), (cx, cy) = places.astype(np.float64)
    share = 1.0 / ((bx - ax) * (cy - ay) - (cx - ax) * (by - ay))
    along, across = ends[1] - ends[0], ends[2] - ends[0]
    by_x = kind(along * ((cy - ay) * share) - across * ((by - ay) * share))
    by_y = kind(across * ((bx - ax) * share) - along * ((cx - ax) * share))
    from_a = (x[None, :] if spans is None else spans.first) - ax
    value = ((kind(ends[0]) + by_y * (y - ay).astype(kind)[:, None]) + by_x * from_a.astype(kind)).astype(np.float32)
    return value if spans is None else value + np.float32(by_x * SUBPIXELS) * spans.steps


def mark_edges(triangles: Triangles, camera: Camera, depth: Floats32) -> Bools:
    """(H, W) pixels that a border touches which is not hidden, given 1 / depth (H, W) of their middles."""
    marks = np.zeros(depth.shape, dtype=bool)
    for number in np.flatnonzero(triangles.borders):
        corners = triangles.corners[number]
        for k in range(3):
            if triangles.borders[number] >> k & 1:
                ends = corners[[k, (k + 1) % 3]]
                # What is in front of its nearer end is in front of all of it.
                nearest = float(triangles.inverse[ends].max())
                for pixels in _touched(triangles.places[ends].tolist(), len(depth)):
                    in_front = (depth[pixels].astype(np.float64) - nearest) * camera.scale
                    marks[pixels] |= in_front <= HIDDEN_PX * nearest
    return marks


def _touched(ends: list[list[int]], height: int) -> Iterator[tuple[int, slice]]:
    """Row and columns of the pixels that the straight line between two places touches."""
    (ax, ay), (bx, by) = sorted(ends, key=lambda place: place[1])
    for row in range(max(ay // SUBPIXELS, 0), min(by // SUBPIXELS, height - 1) + 1):
        sides = [ax, bx]
        if by > ay:
            heights = max(row * SUBPIXELS, ay), min((row + 1) * SUBPIXELS, by)
            sides = [ax + (y - ay) * (bx - ax) // (by - ay) for y in heights]
        yield row, slice(max(min(sides) // SUBPIXELS, 0), max(max(sides) // SUBPIXELS, -1) + 1)


def mark_kinks(depth: Floats32, scale: np.float32) -> Bools:
    """(H, W) pixels where the surface, or what takes its place, turns by more than ``BEND`` from one to the next.

    The depth rises by r from the pixel before and by s to the one after, in pixels: their directions differ by an angle
    of tangent (s - r) / (1 + r s).

    Args:
        depth: (H, W) 1 / depth.
        scale: pixels a metre at a distance of 1 m: one is 1 / scale wide there.
    """
    marks = np.zeros(depth.shape, dtype=bool)
    middle = depth[1:-1, 1:-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        for before, after in ((depth[1:-1, :-2], depth[1:-1, 2:]), (depth[:-2, 1:-1], depth[2:, 1:-1])):
            here = scale / middle
            rise, further = (middle - before) * here, (after - middle) * here
            bend = np.abs(further - rise) > np.float32(BEND) * (np.float32(1.0) + rise * further)
            marks[1:-1, 1:-1] |= bend & (middle > 0) & (before > 0) & (after > 0)
    return marks
