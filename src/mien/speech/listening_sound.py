"""Live sound as short spectra, and how loud each band is beside the voice: what a Listener looks at."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

HOP_S = 0.01
WINDOW_S = 0.025
BANDS = 24
LOW_HZ, HIGH_HZ = 80.0, 7000.0

LEAST_POWER = 1e-8
"""Power of a band, of full scale, that counts as no signal: below what 16 bits hold of it."""

FIRST_FRAMES = 60
"""With signal in them, in which the floor rises fast: what noise there is at the beginning is soon known."""

FIRST_FLOOR = 0.01
"""Of the first power with signal in it, where the floor begins: a stream may begin in the middle of a word."""

FAST_RISE, SLOW_RISE = 10.0**0.06, 10.0**0.006
"""Of the floor in a frame: 60 dB and 6 dB a second."""

SMOOTHING = 0.35
"""Share of a new frame in the power that the floor follows."""

NOISE_SHARE = 2.0
"""Mean power of noise over its floor, which lies near the least of what is smoothed."""

ATTACK, RELEASE_DB = 0.25, 0.02
"""How fast the loud level goes up, share of the way in a frame, and down, dB a frame, while somebody speaks."""

SPOKEN_DB = 25.0
"""Below the loud level where speech still is, dB."""

OVER_NOISE_DB, LEAST_LOUD_DB = 20.0, -62.0
"""The loud level is never nearer to the floor, and never lower, dB of full scale: noise alone is not loud."""

RANGE_DB = 50.0
"""Below the loud level down to which bands are told apart, dB."""


class Spectra:
    """Spectra of a stream, one for each hundredth of a second, however the stream is cut into blocks.

    Bands are the same at every rate; those above half of it are empty.
    """

    def __init__(self, rate_hz: int) -> None:
        self.rate_hz = rate_hz
        self._size = round(WINDOW_S * rate_hz)
        self._length = 1 << (self._size - 1).bit_length()
        self._taper = np.hanning(self._size + 2)[1:-1]
        self._weights = _band_weights(rate_hz, self._length) * (2.0 / (self._length * (self._taper**2).sum()))
        self._kept = np.zeros(0, dtype=np.int16)
        self._first = 0
        self.frames = 0

    def feed(self, samples: NDArray[np.int16]) -> list[Floats]:
        """The spectra that became whole, each (B,) power in the bands, of full scale."""
        self._kept = np.concatenate([self._kept, samples])
        found = []
        while (start := self.begin(self.frames) - self._first) + self._size <= len(self._kept):
            wave = self._kept[start : start + self._size] / 32768.0
            wave = (wave - wave.mean()) * self._taper
            spectrum = np.fft.rfft(wave, self._length)
            found.append((spectrum.real**2 + spectrum.imag**2) @ self._weights)
            self.frames += 1
        done = min(self.begin(self.frames) - self._first, len(self._kept))
        self._kept, self._first = self._kept[done:], self._first + done
        return found

    def begin(self, frame: int) -> int:
        """Number of the first sample of a frame."""
        return round(frame * HOP_S * self.rate_hz)

    def middle_s(self, frame: int) -> float:
        """Time of the middle of a frame."""
        return (self.begin(frame) + self._size / 2) / self.rate_hz


class Levels:
    """What is noise and how loud the voice is, followed frame by frame."""

    def __init__(self) -> None:
        self._smooth = self._floor = np.full(BANDS, LEAST_POWER)
        self._heard = 0
        self._loud_db = LEAST_LOUD_DB

    def step(self, power: Floats) -> tuple[Floats, float]:
        """The bands of a frame (B,), 0 at the bottom of the range or in noise, 1 as loud as all of a loud voice.

        The second is how loud the frame is beside loud ones, dB.
        """
        if power.sum() > BANDS * LEAST_POWER:
            if self._heard == 0:
                self._smooth, self._floor = power, FIRST_FLOOR * power
            self._smooth = self._smooth + SMOOTHING * (power - self._smooth)
            rise = FAST_RISE if self._heard < FIRST_FRAMES else SLOW_RISE
            self._floor = np.maximum(np.minimum(self._smooth, self._floor * rise), LEAST_POWER)
            self._heard += 1
        noise = NOISE_SHARE * self._floor
        clean = np.maximum(power - noise, 0.0)
        level_db = _decibel(clean.sum())
        if level_db > self._loud_db:
            self._loud_db += ATTACK * (level_db - self._loud_db)
        elif level_db > self._loud_db - SPOKEN_DB:
            self._loud_db -= RELEASE_DB
        loud_db = max(self._loud_db, _decibel(noise.sum()) + OVER_NOISE_DB, LEAST_LOUD_DB)
        share = clean / 10.0 ** (loud_db / 10.0)
        return 1.0 + 10.0 * np.log10(share + 10.0 ** (-RANGE_DB / 10.0)) / RANGE_DB, level_db - loud_db


def _decibel(power: float) -> float:
    return 10.0 * float(np.log10(power + 1e-12))


def _band_weights(rate_hz: int, length: int) -> Floats:
    """Triangles between frequencies that are evenly spaced in mel, (bins, B).

    Source: O'Shaughnessy 1987, Speech Communication, p. 150: mel = 2595 log10(1 + f / 700).
    """
    low, high = (2595.0 * np.log10(1.0 + np.array([LOW_HZ, HIGH_HZ]) / 700.0)).tolist()
    edges = 700.0 * (10.0 ** (np.linspace(low, high, BANDS + 2) / 2595.0) - 1.0)
    bins = np.fft.rfftfreq(length, 1.0 / rate_hz)[:, None]
    rising = (bins - edges[:-2]) / (edges[1:-1] - edges[:-2])
    falling = (edges[2:] - bins) / (edges[2:] - edges[1:-1])
    return np.maximum(np.minimum(rising, falling), 0.0)
