"""Dominance functions: at each moment every phone pulls the mouth towards its target, the nearest ones most.

Source: Cohen and Massaro 1993, "Modeling coarticulation in synthetic visual speech": the value is the mean of the
targets weighted by D = a exp(-theta |t - c|), with one rate before the phone's centre and another after it.
Ours beside it: distance counts from the core of a long phone and starts smoothly, so that a curve has no corner.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mien.core import Cue, exact

from .mouth_table import BLENDED, GROUPS, Floats, PhoneTarget, phone_table, stress

WINDOW_S = 0.45
"""How far a phone reaches; at the slowest rate 3 % of its dominance is left there."""

CORE_S = 0.08
"""What a phone's length exceeds this by, it spends on its target."""

SMOOTH_S = 0.015
"""Radius of the rounding at the peak of a dominance function."""

SHORT_S = 0.10
SHORT_SHARE = 0.15
"""Jaw dominance left to obstruents and nasals shorter than ``SHORT_S``.

Source: Edwards et al. 2016 (JALI), section 4: they leave the jaw alone; sibilants narrow it whatever their length.
"""

JAW_LAG_S = 0.015
"""The jaw comes after the lips.

Source: Gracco 1988, Timing factors in the coordination of speech movements, Journal of Neuroscience 8: peaks of
velocity of upper lip, lower lip and jaw in this order. The amount is our choice.
"""

STRESS_SCALE = {0: 0.62, 1: 1.0, 2: 0.85}
"""How wide a vowel opens by its stress: jaws open wider under stress (Macchi 1985), the amounts are our choice."""

OPENING = ("jaw", "upper_lip", "lower_lip")
"""Channels that stress scales."""

# (before, after) the centre, 1/s: jaws swing slowly around vowels, consonants are short visits; open fast, close
# slowly; lips move faster than the jaw; lip-heavy sounds start early. Order by the sources named above, amounts ours.
_RATES = {
    "jaw": {"vowel": (19.0, 14.0), "other": (34.0, 34.0)},
    "lips": {"vowel": (24.0, 20.0), "other": (30.0, 30.0)},
    "tongue": {"vowel": (40.0, 40.0), "other": (45.0, 45.0)},
}
_EARLY_RATE = 12.0
_PAUSE_RATES = (15.0, 15.0)


@dataclass(frozen=True, eq=False)
class Gestures:
    """All phones of an utterance as arrays, in order of time.

    Attributes:
        centre_s: (G,) s.
        half_core_s: (G,) s, half of the time that is spent on the target.
        targets: (G, channels) 0..1.
        dominance: (G, groups).
        rates: (G, groups, 2) 1/s, before and after the centre.
    """

    centre_s: Floats
    half_core_s: Floats
    targets: Floats
    dominance: Floats
    rates: Floats

    def between(self, start_s: float, end_s: float) -> Gestures:
        """The phones that reach into a stretch of time."""
        reach = WINDOW_S + JAW_LAG_S
        starts, ends = self.centre_s - self.half_core_s, self.centre_s + self.half_core_s
        low = int(np.searchsorted(ends, start_s - reach))
        high = int(np.searchsorted(starts, end_s + reach, side="right"))
        part = slice(low, high)
        return Gestures(
            self.centre_s[part], self.half_core_s[part], self.targets[part], self.dominance[part], self.rates[part]
        )


def gestures(phones: Sequence[Cue]) -> Gestures:
    """The phones with their targets and dominance, stress and length taken into account."""
    table = phone_table()
    rows = [table[cue.symbol] for cue in phones]
    number = np.array([table.index[row.phone] for row in rows], dtype=np.int64)
    start = np.array([cue.start_s for cue in phones])
    end = np.array([cue.end_s for cue in phones])
    length = end - start
    targets = table.targets[number]
    opening = [BLENDED.index(channel) for channel in OPENING]
    targets[:, opening] *= np.array([_stress_scale(cue, row) for cue, row in zip(phones, rows, strict=True)])[:, None]
    dominance = table.dominance[number]
    brief = np.array([row.kind in ("stop", "nasal", "labial", "tongue") for row in rows]) & (length < SHORT_S)
    dominance[:, 0] = np.where(brief, SHORT_SHARE * dominance[:, 0], dominance[:, 0])
    return Gestures(
        centre_s=0.5 * (start + end),
        half_core_s=np.maximum(0.0, 0.5 * (length - CORE_S)),
        targets=targets,
        dominance=dominance,
        rates=np.array([_rates(row) for row in rows]).reshape(len(rows), len(GROUPS), 2),
    )


def blend(sounds: Gestures, times_s: Floats) -> Floats:
    """(N, channels) blended values at sorted times; work and memory grow with the phones near those times."""
    near = sounds.between(float(times_s[0]), float(times_s[-1]))
    out = np.zeros((len(times_s), len(BLENDED)))
    column = 0
    for group, (name, channels) in enumerate(GROUPS.items()):
        lag = JAW_LAG_S if name == "jaw" else 0.0
        phone, sample = _pairs(near, times_s, lag)
        way = times_s[sample] - (near.centre_s[phone] + lag)
        outside = np.maximum(0.0, np.abs(way) - near.half_core_s[phone])
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


def _pairs(near: Gestures, times_s: Floats, lag_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Numbers of phone and sample of every pair within reach of one another."""
    reach = near.half_core_s + WINDOW_S
    low = np.searchsorted(times_s, near.centre_s + lag_s - reach)
    high = np.searchsorted(times_s, near.centre_s + lag_s + reach)
    counts = high - low
    phone = np.repeat(np.arange(len(counts)), counts)
    first = np.concatenate([[0], np.cumsum(counts)[:-1]]) if len(counts) else np.zeros(0, dtype=np.int64)
    sample = np.arange(int(counts.sum())) - first[phone] + low[phone]
    return phone, sample


def _stress_scale(cue: Cue, row: PhoneTarget) -> float:
    level = stress(cue.symbol)
    return STRESS_SCALE.get(level, 1.0) if row.is_vowel and level is not None else 1.0


def _rates(row: PhoneTarget) -> list[tuple[float, float]]:
    if row.kind == "pause":
        return [_PAUSE_RATES] * len(GROUPS)
    out = []
    for name in GROUPS:
        before, after = _RATES[name]["vowel" if row.is_vowel else "other"]
        out.append((min(before, _EARLY_RATE) if row.early and name == "lips" else before, after))
    return out
