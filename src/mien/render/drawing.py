"""Pictures of 2-D faces, plainly: filled paths, one over the other, to be read and believed.

In each of ``SUBROWS`` lines through a row of pixels the stretches inside a path are found and counted by their exact
width, so that nearly upright edges are exact and level ones have ``SUBROWS`` steps. The fast filler has none.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mien.core import Drawing, Scene
from mien.core.drawing import Contours, Rule

from .outlines import place_canvas
from .pixels import background, encode, to_samples

Floats = NDArray[np.float64]

SUBROWS = 16


def draw_plainly(drawing: Drawing, scene: Scene) -> NDArray[np.uint8]:
    """(H, W, 4) sRGB picture with straight alpha: the canvas, as large as its size allows, on its lower edge."""
    width, height = scene.size_px
    scale, left, bottom = place_canvas(drawing, scene.size_px)

    def area(contours: Contours, rule: Rule) -> Floats:
        placed = [np.stack([left + each[:, 0] * scale, bottom - each[:, 1] * scale], axis=1) for each in contours]
        return coverage(placed, width, height, rule)

    picture = np.repeat(background(scene, drawing.background)[:, None, :], width, axis=1)
    for path in drawing.paths:
        share = area(path.contours, path.rule)
        for region in path.inside:
            share = share * area(region.contours, region.rule)
        for region in path.outside:
            share = share * (1.0 - area(region.contours, region.rule))
        share = share[..., None] * path.color[3]
        picture = np.array([*path.color[:3], 1.0]) * share + picture * (1.0 - share)
    return encode(to_samples(picture))


def coverage(contours: list[Floats], width: int, height: int, rule: Rule = "evenodd", subrows: int = SUBROWS) -> Floats:
    """(H, W) share of each pixel that lies inside closed contours (N, 2) in pixels, y down."""
    starts = np.concatenate([np.zeros((0, 2)), *contours])
    ends = np.concatenate([np.zeros((0, 2)), *(np.roll(contour, -1, axis=0) for contour in contours)])
    downwards = starts[:, 1] <= ends[:, 1]
    upper, lower = np.where(downwards[:, None], starts, ends), np.where(downwards[:, None], ends, starts)
    # Line s lies at y = (s + 1/2) / subrows; an edge crosses those with upper y <= y < lower y.
    first, last = (
        np.clip(np.ceil(edge[:, 1] * subrows - 0.5), 0, height * subrows).astype(np.int64) for edge in (upper, lower)
    )
    number = last - first
    edge = np.repeat(np.arange(len(upper)), number)
    line = np.arange(number.sum()) - np.repeat(np.cumsum(number) - number, number) + first[edge]
    y = (line + 0.5) / subrows
    slope = (lower[edge, 0] - upper[edge, 0]) / (lower[edge, 1] - upper[edge, 1])
    x = np.clip(upper[edge, 0] + (y - upper[edge, 1]) * slope, 0.0, float(width))
    order = np.lexsort((x, line))
    line, x = line[order], x[order]
    # How often the outline has wound around what comes after a crossing; every line ends outside, at 0.
    winding = np.cumsum(np.where(downwards[edge[order]], 1, -1))
    inside = winding % 2 != 0 if rule == "evenodd" else winding != 0
    sign = inside.astype(float) - np.concatenate([[False], inside[:-1]])
    pixel = np.minimum(x.astype(np.int64), width - 1)
    rest = x - pixel
    place = (line // subrows) * (width + 1) + pixel
    size = height * (width + 1)
    change = np.bincount(place, sign * (1.0 - rest), size) + np.bincount(place + 1, sign * rest, size + 1)[:size]
    return np.clip(np.cumsum(change.reshape(height, width + 1), axis=1)[:, :width] / subrows, 0.0, 1.0)
