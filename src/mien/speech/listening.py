"""A live voice listened to: what the mouth does a moment after the sound, without words or phones.

Nothing is recognised. Short spectra are followed by a small regression that was learned from synthetic voices, so a
mouth opens, rounds and shuts about as the sound asks, and knows nothing of the words (ADR 0018). A recording is heard
better by ``mien.speech.hear``.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.core import RangeError

from .listening_model import AHEAD, SPAN, load_layers, regress
from .listening_sound import BANDS, HOP_S, WINDOW_S, Floats, Levels, Spectra
from .mouth import MOUTH_CHANNELS

LEAST_HZ, MOST_HZ = 8000, 96000

DELAY_S = AHEAD * HOP_S + WINDOW_S / 2
"""How far behind the newest sample the mouth is, seconds; it is told every ``HOP_S``."""

LOUD_DB = -26.0
"""Beside the loud level: from here on somebody speaks, dB."""

LOUD_FRAMES, OF_FRAMES = 3, 10
"""So many of the newest frames must be loud, or the mouth shuts."""

RISE, FALL = 0.34, 0.125
"""How fast the mouth is let go and shut, share in a frame."""

LIVELY = 1.15
"""How much larger all else is made: what is guessed lies nearer to the mean than what is meant."""

CERTAIN: Mapping[str, tuple[float, float]] = {"closure": (0.3, 0.7), "tuck": (0.25, 0.6)}
"""What is held is held or not: up to the first it counts as nothing, from the second on as all."""


@dataclass(frozen=True)
class Heard:
    """What the mouth does at a moment of the sound.

    Attributes:
        time_s: from the first sample on, seconds.
        channels: of ``MOUTH_CHANNELS``, each 0..1; all are 0 where nobody speaks.
    """

    time_s: float
    channels: Mapping[str, float]


class Listener:
    """Follows one stream of sound; the same samples give the same, however they are cut into blocks.

    Args:
        rate_hz: samples a second, 8000 to 96000.

    Raises:
        RangeError: the rate is another.
    """

    def __init__(self, rate_hz: int) -> None:
        if not LEAST_HZ <= rate_hz <= MOST_HZ:
            raise RangeError(f"sound at {rate_hz} samples a second — want {LEAST_HZ} to {MOST_HZ}")
        self._spectra, self._levels, self._layers = Spectra(rate_hz), Levels(), load_layers()
        self._seen = np.zeros((SPAN, BANDS))
        self._loud: deque[bool] = deque(maxlen=OF_FRAMES)
        self._gate = 0.0

    @property
    def rate_hz(self) -> int:
        """Samples a second."""
        return self._spectra.rate_hz

    def feed(self, samples: NDArray[np.int16]) -> tuple[Heard, ...]:
        """What is known by these samples, in order of time."""
        first = self._spectra.frames
        found = []
        for frame, power in enumerate(self._spectra.feed(samples), first - AHEAD):
            values = self._step(power)
            if frame >= 0:
                channels = dict(zip(MOUTH_CHANNELS, values.tolist(), strict=True))
                found.append(Heard(self._spectra.middle_s(frame), channels))
        return tuple(found)

    def _step(self, power: Floats) -> Floats:
        """(C,) channels ``AHEAD`` frames before the newest one, whose bands (B,) come in."""
        bands, level_db = self._levels.step(power)
        self._seen[:-1] = self._seen[1:]
        self._seen[-1] = bands
        self._loud.append(level_db > LOUD_DB)
        speaks = sum(self._loud) >= LOUD_FRAMES
        self._gate = min(1.0, self._gate + RISE) if speaks else max(0.0, self._gate - FALL)
        if not self._gate:
            return np.zeros(len(MOUTH_CHANNELS))
        values = regress(self._seen, self._layers)
        for row, name in enumerate(MOUTH_CHANNELS):
            nothing, all_of_it = CERTAIN.get(name, (0.0, 1.0 / LIVELY))
            values[row] = (values[row] - nothing) / (all_of_it - nothing)
        return np.clip(values, 0.0, 1.0) * self._gate
