"""A drawing on the front of a thick board, cut out along the head: walls in the colours of what lies at its edge."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .records import Floats
from .solid_form import area
from .solid_motion import Motion


@dataclass(frozen=True, eq=False)
class Box:
    """A board about the middle of the head.

    Attributes:
        half: half its thickness, drawing units.
        motion: how it is turned.
    """

    half: float
    motion: Motion

    def is_behind(self, point: Floats) -> bool:
        """Whether a point (2,) of its middle plane has turned away from the viewer."""
        x, y, _ = self.motion.towards_viewer
        return bool(point[0] * x + point[1] * y < 0.0)

    def plate(self, contours: Sequence[Floats]) -> list[Floats]:
        """Closed contours (N, 2), from the middle of the head, y up, on the side that is seen."""
        half = np.full(1, self.half if self.motion.shows_front else -self.half)
        return [self.motion.apply(np.column_stack([each, half.repeat(len(each))]))[:, :2] for each in contours]

    def walls(self, contours: Sequence[Floats], at_edge: Sequence[NDArray[np.bool_]]) -> list[Floats]:
        """The walls along closed contours that are seen, from one side of the board to the other.

        Args:
            contours: as for ``plate``.
            at_edge: (N,) of each, which vertices lie at the edge of the board; there are walls only between those.
        """
        near = self.plate(contours)
        inwards = -2.0 * self.half if self.motion.shows_front else 2.0 * self.half
        sweep = np.array([row[2] * inwards for row in self.motion.rows[:2]])
        sense = 1.0 if sum(area(contour) for contour in near) > 0.0 else -1.0
        walls = []
        for contour, edge in zip(near, at_edge, strict=True):
            along = np.roll(contour, -1, axis=0) - contour
            seen = sense * (sweep[0] * along[:, 1] - sweep[1] * along[:, 0]) > 0.0
            for run in _runs(seen & edge & np.roll(edge, -1)):
                walls.append(np.concatenate([contour[run], contour[run[::-1]] + sweep]))
        return walls


def _runs(chosen: NDArray[np.bool_]) -> Iterator[NDArray[np.int64]]:
    """The vertices of each stretch of chosen edges around a contour; edge n runs from vertex n to the next one."""
    if chosen.all():
        yield np.arange(len(chosen) + 1) % len(chosen)
    for start in np.flatnonzero(chosen & ~np.roll(chosen, 1)):
        length = int(np.argmin(np.roll(chosen, -start)))
        yield (start + np.arange(length + 1)) % len(chosen)
