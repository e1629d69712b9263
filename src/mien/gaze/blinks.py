"""Blinks: how often, when in a sentence, how fast."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from mien.core import SILENCE, Cue
from mien.core.chance import around, between, stream
from mien.timeline import Track

from .curves import pulses

SPEAKING_A_MINUTE = 20.0
RESTING_A_MINUTE = 17.0
"""Blinks a minute while speaking and at rest.

Source: Bentivoglio and others 1997, Analysis of blink rate patterns in normal subjects, Movement Disorders 12: 17 at
rest, 26 in conversation, 4.5 while reading. Who says a given text does something between the last two.
"""

CLOSE_S = 0.085
SHUT_S = 0.045
OPEN_S = 0.19
"""Lids shut in about 80 ms and open at half the speed.

Source: closing 78 ms in scleral-coil studies of spontaneous blinks; opening 40 to 47 % slower at peak (Sforza and
others 2008, Ophthalmic and Physiological Optics 28). Measured lids stay shut for 13 ms; here longer than a frame of a
24 fps film, so that no blink is half seen.
"""

PAUSE_S = 0.12
NEAR_S = 0.9
"""A blink that is due within this time of a pause is made there.

Source: Nakano and Kitazawa 2010, Eyeblink entrainment at breakpoints of speech, Experimental Brain Research 205; the
time is our choice.
"""

LEAST_APART_S = 0.7
TWICE = 0.07
"""Chance of a second blink right after one: our choice."""


def blinks(
    length_s: float, seed: int, phones: Sequence[Cue] = (), *, often: float = 1.0, ends_s: Sequence[float] = ()
) -> dict[str, Track]:
    """Tracks of the channels ``blink.left`` and ``blink.right``, 0 open to 1 shut.

    Args:
        length_s: for how long.
        seed: of the generator; the same seed blinks alike.
        phones: what is said; a face that says nothing blinks less, and pauses draw blinks to them.
        often: factor on the rate, above 0.
        ends_s: where phrases end; they draw blinks as pauses do.
    """
    shapes = [_shape(start) for start in blink_times(length_s, seed, phones, often=often, ends_s=ends_s)]
    return {f"blink.{side}": pulses(shapes, length_s, name=f"blink.{side}", steps=4) for side in ("left", "right")}


def blink_times(
    length_s: float, seed: int, phones: Sequence[Cue] = (), *, often: float = 1.0, ends_s: Sequence[float] = ()
) -> list[float]:
    """When blinks start, s; each is over before the end."""
    chance = stream(seed, "blinks")
    speaking = any(cue.symbol != SILENCE for cue in phones)
    mean = 60.0 / (often * (SPEAKING_A_MINUTE if speaking else RESTING_A_MINUTE))
    pauses = np.array(sorted({*_pauses(phones), *ends_s}))
    whole = CLOSE_S + SHUT_S + OPEN_S
    out: list[float] = []
    due = between(chance, 0.25, 0.9) * mean
    while due < length_s:
        start = _draw_to_pause(due, pauses)
        after = out[-1] + LEAST_APART_S if out else 0.0
        start = max(start, after)
        if start + whole <= length_s:
            out.append(start)
            if chance.random() < TWICE and start + 2.2 * whole <= length_s:
                out.append(start + 1.15 * whole)
        due = max(due, start) + around(chance, mean, 0.85 * mean)
    return out


def _pauses(phones: Iterable[Cue]) -> list[float]:
    """Starts of the pauses, s, but for the one before the first word."""
    return [cue.start_s for cue in phones if cue.symbol == SILENCE and cue.length_s >= PAUSE_S and cue.start_s > 0.0]


def _draw_to_pause(due: float, pauses: np.ndarray) -> float:
    if len(pauses) == 0:
        return due
    right = int(np.searchsorted(pauses, due))
    near = [float(pauses[i]) for i in (right - 1, right) if 0 <= i < len(pauses)]
    best = min(near, key=lambda pause: abs(pause - due))
    return best if abs(best - due) <= NEAR_S else due


def _shape(start: float) -> tuple[list[float], list[float]]:
    """A blink: fast shut, a moment, most of the way open fast, the rest slowly."""
    shut = start + CLOSE_S
    opening = shut + SHUT_S
    return (
        [start, shut, opening, opening + 0.6 * OPEN_S, opening + OPEN_S],
        [0.0, 1.0, 1.0, 0.16, 0.0],
    )
