"""Brows that rise on accented words."""

from __future__ import annotations

from collections.abc import Sequence

from mien.core.chance import between, stream
from mien.timeline import Track

from .accents import Accent
from .curves import pulses

RAISE = (0.3, 0.75)
WANTED = 0.6  # at least, where somebody asked for stress
UP_S = 0.20
DOWN_S = 0.42
"""A brow begins to rise before the accented word and is highest in it.

Source: Kim, Cvejic and Davis 2014, Tracking eyebrows and head gestures associated with spoken prosody, Speech
Communication 57; amounts and times are our choice.
"""

FIRST, LATER = 0.45, 0.4
"""Chance of a raise: more with strong accents. Our choice; brows that rise on every word look frantic."""


def brow_raises(accents: Sequence[Accent], length_s: float, seed: int) -> Track:
    """The track of ``brow_raise``, 0..1."""
    chance = stream(seed, "brows")
    shapes = []
    for accent in accents:
        height, lucky = between(chance, *RAISE), chance.random() < FIRST + LATER * (accent.strength - 0.5)
        hold = between(chance, 0.04, 0.12)
        if accent.wanted:
            height = max(height, WANTED)
        if lucky or accent.wanted:
            height *= 0.5 + 0.5 * accent.strength
            start = max(0.0, accent.time_s - UP_S)
            top = max(accent.time_s, start + 0.1)
            shapes.append(([start, top, top + hold, top + hold + DOWN_S], [0.0, height, height, 0.0]))
    return pulses(shapes, length_s, name="brow_raise")
