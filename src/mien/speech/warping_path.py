"""The cheapest way through two sounds at once: which frame of one is which of the other."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

LINGER, HASTE = 0.1, 0.2
"""Cost of staying on a frame, and of leaving one out, beside the distances, whose mean is about one."""


def find_path(distances: Floats, free: NDArray[np.bool_], ends: Floats) -> tuple[NDArray[np.int64], float]:
    """For each frame that is heard the frame of the pattern that it is, (N,), and the mean cost of a frame.

    Each frame stays on the pattern's frame, goes to the next one, or leaves one out.

    Args:
        distances: (N, M) of each heard frame from each of the pattern; the way begins at one of the first two.
        free: (M,) frames on which it costs nothing to stay.
        ends: (M,) cost a heard frame of ending there; infinite where the way may not end.

    Source: Sakoe and Chiba 1978, Dynamic programming algorithm optimization for spoken word recognition, with the
    local path that counts each heard frame once, so that ends of the pattern can be compared.
    """
    count, size = distances.shape
    linger = np.where(free, 0.0, LINGER)
    steps = np.zeros((count, size), np.int8)
    cost = np.full(size, np.inf)
    cost[:2] = distances[0, :2]
    ways = np.full((3, size), np.inf)
    for heard in range(1, count):
        np.add(cost, linger, out=ways[0])
        ways[1, 1:] = cost[:-1]
        np.add(cost[:-2], HASTE, out=ways[2, 2:])
        steps[heard] = ways.argmin(axis=0)
        cost = ways.min(axis=0) + distances[heard]
    place = int((cost + ends * count).argmin())
    mean = float(cost[place]) / count
    path = np.empty(count, np.int64)
    for heard in range(count - 1, -1, -1):
        path[heard] = place
        place -= int(steps[heard, place])
    return path, mean
