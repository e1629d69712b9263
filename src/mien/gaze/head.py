"""Small movements of the head: slow sway all the time, nods with accents."""

from __future__ import annotations

from collections.abc import Sequence

from mien.core.chance import around, between, stream
from mien.timeline import Track

from .accents import Accent
from .curves import pulses, way

SWAY_DEG = {"head_turn": 3.0, "head_nod": 1.3, "head_tilt": 2.4}
"""Greatest sway about each axis: our choice, a person who sits still and talks."""

SWAY_S = (1.1, 2.6)
"""Time from one resting place of the sway to the next: our choice."""

SETTLE_S = 0.6

NOD_DEG = (1.2, 3.0)
WANTED_DEG = 2.6  # at least, where somebody asked for stress
NOD_DOWN_S = 0.16
NOD_UP_S = 0.34
NOD_LAG_S = 0.05
"""A nod begins with the accented syllable and is lowest after its middle.

Source: Kim, Cvejic and Davis 2014, Tracking eyebrows and head gestures associated with spoken prosody, Speech
Communication 57 (head movement begins with the accented word, its peak comes after it); amounts are our choice.
"""


def head_sway(length_s: float, seed: int) -> dict[str, Track]:
    """Tracks of ``head_turn``, ``head_nod`` and ``head_tilt``, degrees: from rest, never quite still, to rest."""
    return {channel: _sway(length_s, seed, channel, reach) for channel, reach in SWAY_DEG.items()}


def _sway(length_s: float, seed: int, channel: str, reach: float) -> Track:
    chance = stream(seed, f"sway {channel}")
    times, places = [0.0], [0.0]
    while True:
        moment = times[-1] + between(chance, *SWAY_S)
        if moment > length_s - SETTLE_S:
            break
        times.append(moment)
        places.append(around(chance, 0.0, reach))
    times.append(max(length_s, times[-1]))
    places.append(0.0)
    return way(times, places, name=channel)


def nods(accents: Sequence[Accent], length_s: float, seed: int) -> Track:
    """The track of ``head_nod`` that dips, degrees, with the stronger accents."""
    chance = stream(seed, "nods")
    shapes = []
    for accent in accents:
        depth, lucky = between(chance, *NOD_DEG), chance.random() < 0.35 + 0.5 * accent.strength
        if accent.wanted:
            depth = max(depth, WANTED_DEG)
        if lucky or accent.wanted:
            lowest = accent.time_s + NOD_LAG_S
            start = max(0.0, lowest - NOD_DOWN_S)
            shapes.append(([start, lowest, lowest + NOD_UP_S], [0.0, -depth * (0.5 + 0.5 * accent.strength), 0.0]))
    return pulses(shapes, length_s, name="head_nod")
