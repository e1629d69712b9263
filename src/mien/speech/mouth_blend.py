"""Dominance functions: at each moment every phone pulls the mouth towards its target, the nearest ones most.

Source: Cohen and Massaro 1993, "Modeling coarticulation in synthetic visual speech": the value is the mean of the
targets weighted by D = a exp(-theta |t - c|), with one rate before the phone's centre and another after it.
Ours beside it: distance counts from the core of a long phone and starts smoothly, so that a curve has no corner.
"""

from __future__ import annotations

import numpy as np

from mien.core import exact

from .mouth_gestures import JAW, Gestures
from .mouth_table import BLENDED, GROUPS, Floats

SMOOTH_S = 0.015
"""Radius of the rounding at the peak of a dominance function."""


def blend(sounds: Gestures, times_s: Floats) -> Floats:
    """(N, channels) blended values at sorted times; work and memory grow with the phones near those times."""
    near = sounds.between(float(times_s[0]), float(times_s[-1]))
    out = np.zeros((len(times_s), len(BLENDED)))
    column = 0
    for group, channels in enumerate(GROUPS.values()):
        lag = near.lag_s if group == JAW else 0.0
        centre, half_core = near.centre_s + lag, near.half_core_s[:, group]
        phone, sample = _pairs(centre, half_core + near.window_s, times_s)
        way = times_s[sample] - centre[phone]
        outside = np.maximum(0.0, np.abs(way) - half_core[phone])
        distance = np.sqrt(outside * outside + SMOOTH_S * SMOOTH_S) - SMOOTH_S
        rate = np.where(way < 0.0, near.rates[phone, group, 0], near.rates[phone, group, 1])
        weight = near.dominance[phone, group] * exact.exp(-rate * distance)
        # bincount adds one by one in order, so the sums are the same everywhere.
        total = np.bincount(sample, weight, minlength=len(times_s))
        for channel in range(column, column + len(channels)):
            pulled = np.bincount(sample, weight * near.targets[phone, channel], minlength=len(times_s))
            out[:, channel] = np.where(total > 0.0, pulled / np.where(total > 0.0, total, 1.0), 0.0)
        column += len(channels)
    return out


def _pairs(centre_s: Floats, reach_s: Floats, times_s: Floats) -> tuple[np.ndarray, np.ndarray]:
    """Numbers of phone and sample of every pair within reach of one another."""
    low = np.searchsorted(times_s, centre_s - reach_s)
    high = np.searchsorted(times_s, centre_s + reach_s)
    counts = high - low
    phone = np.repeat(np.arange(len(counts)), counts)
    first = np.concatenate([[0], np.cumsum(counts)[:-1]]) if len(counts) else np.zeros(0, dtype=np.int64)
    sample = np.arange(int(counts.sum())) - first[phone] + low[phone]
    return phone, sample
