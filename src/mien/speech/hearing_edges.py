"""Boundaries of phones moved to where the sound changes, finer than the steps of 10 ms of the search (ADR 0015)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mien.core import SILENCE

from .hearing_sound import HEARING_HZ
from .phones import STOPS, VOWELS

HOP_S = 0.002
"""Between the spectra that are compared, seconds."""

SPECTRUM_S = 0.008
"""Sound that a spectrum is of, seconds: a burst must not blur into its closure."""

BANDS = 14
"""Of a spectrum, equally wide in mel."""

SIDE_S = 0.012
"""Before and after a boundary, whose mean spectra are compared, seconds."""

REACH_S, SPREAD_S = 0.02, 0.01
"""How far a boundary moves at most, and the standard deviation of the search's own error, seconds."""

GLIDES = frozenset(["L", "R", "W", "Y"])

GLIDE_TO_VOWEL_S, VOWEL_TO_GLIDE_S = -0.012, 0.008
"""Moves where one glides into the other, and nothing changes all at once, seconds.

People draw the boundary in the middle of the movement, the model hears the glide until its end. Medians on four
sentences labelled by hand (18 boundaries) and 30 of a diphone voice (166).
"""

SILENT_DB = 30.0
"""Below the loudest part of a phone beside a pause, from which on the pause has begun, dB."""

ABOVE_BACKGROUND_DB = 6.0
"""Over the quietest sound, up to which nothing is heard, dB."""

ONSET_S = 0.06
"""How far the beginning of a phone after a pause moves at most, seconds."""

NEAREST_S = 0.005
"""How near to the middle of a phone its boundaries may come, seconds: every phone keeps its place."""

_FLOOR = 1e3
"""Added to the power of a band: what is weaker than the noise under everything does not change."""

Span = tuple[str, float, float]
"""A phone or a pause, and its beginning and end, seconds."""


def sharpen(spans: Sequence[Span], samples: NDArray[np.int16]) -> list[Span]:
    """Phones and pauses without holes, their boundaries where the sound changes most.

    Args:
        spans: in order, each beginning where the one before it ends.
        samples: (N,) at ``HEARING_HZ``.
    """
    if len(spans) < 2:
        return list(spans)
    spectra, levels = _measure(samples)
    sums = np.cumsum(np.concatenate([np.zeros((1, BANDS)), spectra]), axis=0)
    background_db = float(np.percentile(levels, 3))
    edges = [spans[0][1]]
    for before, after in pairwise(spans):
        low_s = (before[1] + before[2]) / 2 + NEAREST_S if before[0] != SILENCE else before[1]
        high_s = (after[1] + after[2]) / 2 - NEAREST_S if after[0] != SILENCE else after[2]
        if after[0] == SILENCE:
            edge_s = _find_end(before, levels, background_db)
        elif before[0] == SILENCE:
            edge_s = after[1] if after[0] in STOPS else _find_onset(after, levels, background_db)
        elif _glides(before[0]) and _glides(after[0]):
            edge_s = after[1] + _glide_shift_s(before[0], after[0])
        else:
            edge_s = _find_change(after[1], sums)
        edges.append(min(max(edge_s, low_s, edges[-1]), max(high_s, low_s)))
    edges.append(spans[-1][2])
    return [(span[0], start, end) for span, start, end in zip(spans, edges, edges[1:], strict=False)]


def _glides(symbol: str) -> bool:
    return symbol in VOWELS or symbol in GLIDES


def _glide_shift_s(before: str, after: str) -> float:
    if before in GLIDES and after in VOWELS:
        return GLIDE_TO_VOWEL_S
    return VOWEL_TO_GLIDE_S if before in VOWELS and after in GLIDES else 0.0


def _measure(samples: NDArray[np.int16]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Spectra (F, ``BANDS``) and loudness (F,), dB, each ``HOP_S`` later than the one before."""
    size, hop = round(SPECTRUM_S * HEARING_HZ), round(HOP_S * HEARING_HZ)
    padded = np.concatenate([np.zeros(size // 2), samples, np.zeros(size)])
    windows = np.lib.stride_tricks.sliding_window_view(padded, size)[::hop]
    power = np.abs(np.fft.rfft(windows * np.hanning(size), axis=1)) ** 2
    mel = 2595.0 * np.log10(1.0 + np.fft.rfftfreq(size, 1 / HEARING_HZ) / 700.0)
    firsts = np.searchsorted(mel, np.linspace(mel[1], mel[-1], BANDS, endpoint=False))
    bands = np.add.reduceat(power, firsts, axis=1)
    return 10.0 * np.log10(bands + _FLOOR), 10.0 * np.log10(power.sum(axis=1) + _FLOOR)


def _find_change(time_s: float, sums: NDArray[np.float64]) -> float:
    """Where the mean spectra before and after differ most, weighed by how near it is to ``time_s``."""
    middle, reach, side = (round(each / HOP_S) for each in (time_s, REACH_S, SIDE_S))
    places = np.arange(max(side, middle - reach), min(len(sums) - 1 - side, middle + reach) + 1)
    if not len(places):
        return time_s
    steps = (sums[places + side] - 2 * sums[places] + sums[places - side]) / side
    nearness = np.exp(-(((places * HOP_S - time_s) / SPREAD_S) ** 2) / 2)
    return float(places[(np.sqrt((steps**2).mean(axis=1)) * nearness).argmax()] * HOP_S)


def _find_end(phone: Span, levels: NDArray[np.float64], background_db: float) -> float:
    """When a phone before a pause has died away; not after the search's own boundary."""
    first, last = round(phone[1] / HOP_S), round(phone[2] / HOP_S)
    heard = np.flatnonzero(levels[first:last] > _silent_db(levels[first:last], background_db))
    return (first + int(heard[-1]) + 1) * HOP_S if len(heard) else phone[2]


def _find_onset(phone: Span, levels: NDArray[np.float64], background_db: float) -> float:
    """When a phone after a pause begins to be heard."""
    first, middle = round(phone[1] / HOP_S), round((phone[1] + phone[2]) / 2 / HOP_S)
    start = max(0, first - round(ONSET_S / HOP_S))
    silent = np.flatnonzero(levels[start:middle] <= _silent_db(levels[first:middle], background_db))
    return (start + int(silent[-1]) + 1) * HOP_S if len(silent) else start * HOP_S


def _silent_db(levels: NDArray[np.float64], background_db: float) -> float:
    loudest = float(levels.max()) if len(levels) else background_db
    return max(background_db + ABOVE_BACKGROUND_DB, loudest - SILENT_DB)
