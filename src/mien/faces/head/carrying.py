"""Moves of what is not bound to the skin, carried by the skin near it: hair, collar, glasses."""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

import numpy as np

from mien.compiling import kernel
from mien.core.mesh import Points

SOFTENING_M2 = 0.008 * 0.008
"""Square of the distance below which nearer skin counts hardly more."""


def carry(points: Points, skin: Points, moves: Points) -> Points:
    """(N, 3) m, the moves of points (N, 3) m beside a skin (V, 3) m whose vertices have moves (V, 3) m.

    Each is a mean of the moves of the skin, weighted by the inverse fourth power of the distance.

    Source: Shepard 1968 (inverse distance weighting).
    """
    out = np.empty_like(points)
    if len(points):
        carry_moves(np.ascontiguousarray(points), skin, np.ascontiguousarray(moves), out)
    return out


@kernel("f8[:,:], f8[:,:], f8[:,:], f8[:,:]")
def carry_moves(points, skin, moves, out):
    """Fill ``out`` (N, 3) m with the moves (V, 3) of the skin (V, 3) near points (N, 3), all m."""
    for n in range(len(points)):
        x, y, z, total = 0.0, 0.0, 0.0, 0.0
        for v in range(len(skin)):
            dx, dy, dz = skin[v, 0] - points[n, 0], skin[v, 1] - points[n, 1], skin[v, 2] - points[n, 2]
            near = 1.0 / (dx * dx + dy * dy + dz * dz + SOFTENING_M2)
            weight = near * near
            total += weight
            x, y, z = x + weight * moves[v, 0], y + weight * moves[v, 1], z + weight * moves[v, 2]
        out[n, 0], out[n, 1], out[n, 2] = x / total, y / total, z / total
