"""Frames a second as exact fractions, so that the times of frames never drift from those of a film."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from mien.core import RangeError

Rate = float | Fraction
"""Frames a second, as people write it or exact."""

Number = TypeVar("Number", float, NDArray[np.float64])

NTSC = tuple(Fraction(whole * 1000, 1001) for whole in (24, 30, 48, 60, 120, 240))
"""Rates that people write with two or three places. Source: SMPTE ST 12-1 and ST 2036-1."""

NEAR = Fraction(1, 200)
"""How near to such a rate a number means it: 23.98, the coarsest of the usual ways to write one, is 0.004 off."""

MOST_PARTS = 1001
"""Of a second, in which frames are counted; films cannot count in arbitrarily many."""


def exact_rate(fps: Rate) -> Fraction:
    """Frames a second as a fraction: 23.976 is 24000/1001, 29.97 is 30000/1001; a fraction of small numbers is itself.

    Raises:
        RangeError: it is not finite, or not above 1/1001.
    """
    if math.isfinite(fps):
        given = Fraction(fps)
        near = [] if isinstance(fps, Fraction) else [rate for rate in NTSC if abs(given - rate) <= NEAR]
        rate = near[0] if near else given.limit_denominator(MOST_PARTS)
        if rate > 0:
            return rate
    raise RangeError(f"timeline: a rate of {fps} frames a second is not a finite number above 1/{MOST_PARTS}")


def time_of(frame: Number, rate: Fraction) -> Number:
    """When a frame, or each of some, is seen: frame / rate in seconds, rounded once."""
    return frame * rate.denominator / rate.numerator
