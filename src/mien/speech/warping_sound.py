"""What sound is compared by: for each two hundredth of a second its spectrum's shape, its loudness, how both change."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from .hearing_sound import HEARING_HZ

Floats = NDArray[np.float64]

STEP = 80
"""Samples from one frame to the next, at ``HEARING_HZ``: 5 ms."""

STEP_S = STEP / HEARING_HZ

WIDTH = 400
"""Samples that a frame sees: 25 ms."""

BINS = 512
BANDS, LOWEST_HZ, HIGHEST_HZ = 24, 100.0, 7000.0
SHAPES = 12
"""Cepstral coefficients."""

DECAY = 0.95
"""Weight of each coefficient, of that of the one before: fine detail of a spectrum tells voices apart, not sounds."""

LOUDNESS_WEIGHT, CHANGE_WEIGHT = 1.5, 1.5
"""Of loudness, and of changes, beside the shape of the spectrum.

Tried on four labelled and two aligned English sentences; the error changes by a tenth when either is halved or doubled.
"""

REACH = 4
"""Frames before and after that tell the change."""


def measure_frames(samples: NDArray[np.int16]) -> Floats:
    """Mel cepstrum and logarithm of power of each frame, (F, 13); frame n is centred on sample n * ``STEP``.

    Source: Davis and Mermelstein 1980, Comparison of parametric representations for monosyllabic word recognition.
    """
    count = len(samples) // STEP
    padded = np.concatenate([np.zeros(WIDTH // 2), samples / 32768.0, np.zeros(WIDTH // 2 + STEP)])
    padded[1:] -= 0.95 * padded[:-1]
    windows = np.lib.stride_tricks.sliding_window_view(padded, WIDTH)[::STEP][:count]
    power = np.abs(np.fft.rfft(windows * np.hanning(WIDTH), BINS)) ** 2
    bands = np.log(power @ _bands().T + 1e-6)
    cosines = np.cos(np.pi * np.outer(np.arange(1, SHAPES + 1), np.arange(BANDS) + 0.5) / BANDS)
    return np.hstack([bands @ cosines.T, np.log(power.sum(axis=1) + 1e-5)[:, None]])


def compare_frames(frames: Floats, spoken: NDArray[np.bool_]) -> Floats:
    """The frames as they are compared, (F, 26): whatever is the speaker's or the microphone's is taken out.

    Args:
        frames: as measured, of one speaker.
        spoken: (F,) the frames in which somebody speaks, whose mean becomes 0 and whose deviation 1.
    """
    level = _normalise(frames, spoken)
    change = _normalise(_slope(level), spoken)
    weights = np.append(DECAY ** np.arange(SHAPES), LOUDNESS_WEIGHT)
    return np.hstack([level * weights, CHANGE_WEIGHT * change * weights])


def _normalise(frames: Floats, spoken: NDArray[np.bool_]) -> Floats:
    chosen = frames[spoken] if spoken.any() else frames
    return (frames - chosen.mean(axis=0)) / (chosen.std(axis=0) + 1e-9)


def _slope(frames: Floats) -> Floats:
    """Change of each number from frame to frame, by a straight line through its neighbours."""
    padded = np.pad(frames, ((REACH, REACH), (0, 0)), mode="edge")
    count = len(frames)
    pairs = (step * (padded[REACH + step :][:count] - padded[REACH - step :][:count]) for step in range(1, REACH + 1))
    return sum(pairs, start=np.zeros_like(frames)) / (2 * sum(step * step for step in range(1, REACH + 1)))


@cache
def _bands() -> Floats:
    """(bands, bins) triangles, evenly spaced in mel."""
    edges = np.linspace(_mel(LOWEST_HZ), _mel(HIGHEST_HZ), BANDS + 2)
    edges = 700.0 * (10.0 ** (edges / 2595.0) - 1.0)
    low, middle, high = edges[:-2, None], edges[1:-1, None], edges[2:, None]
    hertz = np.arange(BINS // 2 + 1) * (HEARING_HZ / BINS)
    return np.maximum(0.0, np.minimum((hertz - low) / (middle - low), (high - hertz) / (high - middle)))


def _mel(hertz: float) -> float:
    return float(2595.0 * np.log10(1.0 + hertz / 700.0))
