"""Numbers in sixteen bits, as steps from a middle."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError

MOST = 32767


class Steps:
    """Whole steps from a middle; the step is a power of two, large enough for all that came so far, and never shrinks.

    Attributes:
        middle: (K,) what is no step away.
        step: the length of one.
    """

    def __init__(self, middle: NDArray[np.float64]) -> None:
        self.middle = middle
        self.step = 2.0**-24

    def encode(self, values: NDArray[np.float64]) -> NDArray[np.int16]:
        """Values (N, K) to the nearest step; ``step`` may have grown.

        Raises:
            MienError: one is not a finite number.
        """
        offsets = values - self.middle
        farthest = float(np.abs(offsets).max()) if offsets.size else 0.0
        if not math.isfinite(farthest):
            raise MienError("a face to be sent has a point that is not a finite number")
        while farthest > MOST * self.step:
            self.step *= 2.0
        offsets *= 1.0 / self.step
        return np.rint(offsets, out=offsets).astype("<i2")
