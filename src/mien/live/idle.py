"""What a face does by itself, without end: blinks, small saccades, breathing, sway; each can be switched."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

import numpy as np

from mien.gaze import blinks, head_sway, saccades
from mien.gaze.breathing import breathing
from mien.timeline import Track
from mien.timeline.rates import time_of
from mien.vocab import vocabulary

from .messages import IDLE_PARTS
from .mixing import CHANNELS
from .slices import Floats, Motors, Way, count_slices

STRETCH_S = 30.0
"""Made at once. Each stretch begins and ends at rest, so that the next can follow; our choice."""

EASE_S = 0.3
"""A part comes and goes in this time when it is switched."""


class Idle:
    """The idle life of one face at a rate of loops; the same seed lives the same life.

    Only the stretch that is being played is kept.
    """

    def __init__(self, seed: int, rate: Fraction, amounts: Mapping[str, float]) -> None:
        self.seed = seed
        self.rate = rate
        self.usual = tuple(float(amounts.get(part, 1.0)) for part in IDLE_PARTS)
        self.amounts = Motors(self.usual)
        self._loop = 0
        self._loops = max(1, int(STRETCH_S * rate))
        self._stretch = np.empty((0, 0))

    def switch(self, amounts: Mapping[str, float]) -> None:
        """Change how much there is of some parts."""
        for part, amount in amounts.items():
            self.amounts.move(IDLE_PARTS.index(part), Way(amount, count_slices(EASE_S * float(self.rate), 1.0)))

    def fade(self, slices: int) -> None:
        """Let all parts come to rest."""
        for part in range(len(IDLE_PARTS)):
            self.amounts.move(part, Way(0.0, slices))

    def restore(self, slices: int) -> None:
        """Let all parts be as they were in the beginning."""
        for part, amount in enumerate(self.usual):
            self.amounts.move(part, Way(amount, slices))

    def step(self) -> Floats:
        """(C,) what the channels do in the next loop."""
        number, place = divmod(self._loop, self._loops)
        if place == 0:
            self._stretch = self._make(number)
        self._loop += 1
        self.amounts.step()
        parts = self._stretch[:, place].reshape(len(IDLE_PARTS), -1)
        values = np.zeros(parts.shape[1])
        for part, amount in zip(parts, self.amounts.values.tolist(), strict=True):
            values += amount * part
        return values

    def _make(self, number: int) -> Floats:
        """(parts x C, loops) values of a stretch."""
        channels = vocabulary(CHANNELS)
        length_s = time_of(float(self._loops), self.rate)
        times = time_of(np.arange(self._loops, dtype=np.float64), self.rate)
        # Seeds of stretches are far apart, so that faces with neighbouring seeds do not live the same minutes.
        seed = (self.seed * 1_000_003 + number) % 2**64
        lives: dict[str, Mapping[str, Track]] = {
            "blinks": blinks(length_s, seed),
            "saccades": saccades(length_s, seed),
            "breathing": {"head_nod": breathing(length_s, seed)},
            "sway": head_sway(length_s, seed),
        }
        made = np.zeros((len(IDLE_PARTS), len(channels), self._loops))
        for part, name in enumerate(IDLE_PARTS):
            for channel, track in lives[name].items():
                made[part, channels.index[channel]] = track.evaluate(times)[0]
        return made.reshape(-1, self._loops)
