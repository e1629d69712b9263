"""How far a drawn head reaches to every side."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .records import Floats

COUNT = 256
"""Directions in which the reach is measured."""

INSIDE = 0.97
"""The rim lies this much within the outline, so that no gap opens between front and back."""

GAP = 3
"""Over so many directions to both sides it does so, where the outline has a notch."""

SLOPE = 2.0
"""From one direction to the next the reach grows at most by this share of the angle between them: our choice."""

SMOOTH = 4
"""Over so many directions to both sides the reach is smoothed, so that the horizon is: our choice."""

LEAST = 1.0
"""Reach where there is nothing, drawing units."""


def directions() -> Floats:
    """(COUNT, 2) unit vectors all around, from the right upwards."""
    place = np.arange(COUNT) * (4.0 / COUNT)
    quarter = place.astype(np.int64)
    part = place - quarter
    rest = 1.0 - part
    x = np.choose(quarter, [rest, -part, -rest, part])
    y = np.choose(quarter, [part, rest, -part, -rest])
    return np.stack([x, y], axis=1) / np.sqrt(x * x + y * y)[:, None]


def place_around(ways: Floats) -> Floats:
    """(N,) places 0..COUNT of directions (N, 2) of any length, in the steps of ``directions``."""
    x, y = ways.T
    size = np.abs(x) + np.abs(y)
    share = y / np.where(size > 0.0, size, 1.0)
    return np.asarray(np.where(x >= 0.0, np.where(y >= 0.0, share, 4.0 + share), 2.0 - share) * (COUNT / 4.0))


def reach(radii: Floats, ways: Floats) -> Floats:
    """(N,) reach in directions (N, 2) of any length, between those that were measured (COUNT,)."""
    place = place_around(ways)
    first = np.floor(place)
    part = place - first
    index = first.astype(np.int64)
    return np.asarray(radii[index % COUNT] * (1.0 - part) + radii[(index + 1) % COUNT] * part)


def measure_reach(polygons: Sequence[Sequence[Floats]], narrow: int) -> Floats:
    """(COUNT,) how far one comes from the origin in each direction before leaving all polygons.

    Args:
        polygons: closed contours (N, 2) of each.
        narrow: what stands out over fewer than twice as many directions does not count.
    """
    owner = np.repeat(np.arange(len(polygons)), [sum(map(len, contours)) for contours in polygons])
    starts = np.concatenate([contour for contours in polygons for contour in contours])
    ends = np.concatenate([np.roll(contour, -1, axis=0) for contours in polygons for contour in contours])
    far = np.array([_way_out(starts, ends, owner, way) for way in directions()])
    opened = _around(_around(far, narrow).min(axis=0), narrow).max(axis=0)
    smooth = _around(opened, narrow // 2).mean(axis=0)
    inner = np.minimum(smooth, _around(far, GAP).min(axis=0))
    steps = np.abs(np.arange(-COUNT // 4, COUNT // 4 + 1))[:, None] * (2.0 * np.pi / COUNT)
    sloping = (_around(inner, COUNT // 4) * (1.0 + SLOPE * steps)).min(axis=0)
    # Least values, then their means as far around: smooth, and never beyond what it was.
    return np.asarray(INSIDE * _around(_around(sloping, SMOOTH).min(axis=0), SMOOTH).mean(axis=0))


def _way_out(starts: Floats, ends: Floats, owner: NDArray[np.int64], way: Floats) -> float:
    """How far it is from the origin in one direction to where no polygon is; edges (E, 2) belong to owners (E,)."""
    before, after = way[0] * starts[:, 1] - way[1] * starts[:, 0], way[0] * ends[:, 1] - way[1] * ends[:, 0]
    crossing = np.flatnonzero((before <= 0.0) != (after <= 0.0))
    a, b = starts[crossing], ends[crossing]
    hit = a + (b - a) * (before[crossing] / (before[crossing] - after[crossing]))[:, None]
    distance = hit[:, 0] * way[0] + hit[:, 1] * way[1]
    leaving = np.where(before[crossing] <= 0.0, 1, -1)
    # How often each polygon runs around the place on the way, from far out inwards.
    rounds: dict[int, int] = {}
    out = LEAST
    for number in np.argsort(-distance, kind="stable"):
        if distance[number] <= LEAST:
            break
        if not any(rounds.values()):
            out = float(distance[number])
        polygon = int(owner[crossing[number]])
        rounds[polygon] = rounds.get(polygon, 0) + int(leaving[number])
    return out


def _around(values: Floats, width: int) -> Floats:
    """(2 width + 1, COUNT) values with their neighbours on both sides."""
    return np.stack([np.roll(values, shift) for shift in range(-width, width + 1)])
