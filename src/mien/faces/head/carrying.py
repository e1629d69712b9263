"""Moves of what is not bound to the skin, carried by the skin near it: hair, collar, glasses."""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.compiling import kernel
from mien.core.mesh import Ints, Points

from .measured import Floats

NEAREST = 12
"""Vertices of the skin that carry a point."""


@dataclass(frozen=True, eq=False)
class Carried:
    """What carries points: the nearest vertices of the skin, each with a weight; the weights of a point add up to 1.

    Attributes:
        index: (N, K).
        weight: (N, K).
    """

    index: Ints
    weight: Floats

    def moves(self, skin_moves: Points) -> Points:
        """(N, 3) m, from the moves (V, 3) m of the skin."""
        out = np.zeros((len(self.index), 3))
        for index, weight in zip(self.index.T, self.weight.T, strict=True):
            out += weight[:, None] * skin_moves[index]
        return out


def bind_to_skin(points: Points, skin: Points) -> Carried:
    """What carries points (N, 3) m beside a skin (V, 3) m.

    The weights fade to 0 towards the first vertex that is too far to count, so that nothing jumps between neighbours.

    Source: Franke and Little (in Barnhill 1977), inverse distance weighting with local support.
    """
    index = np.zeros((len(points), NEAREST + 1), dtype=np.int64)
    square = np.zeros((len(points), NEAREST + 1))
    find_nearest(np.ascontiguousarray(points), np.ascontiguousarray(skin), index, square)
    distance = np.sqrt(np.maximum(square, 1e-12))
    reach = distance[:, -1:]
    near = ((reach - distance[:, :-1]) / (reach * distance[:, :-1])) ** 2
    total = np.add.accumulate(near, axis=1)[:, -1:]
    return Carried(index[:, :-1], near / total)


@kernel("f8[:,:], f8[:,:], i8[:,:], f8[:,:]")
def find_nearest(points, skin, index, square):
    """Fill ``index`` (N, K) with the nearest vertices of a skin (V, 3) to points (N, 3), and ``square`` (N, K), m2."""
    count = index.shape[1]
    for n in range(len(points)):
        found = 0
        for v in range(len(skin)):
            dx, dy, dz = skin[v, 0] - points[n, 0], skin[v, 1] - points[n, 1], skin[v, 2] - points[n, 2]
            away = dx * dx + dy * dy + dz * dz
            if found == count and away >= square[n, count - 1]:
                continue
            if found < count:
                found += 1
            place = found - 1
            while place > 0 and square[n, place - 1] > away:
                square[n, place], index[n, place] = square[n, place - 1], index[n, place - 1]
                place -= 1
            square[n, place], index[n, place] = away, v
