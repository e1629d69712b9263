"""What a face does by itself, without end: blinks, small saccades, breathing, sway; each can be switched."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from types import MappingProxyType

import numpy as np

from mien.gaze import blinks, head_sway, saccades
from mien.gaze.breathing import breathing
from mien.timeline import Track
from mien.timeline.rates import time_of
from mien.vocab import vocabulary

from .messages import IDLE_PARTS
from .mixing import CHANNELS
from .phrases import Piece
from .slices import Floats, Motors, Way, count_slices

STRETCH_S = 30.0
"""Each stretch begins and ends at rest, so that the next can follow; our choice."""

EASE_S = 0.3
"""A part comes and goes in this time when it is switched."""


class Idle:
    """The idle life of one face at a rate of loops; the same seed lives the same life.

    The stretch that is being played is kept, and the next is made meanwhile: one piece a loop, so that no loop takes
    long.
    """

    def __init__(self, seed: int, rate: Fraction, amounts: Mapping[str, float]) -> None:
        self.seed = seed
        self.rate = rate
        self.usual = tuple(float(amounts.get(part, 1.0)) for part in IDLE_PARTS)
        self.amounts = Motors(self.usual)
        self._loop = 0
        self._loops = max(1, int(STRETCH_S * rate))
        self._stretch: list[Piece] = []
        self._next = [*self._make(0)]
        self._making: Iterator[Piece] = iter(())

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

    def step(self, told: Sequence[tuple[int, int, float]] = (), share: float = 0.0) -> Floats:
        """(C,) what the channels do in the next loop.

        Args:
            told: part, channel and value of each that somebody else moves now.
            share: how much of these parts is theirs, 0 to 1.
        """
        number, place = divmod(self._loop, self._loops)
        if place == 0:
            # Where loops are long a stretch has fewer of them than pieces.
            self._stretch, self._next = [*self._next, *self._making], []
            self._making = self._make(number + 1)
        else:
            self._next += [piece for piece in (next(self._making, None),) if piece is not None]
        self._loop += 1
        self.amounts.step()
        amounts = self.amounts.values.tolist()
        values = np.zeros(len(vocabulary(CHANNELS)))
        theirs = {part for part, _, _ in told}
        for part, channel, track in self._stretch:
            values[channel] += amounts[part] * track[place] * (1.0 - share if part in theirs else 1.0)
        for part, channel, value in told:
            values[channel] += amounts[part] * value * share
        return values

    def _make(self, number: int) -> Iterator[Piece]:
        """The pieces of a stretch, each made when it is asked for."""
        index = vocabulary(CHANNELS).index
        length_s = time_of(float(self._loops), self.rate)
        times = time_of(np.arange(self._loops, dtype=np.float64), self.rate)
        # Seeds of stretches are far apart, so that faces with neighbouring seeds do not live the same minutes.
        seed = (self.seed * 1_000_003 + number) % 2**64
        for part, name in enumerate(IDLE_PARTS):
            for channel, track in _LIVES[name](length_s, seed).items():
                yield part, index[channel], track.evaluate(times)[0]


_LIVES: Mapping[str, Callable[[float, int], Mapping[str, Track]]] = MappingProxyType(
    {
        "blinks": blinks,
        "saccades": saccades,
        "breathing": lambda length_s, seed: {"head_nod": breathing(length_s, seed)},
        "sway": head_sway,
    }
)
