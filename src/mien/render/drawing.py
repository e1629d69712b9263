"""Pictures of 2-D faces: filled paths, one over the other, with edges as smooth as their exact area allows.

In each of ``SUBROWS`` lines through a row of pixels the stretches inside a path are found by the even-odd rule and
counted by their exact width, so that nearly upright edges are exact and level ones have ``SUBROWS`` steps.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mien.core import Drawing, Path, Scene

from .pixels import background, encode, to_samples

Floats = NDArray[np.float64]

SUBROWS = 8


def draw_drawing(drawing: Drawing, scene: Scene) -> NDArray[np.uint8]:
    """(H, W, 4) sRGB picture with straight alpha: the canvas, centred, as large as the picture's size allows."""
    width, height = scene.size_px
    scale = min(width / drawing.size[0], height / drawing.size[1])
    left = (width - scale * drawing.size[0]) / 2.0
    bottom = (height + scale * drawing.size[1]) / 2.0
    picture = np.repeat(background(scene, drawing.background)[:, None, :], width, axis=1)
    for path in drawing.paths:
        contours = [
            np.stack([left + contour[:, 0] * scale, bottom - contour[:, 1] * scale], axis=1)
            for contour in path.contours
            if len(contour) >= 3
        ]
        if contours:
            _paint(picture, contours, path)
    return encode(to_samples(picture))


def _paint(picture: Floats, contours: list[Floats], path: Path) -> None:
    height, width = picture.shape[:2]
    points = np.concatenate(contours)
    low = np.maximum(np.floor(points.min(axis=0)).astype(int), 0)
    high = np.minimum(np.ceil(points.max(axis=0)).astype(int) + 1, (width, height))
    if (low >= high).any():
        return
    rows, columns = slice(low[1], high[1]), slice(low[0], high[0])
    share = coverage([contour - low for contour in contours], high[0] - low[0], high[1] - low[1])[..., None]
    red, green, blue, alpha = path.color
    share = share * alpha
    color = np.array([red, green, blue, 1.0])
    picture[rows, columns] = color * share + picture[rows, columns] * (1.0 - share)


def coverage(contours: list[Floats], width: int, height: int) -> Floats:
    """(H, W) share of each pixel that lies inside closed contours (N, 2) in pixels, y down, by the even-odd rule."""
    starts = np.concatenate(contours)
    ends = np.concatenate([np.roll(contour, -1, axis=0) for contour in contours])
    downwards = (starts[:, 1] <= ends[:, 1])[:, None]
    upper, lower = np.where(downwards, starts, ends), np.where(downwards, ends, starts)
    # Line s lies at y = (s + 1/2) / SUBROWS; an edge crosses those with upper y <= y < lower y.
    first, last = (
        np.clip(np.ceil(edge[:, 1] * SUBROWS - 0.5), 0, height * SUBROWS).astype(np.int64) for edge in (upper, lower)
    )
    number = last - first
    edge = np.repeat(np.arange(len(upper)), number)
    line = np.arange(number.sum()) - np.repeat(np.cumsum(number) - number, number) + first[edge]
    y = (line + 0.5) / SUBROWS
    slope = (lower[edge, 0] - upper[edge, 0]) / (lower[edge, 1] - upper[edge, 1])
    x = np.clip(upper[edge, 0] + (y - upper[edge, 1]) * slope, 0.0, float(width))
    order = np.lexsort((x, line))
    line, x = line[order], x[order]
    # Every line is crossed an even number of times: it is entered at even crossings and left at odd ones.
    sign = np.where(np.arange(len(x)) % 2 == 0, 1.0, -1.0)
    pixel = np.minimum(x.astype(np.int64), width - 1)
    rest = x - pixel
    place = (line // SUBROWS) * (width + 1) + pixel
    size = height * (width + 1)
    change = np.bincount(place, sign * (1.0 - rest), size) + np.bincount(place + 1, sign * rest, size + 1)[:size]
    return np.clip(np.cumsum(change.reshape(height, width + 1), axis=1)[:, :width] / SUBROWS, 0.0, 1.0)
