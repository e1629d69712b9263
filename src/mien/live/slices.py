"""Motors that move in slices, one a loop: the scheduling of ToonFace's Animator.

Source: Thórisson 1996, Appendix A1.2.4.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.timeline import CHANGES
from mien.timeline.change import CHANGE_NAMES, change_code

Floats = NDArray[np.float64]
Rows = NDArray[np.intp]

ROUNDING = 1e-6
"""A duration that is a whole number of loops but for this part of one counts as whole."""


def count_slices(over_s: float, loop_s: float) -> int:
    """Number of slices that a duration is cut into; at least one, and never fewer than fill it."""
    return max(1, math.ceil(over_s / loop_s - ROUNDING))


@dataclass(frozen=True)
class Way:
    """Where a motor goes next, in how many slices; without a target it stays where it is so long.

    Attributes:
        target: the value after the last slice, exactly; None to stay.
        slices: how many, at least one.
        change: name of the change function.
    """

    target: float | None
    slices: int
    change: str = "linear"


class Motors:
    """M independent values, each with pending slices of its own; every ``step`` executes one slice of each.

    What is pending are the ways with the number of slices done, from which each slice is computed when it is due.
    """

    def __init__(self, values: Sequence[float] | Floats) -> None:
        self.values: Floats = np.array(values, dtype=np.float64)
        count = len(self.values)
        self._from = self.values.copy()
        self._to = self.values.copy()
        self._done = np.zeros(count, dtype=np.int64)
        self._whole = np.zeros(count, dtype=np.int64)
        self._change = np.zeros(count, dtype=np.uint8)
        self._then: dict[int, deque[Way]] = {}

    @property
    def pending(self) -> NDArray[np.int64]:
        """(M,) slices that are still to be executed, those of all ways of a motor."""
        left = self._whole - self._done
        for motor, ways in self._then.items():
            left[motor] += sum(way.slices for way in ways)
        return left

    @property
    def moving(self) -> bool:
        """Whether some slice is pending."""
        return bool((self._done < self._whole).any())

    def move(self, motor: int, *ways: Way) -> None:
        """Give a motor new ways, one after the other, in the place of all its pending slices."""
        self._then.pop(motor, None)
        self._whole[motor] = self._done[motor] = 0
        if ways:
            self._begin(motor, ways[0])
        if len(ways) > 1:
            self._then[motor] = deque(ways[1:])

    def put(self, motor: int, value: float) -> None:
        """Set a motor at once; nothing of it is pending any more."""
        self.move(motor)
        self.values[motor] = value

    def halt(self) -> None:
        """Drop all pending slices; every motor stays where it is."""
        self._then.clear()
        self._done[:] = self._whole

    def step(self) -> None:
        """Execute one slice of every motor that has any."""
        active = np.flatnonzero(self._done < self._whole)
        if not len(active):
            return
        self._done[active] += 1
        done, whole = self._done[active], self._whole[active]
        fraction = done / whole
        codes = self._change[active]
        share = np.empty(len(active))
        for code in np.flatnonzero(np.bincount(codes)):
            here = codes == code
            share[here] = CHANGES[CHANGE_NAMES[code]](fraction[here])
        first, last = self._from[active], self._to[active]
        self.values[active] = np.where(share >= 1.0, last, first + share * (last - first))
        for motor in active[done == whole].tolist():
            ways = self._then.get(motor)
            if ways:
                self._begin(motor, ways.popleft())
            if ways is not None and not ways:
                del self._then[motor]

    def _begin(self, motor: int, way: Way) -> None:
        self._from[motor] = self.values[motor]
        self._to[motor] = self.values[motor] if way.target is None else way.target
        self._done[motor], self._whole[motor] = 0, way.slices
        self._change[motor] = change_code(way.change)
