"""Where the eyes rest: on the viewer, with small shifts and now and then a glance away."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from math import sqrt

import numpy as np

from mien.core import SILENCE, Cue
from mien.core.chance import around, between, stream
from mien.timeline import Track

FIXATION_S = (0.35, 1.9)
GLANCE_S = (0.35, 0.9)
"""How long the eyes rest on the viewer's face, and elsewhere: our choice."""

SHIFT_DEG = (1.8, 1.1)
"""Reach of the small shifts over the viewer's face, sideways and upwards: our choice."""

AWAY = 0.16
AWAY_TURN_DEG = (3.0, 6.0)
AWAY_NOD_DEG = (-2.5, 3.5)
"""Chance and size of a glance away.

Source: talkers look away about a quarter of the time (Lee, Badler and Badler 2002, Eyes Alive, ACM TOG 21, table 1);
less here, for a face that speaks to its viewer; the numbers are our choice.
"""

SETTLE_S = 0.45
"""The eyes are back on the viewer this long before the end."""


def saccade_length_s(amplitude_deg: float) -> float:
    """Duration of a saccade: 21 ms + 2.2 ms a degree.

    Source: Carpenter 1988, Movements of the Eyes (the main sequence).
    """
    return 0.021 + 0.0022 * amplitude_deg


def saccades(
    length_s: float, seed: int, phones: Sequence[Cue] = (), rests: Sequence[tuple[float, float]] = ()
) -> dict[str, Track]:
    """Tracks of ``eye_turn`` and ``eye_nod``, degrees: rests with quick ways between; 0 is straight at the viewer.

    Args:
        length_s: for how long.
        seed: of the generator; the same seed looks alike.
        phones: what is said; the eyes leave the viewer only while something is.
        rests: (from, to) s, in order; meanwhile the eyes are on the viewer and hold still.
    """
    chance = stream(seed, "saccades")
    spoken = [cue for cue in phones if cue.symbol != SILENCE]
    keys = [(0.0, 0.0, 0.0)]
    away = False
    moment = between(chance, *FIXATION_S)
    coming = deque(rests)
    while moment < length_s - SETTLE_S - 0.1:
        if coming and coming[0][0] <= moment:
            start_s, end_s = coming.popleft()
            keys += _saccade(keys[-1], max(start_s, keys[-1][0]), (0.0, 0.0))
            moment, away = max(end_s, keys[-1][0]), False
            continue
        wanted = chance.random() < AWAY
        away = wanted and not away and bool(spoken) and spoken[0].start_s < moment < spoken[-1].end_s - 0.4
        keys += _saccade(keys[-1], moment, _look_away(chance) if away else _look_at_viewer(chance))
        moment = keys[-1][0] + between(chance, *(GLANCE_S if away else FIXATION_S))
    keys += _saccade(keys[-1], max(keys[-1][0], length_s - SETTLE_S), (0.0, 0.0))
    keys += [(length_s, 0.0, 0.0)] if length_s > keys[-1][0] else []
    times, turns, nods = zip(*keys, strict=True)
    return {
        "eye_turn": Track.from_keys(times, turns, name="eye_turn"),
        "eye_nod": Track.from_keys(times, nods, name="eye_nod"),
    }


def _saccade(
    last: tuple[float, float, float], start_s: float, aim: tuple[float, float]
) -> list[tuple[float, float, float]]:
    """Keys of a rest until ``start_s`` and a quick way to where the eyes aim next."""
    last_s, turn, nod = last
    aside, up = aim[0] - turn, aim[1] - nod
    end = start_s + saccade_length_s(sqrt(aside * aside + up * up))
    # A straight way: how it speeds up and slows down within 40 ms is not seen at any frame rate.
    return [*([(start_s, turn, nod)] if start_s > last_s else []), (end, *aim)]


def _look_at_viewer(chance: np.random.Generator) -> tuple[float, float]:
    return around(chance, 0.0, SHIFT_DEG[0]), around(chance, 0.0, SHIFT_DEG[1])


def _look_away(chance: np.random.Generator) -> tuple[float, float]:
    side = 1.0 if chance.random() < 0.5 else -1.0
    return side * between(chance, *AWAY_TURN_DEG), between(chance, *AWAY_NOD_DEG)
