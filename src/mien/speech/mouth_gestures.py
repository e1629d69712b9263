"""What each phone of an utterance asks of the mouth, when and how strongly; and the passes that shape it.

A pass takes gestures and an amount, 0 (off) over 1 (usual) to 2 at most, and gives gestures.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from mien.core import Cue

from .articulation import Articulation
from .mouth_table import BLENDED, GROUPS, Floats, PhoneTarget, phone_table, stress

GROUP_NAMES = tuple(GROUPS)
JAW, LIPS = GROUP_NAMES.index("jaw"), GROUP_NAMES.index("lips")

WINDOW_S = 0.45
"""How far a phone reaches; at the slowest rate 3 % of its dominance is left there."""

CORE_S = 0.08
"""What a phone's length exceeds this by, it spends on its target."""

ROUND_CORE_S = 0.0833
"""Time that lips spend on a rounded target at least: a frame at 12 frames a second."""

ROUND_DOMINANCE = 2.0
"""Least dominance of a rounded phone over the lips, so that no neighbours leave it less than half round."""

ROUNDED = 0.6
"""From this target on, lips are round: oo, w and both parts of oh."""

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

OPENING = [BLENDED.index(channel) for channel in ("jaw", "upper_lip", "lower_lip")]
"""Columns of the channels that stress scales."""

# (before, after) the centre, 1/s: jaws swing slowly around vowels, consonants are short visits; open fast, close
# slowly; lips move faster than the jaw; lip-heavy sounds start early. Order by the sources named above, amounts ours.
_RATES = {
    "jaw": {"vowel": (19.0, 14.0), "other": (34.0, 34.0)},
    "lips": {"vowel": (24.0, 20.0), "other": (30.0, 30.0)},
    "tongue": {"vowel": (40.0, 40.0), "other": (45.0, 45.0)},
}
_EARLY_RATE = 12.0
_PAUSE_RATES = (15.0, 15.0)
_MOST_RATE = 2000.0
"""Nothing is left of a phone's dominance 40 ms away from it, and its neighbour still has some where it begins."""


@dataclass(frozen=True, eq=False)
class Gestures:
    """All phones of an utterance as arrays, in order of time.

    Attributes:
        rows: row of the table of each phone.
        centre_s: (G,) s.
        length_s: (G,) s.
        stress: (G,) stress digit, -1 without one.
        half_core_s: (G, groups) s, half of the time that is spent on the target.
        targets: (G, channels) 0..1.
        dominance: (G, groups).
        rates: (G, groups, 2) 1/s, before and after the centre.
        lag_s: by which the jaw comes late.
        window_s: how far a phone reaches.
    """

    rows: tuple[PhoneTarget, ...]
    centre_s: Floats
    length_s: Floats
    stress: NDArray[np.int64]
    half_core_s: Floats
    targets: Floats
    dominance: Floats
    rates: Floats
    lag_s: float = 0.0
    window_s: float = WINDOW_S

    def between(self, start_s: float, end_s: float) -> Gestures:
        """The phones that reach into a stretch of time."""
        reach = self.window_s + self.lag_s + 0.5 * ROUND_CORE_S
        half = 0.5 * self.length_s
        low = int(np.searchsorted(self.centre_s + half, start_s - reach))
        high = int(np.searchsorted(self.centre_s - half, end_s + reach, side="right"))
        part = slice(low, high)
        return replace(
            self,
            rows=self.rows[part],
            centre_s=self.centre_s[part],
            length_s=self.length_s[part],
            stress=self.stress[part],
            half_core_s=self.half_core_s[part],
            targets=self.targets[part],
            dominance=self.dominance[part],
            rates=self.rates[part],
        )


Pass = Callable[[Gestures, float], Gestures]


def gestures(phones: Iterable[Cue], style: Articulation) -> Gestures:
    """The phones with their targets, dominance and rates, after all passes."""
    found = from_table(phones)
    for name, shape in PASSES.items():
        found = shape(found, getattr(style, name))
    return found


def from_table(phones: Iterable[Cue]) -> Gestures:
    """The phones as the table has them, before all passes."""
    cues = tuple(phones)
    table = phone_table()
    rows = tuple(table[cue.symbol] for cue in cues)
    number = np.array([table.index[row.phone] for row in rows], dtype=np.int64)
    start = np.array([cue.start_s for cue in cues])
    length = np.array([cue.end_s for cue in cues]) - start
    digits = (stress(cue.symbol) for cue in cues)
    return Gestures(
        rows=rows,
        centre_s=start + 0.5 * length,
        length_s=length,
        stress=np.array([-1 if digit is None else digit for digit in digits], dtype=np.int64),
        half_core_s=np.repeat(np.maximum(0.0, 0.5 * (length - CORE_S))[:, None], len(GROUPS), axis=1),
        targets=table.targets[number],
        dominance=table.dominance[number],
        rates=np.array([_rates(row) for row in rows]).reshape(len(rows), len(GROUPS), 2),
    )


def tell_apart(sounds: Gestures, amount: float) -> Gestures:
    """Targets between the mean of all vowels, or of all consonants, and each phone's own."""
    targets = sounds.targets.copy()
    for means, ours in zip(_means(), (_vowels(sounds), _consonants(sounds)), strict=True):
        targets[ours] = means + amount * (targets[ours] - means)
    return replace(sounds, targets=np.clip(targets, 0.0, 1.0))


def glide(sounds: Gestures, amount: float) -> Gestures:
    """Second targets of diphthongs between the first and their own."""
    second = np.flatnonzero([row.phone.endswith("+") for row in sounds.rows])
    targets = sounds.targets.copy()
    first = targets[second - 1]
    targets[second] = np.clip(first + amount * (targets[second] - first), 0.0, 1.0)
    return replace(sounds, targets=targets)


def weaken_unstressed(sounds: Gestures, amount: float) -> Gestures:
    """Vowels of less than main stress opening less."""
    scale = np.ones(len(sounds.rows))
    for digit, share in STRESS_SCALE.items():
        scale[_vowels(sounds) & (sounds.stress == digit)] = 1.0 - amount * (1.0 - share)
    targets = sounds.targets.copy()
    targets[:, OPENING] *= scale[:, None]
    return replace(sounds, targets=targets)


def spare_jaw(sounds: Gestures, amount: float) -> Gestures:
    """Short obstruents and nasals with less dominance over the jaw."""
    short = np.array([row.kind in ("stop", "nasal", "labial", "tongue") for row in sounds.rows], dtype=bool)
    short &= sounds.length_s < SHORT_S
    dominance = sounds.dominance.copy()
    dominance[short, JAW] *= 1.0 - amount * (1.0 - SHORT_SHARE)
    return replace(sounds, dominance=dominance)


def anticipate(sounds: Gestures, amount: float) -> Gestures:
    """Lip-heavy phones whose lips begin earlier: what is linear in the amount is the time that they take."""
    early = np.array([row.early for row in sounds.rows], dtype=bool)
    rates = sounds.rates.copy()
    usual = rates[early, LIPS, 0]
    rates[early, LIPS, 0] = 1.0 / (1.0 / usual + amount * (1.0 / _EARLY_RATE - 1.0 / usual))
    return replace(sounds, rates=rates, window_s=sounds.window_s * max(1.0, amount))


def follow(sounds: Gestures, amount: float) -> Gestures:
    """The jaw after the lips."""
    return replace(sounds, lag_s=amount * JAW_LAG_S)


def spread_dominance(sounds: Gestures, amount: float) -> Gestures:
    """Phones that reach farther, or with 0 not beyond their edges."""
    rates = np.minimum(_MOST_RATE, sounds.rates / max(amount, 1e-3))
    return replace(sounds, rates=rates, window_s=sounds.window_s * max(1.0, amount))


def keep_round(sounds: Gestures, amount: float) -> Gestures:
    """Rounded phones that keep the lips on their target for a frame's time, whatever is beside them."""
    column = BLENDED.index("round")
    rounded = np.array([row.targets[column] >= ROUNDED for row in sounds.rows], dtype=bool)
    core = sounds.half_core_s.copy()
    core[rounded, LIPS] = np.maximum(core[rounded, LIPS], 0.5 * amount * ROUND_CORE_S)
    dominance = sounds.dominance.copy()
    dominance[rounded, LIPS] = np.maximum(dominance[rounded, LIPS], amount * ROUND_DOMINANCE)
    return replace(sounds, half_core_s=core, dominance=dominance)


PASSES: Mapping[str, Pass] = MappingProxyType(
    {
        "targets": tell_apart,
        "diphthongs": glide,
        "stress": weaken_unstressed,
        "brief": spare_jaw,
        "anticipation": anticipate,
        "lag": follow,
        "dominance": spread_dominance,
        "rounding": keep_round,
    }
)
"""Pass of each amount, in the order in which they work."""


@lru_cache(maxsize=1)
def _means() -> tuple[Floats, Floats]:
    """(channels,) mean targets of the vowels, and of the consonants."""
    table = phone_table()
    vowel = np.array([row.is_vowel for row in table.rows])
    pause = np.array([row.kind == "pause" for row in table.rows])
    return table.targets[vowel].mean(axis=0), table.targets[~vowel & ~pause].mean(axis=0)


def _vowels(sounds: Gestures) -> NDArray[np.bool_]:
    return np.array([row.is_vowel for row in sounds.rows], dtype=bool)


def _consonants(sounds: Gestures) -> NDArray[np.bool_]:
    return np.array([not row.is_vowel and row.kind != "pause" for row in sounds.rows], dtype=bool)


def _rates(row: PhoneTarget) -> list[tuple[float, float]]:
    if row.kind == "pause":
        return [_PAUSE_RATES] * len(GROUPS)
    return [_RATES[name]["vowel" if row.is_vowel else "other"] for name in GROUPS]
