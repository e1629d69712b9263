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
    points: Points,
    vertices: Ints | slice,
    pivot: Sequence[float],
    angles_deg: Sequence[float],
    share: Floats | float = 1.0,
) -> None:
    """Turn some of the points (V, 3) m about a pivot.

    Args:
        points: all; those that are chosen are changed in place.
        vertices: which, N of them.
        pivot: (x, y, z) m.
        angles_deg: turn to the own left, nod upwards, tilt towards the own left; the tilt comes first.
        share: (N,) how much of the angles each of them goes.
    """
    if not any(angles_deg):
        return
    columns = [points[vertices, axis] - pivot[axis] for axis in range(3)]
    for (first, second, sense), angle_deg in zip(STEPS, angles_deg[::-1], strict=True):
        if angle_deg == 0.0:
            continue
        sine, cosine = exact.sin_cos(share * (sense * angle_deg * (math.pi / 180.0)))
        a, b = columns[first], columns[second]
        columns[first], columns[second] = a * cosine - b * sine, a * sine + b * cosine
    for axis, column in enumerate(columns):
        points[vertices, axis] = column + pivot[axis]
