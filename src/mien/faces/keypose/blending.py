"""Where points are when several phases show: Parke's interpolation, and weights beside it.

Two things move a point away from where it is at rest: the phase number, and the weights. Each push along a coordinate
takes its part of what the pushes before it have left of the way to the furthest place that the coordinate has in any
phase; pushes in opposite directions are subtracted. So a phase alone is met exactly, what moves different points adds
up, and no point ever leaves the box of its measured places, however many phases show: the lips of an open mouth (open)
that is rounded too (ou) do not open twice. The order of the phases does not matter but for rounding.

Source: Parke 1972, "Animation" (the cosine); the rule for several phases is ours, as is that of ``mien.vocab``.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from mien.core import exact
from mien.core.mesh import Points

Floats = NDArray[np.float64]


def split_number(number: float, count: int) -> tuple[int, float]:
    """The previous phase, from 0, and C, the share of the way to the next one, of a phase number 1..count.

    Source: Parke 1972, "Animation": C = (1 - cos phi) / 2 with phi = pi times the fraction of the number. The printed
    page has 3.14159 for pi; at a fraction of 1 that leaves 2e-12 of the way.
    """
    previous = min(int(number), count) - 1
    fraction = number - (previous + 1)
    if fraction <= 0.0:
        return previous, 0.0
    return previous, (1.0 - float(exact.cos(math.pi * fraction))) / 2.0


class Blend:
    """The phases of one face.

    Args:
        places: (K, V, 3) m of the vertices in each phase, the first at rest.
        left: (V,) how much of what the left half does each vertex takes part in.

    Attributes:
        rest: (V, 3) m.
        moves: (K, V, 3) m, from rest to each phase.
    """

    def __init__(self, places: Points, left: Floats) -> None:
        self.rest, self._left = places[0], left[:, None]
        self.moves = places - self.rest
        ways = _two_ways(self.moves)
        self._room = ways.max(axis=0)
        self._shares = np.where(self._room > 0.0, 1.0 / np.where(self._room > 0.0, self._room, 1.0), 0.0)
        self._pushes = ways * self._shares

    def place(self, number: float, weights: Floats) -> Points:
        """(V, 3) m of the vertices.

        Args:
            number: of a phase, 1..K.
            weights: (K, 2) of each phase on the left and on the right half; the first row is not used.
        """
        gone = np.zeros_like(self._room)
        previous, share = split_number(number, len(self.moves))
        if share > 0.0:
            move = self.moves[previous] + share * (self.moves[previous + 1] - self.moves[previous])
            gone += _two_ways(move) * self._shares
        elif previous > 0:
            gone += self._pushes[previous]
        for phase in np.flatnonzero(weights[1:].any(axis=1)) + 1:
            left, right = weights[phase].tolist()
            weight = left if left == right else right + (left - right) * self._left
            push = weight * self._pushes[phase]
            gone += push - push * gone
        up, down = self._room * gone
        return self.rest + (up - down)


def _two_ways(moves: Points) -> Points:
    """(…, 2, V, 3) m, the parts of moves (…, V, 3) along and against the axes, both 0 or more."""
    return np.maximum(np.stack([moves, -moves], axis=-3), 0.0)
