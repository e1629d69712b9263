"""Rigid turns: the eyes about their centres, then the head about its pivot."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mien.core import exact
from mien.core.mesh import Ints, Points

Floats = NDArray[np.float64]

STEPS: Sequence[tuple[int, int, float]] = ((0, 1, -1.0), (1, 2, -1.0), (2, 0, 1.0))
"""Axes of each turn, from the first to the second, and its sense: tilt, nod, turn."""


def turn_rigidly(
    points: Points, vertices: Ints | slice, pivot: Sequence[float], turn_deg: float, nod_deg: float, tilt_deg: float
) -> None:
    """Tilt some of the points (V, 3) m towards the own left, nod them upwards, then turn them to the own left."""
    if turn_deg == 0.0 and nod_deg == 0.0 and tilt_deg == 0.0:
        return
    columns = [points[vertices, axis] - pivot[axis] for axis in range(3)]
    for (first, second, sense), angle_deg in zip(STEPS, (tilt_deg, nod_deg, turn_deg), strict=True):
        sine, cosine = map(float, exact.sin_cos(sense * angle_deg * (math.pi / 180.0)))
        a, b = columns[first], columns[second]
        columns[first], columns[second] = a * cosine - b * sine, a * sine + b * cosine
    for axis, column in enumerate(columns):
        points[vertices, axis] = column + pivot[axis]
