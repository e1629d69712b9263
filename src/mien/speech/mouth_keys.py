"""Keys of curves: as few as keep a sampled curve within a tolerance."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .mouth_table import Floats

TOLERANCE = 0.002


def reduce_keys(
    times_s: Floats, values: Floats, *, tolerance: float = TOLERANCE, keep: NDArray[np.bool_] | None = None
) -> NDArray[np.int64]:
    """Numbers of the samples to keep, ends and turning points among them.

    Straight lines between the kept samples pass all others within the tolerance; flat stretches stay flat, exactly.

    Args:
        times_s: (N,) s, rising.
        values: (N,) of the curve.
        tolerance: greatest error at a sample.
        keep: (N,) samples to keep in any case.
    """
    step = np.diff(values)
    wanted = np.ones(len(values), dtype=bool)
    wanted[1:-1] = np.sign(step[1:]) != np.sign(step[:-1])
    if keep is not None:
        wanted |= keep
    while True:
        kept = np.flatnonzero(wanted)
        if len(kept) == len(values):
            return kept
        error = np.abs(_through(times_s, values, kept) - values)
        worst = np.maximum.reduceat(error, kept[:-1])
        segment = np.cumsum(wanted)[:-1] - 1
        late = np.flatnonzero((error[:-1] > tolerance) & (error[:-1] == worst[segment]))
        if len(late) == 0:
            return kept
        _, first = np.unique(segment[late], return_index=True)
        wanted[late[first]] = True


def _through(times_s: Floats, values: Floats, kept: NDArray[np.int64]) -> Floats:
    """(N,) straight lines through the kept samples."""
    sample = np.arange(len(times_s))
    left = np.minimum(np.searchsorted(kept, sample, side="right") - 1, len(kept) - 2)
    a, b = kept[left], kept[left + 1]
    share = (times_s - times_s[a]) / (times_s[b] - times_s[a])
    line: Floats = values[a] + share * (values[b] - values[a])
    return line
