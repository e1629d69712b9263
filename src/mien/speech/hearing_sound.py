"""Sound made ready to be listened to: loudness, pauses, and pieces at the rate that the recogniser was trained with."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import ceil, gcd

import numpy as np
from numpy.typing import NDArray

from mien.core import Sound

HEARING_HZ = 16000
"""Samples a second that the acoustic model was trained with."""

FRAME_S = 0.01
BLOCK_S = 10.0
"""Sound looked at at once, seconds."""

LEVEL = 3000.0
"""Root mean square of the loud parts after levelling, of 32767."""

DITHER = 3.0
"""Standard deviation of the noise put under everything, of 32767: digital silence has no logarithm."""

FULL_SCALE = 32700
"""Samples from here on count as clipped when they stand together."""

QUIETER_DB = 35.0
"""Below the loud parts by which a frame is quiet, dB."""

QUIET_SHARE = 0.25
"""Of the way in dB from the quietest frames to the loudest, up to which a frame is quiet: noise is never silent."""

SPOKEN_DB, HEARD_DB = 30.0, 60.0
"""Below the loudest frame where speech still is, and below loud speech where background still is, dB."""

LEAST_RANGE_DB = 10.0
"""Between loud and quiet: without any pause there is nothing quiet, dB."""

MARGIN_S = 0.3
"""Silence that a piece keeps before and after what is heard in it, seconds."""

LOBES = 16
"""Zero crossings of the resampling filter on each side."""


@dataclass(frozen=True, eq=False)
class Loudness:
    """How loud a sound is over time.

    Attributes:
        level_db: (F,) one for each hundredth of a second; 0 is full scale.
        loud_db: of the loud parts.
        low_db: of the quietest parts.
        quiet_db: up to which a frame is quiet.
        clipped_share: of all samples.
    """

    level_db: NDArray[np.float32]
    loud_db: float
    low_db: float
    quiet_db: float
    clipped_share: float

    def count_loud_s(self, start_s: float, end_s: float) -> float:
        """How much of the time between two is not quiet, seconds."""
        first, last = round(start_s / FRAME_S), round(end_s / FRAME_S)
        return float((self.level_db[first:last] > self.quiet_db).sum()) * FRAME_S

    def trim(self, start_s: float, end_s: float) -> tuple[float, float]:
        """What is heard between two times, with a little silence before and after it."""
        first, last = round(start_s / FRAME_S), round(end_s / FRAME_S)
        loud = np.flatnonzero(self.level_db[first:last] > self.quiet_db)
        if not len(loud):
            return start_s, start_s
        begin_s = start_s + int(loud[0]) * FRAME_S - MARGIN_S
        stop_s = start_s + (int(loud[-1]) + 1) * FRAME_S + MARGIN_S
        return max(start_s, begin_s), min(end_s, stop_s)

    def find_cut_s(self, earliest_s: float, latest_s: float, width_s: float = 0.15) -> float:
        """Middle of the quietest stretch between two times."""
        first, last, width = round(earliest_s / FRAME_S), round(latest_s / FRAME_S), round(width_s / FRAME_S)
        power = 10.0 ** (self.level_db[first:last].astype(np.float64) / 10)
        if len(power) <= width:
            return latest_s
        sums = np.cumsum(np.concatenate([[0.0], power]))
        return (first + int((sums[width:] - sums[:-width]).argmin()) + width / 2) * FRAME_S


def measure_loudness(sound: Sound) -> Loudness:
    """The loudness of a sound, read a few seconds at a time."""
    size = FRAME_S * sound.rate_hz  # a frame may end between two samples: 22050 Hz has frames of 220 and 221
    block = round(BLOCK_S * sound.rate_hz)
    powers, clipped = [], 0
    for first in range(0, len(sound.samples), block):
        samples = sound.samples[first : first + block]
        high = np.abs(samples.astype(np.int32)) >= FULL_SCALE
        clipped += int((high[1:] & high[:-1]).sum())
        edges = np.rint(np.arange(int(len(samples) / size + 1e-9) + 1) * size).astype(np.int64)
        if len(edges) > 1:
            whole, counts = samples[: edges[-1]].astype(np.float64), np.diff(edges)
            mean = np.add.reduceat(whole, edges[:-1]) / counts
            powers.append(np.add.reduceat(whole * whole, edges[:-1]) / counts - mean**2)
    power = np.concatenate([np.zeros(0), *powers]) / 32768.0**2
    level = 10 * np.log10(np.maximum(power, 1e-10)).astype(np.float32)
    loud, low = _find_range(level)
    quiet = max(loud - QUIETER_DB, low + QUIET_SHARE * (loud - low))
    return Loudness(level, loud, low, quiet, clipped / max(1, len(sound.samples)))


def _find_range(level_db: NDArray[np.float32]) -> tuple[float, float]:
    """Levels of the loud and the quiet parts, dB, however much silence there is besides."""
    if not len(level_db):
        return -100.0, -100.0
    loud = float(np.percentile(level_db[level_db >= level_db.max() - SPOKEN_DB], 80))
    return loud, min(float(np.percentile(level_db[level_db >= loud - HEARD_DB], 5)), loud - LEAST_RANGE_DB)


def take_piece(sound: Sound, start_s: float, end_s: float, loudness: Loudness) -> NDArray[np.int16]:
    """Samples (N,) from one time to another at ``HEARING_HZ``, levelled, with a little noise under them."""
    count = round((end_s - start_s) * HEARING_HZ)
    found = _resample(sound, start_s, count)
    gain = LEVEL / (32768.0 * 10.0 ** (loudness.loud_db / 20)) if loudness.loud_db > -99 else 1.0
    noise = np.random.default_rng(0).normal(0.0, DITHER, count)
    return np.rint(np.clip(found * gain + noise, -32768, 32767)).astype(np.int16)


def _resample(sound: Sound, start_s: float, count: int) -> NDArray[np.float64]:
    """``count`` samples at ``HEARING_HZ`` from a time on; zeros beyond the ends of the sound."""
    common = gcd(HEARING_HZ, sound.rate_hz)
    up, down = HEARING_HZ // common, sound.rate_hz // common
    taps = _filters(up, down)
    width = taps.shape[1]
    begin = round(start_s * sound.rate_hz) - width // 2 + 1
    needed = ceil(count / up) * down + width
    source = sound.samples[max(0, begin) : max(0, begin + needed)].astype(np.float64)
    source = np.concatenate([np.zeros(max(0, -begin)), source])[:needed]
    source = np.concatenate([source, np.zeros(needed - len(source))])
    windows = np.lib.stride_tricks.sliding_window_view(source, width)
    found = np.empty((ceil(count / up), up))
    for phase in range(up):
        found[:, phase] = windows[phase * down // up :: down][: len(found)] @ taps[phase]
    return found.ravel()[:count]


@cache
def _filters(up: int, down: int) -> NDArray[np.float64]:
    """For each of ``up`` phases between two samples the weights of the samples around it, (up, T).

    A sinc that ends at 0.45 of the lower rate, under a Blackman window.
    """
    cutoff = 0.9 * min(1.0, up / down)
    half = ceil(LOBES / cutoff)
    offsets = np.arange(-half + 1, half + 1)[None, :] - (np.arange(up) * down % up / up)[:, None]
    share = offsets / half
    window = 0.42 + 0.5 * np.cos(np.pi * share) + 0.08 * np.cos(2 * np.pi * share)
    weights = np.sinc(cutoff * offsets) * window * (np.abs(share) < 1)
    return weights / weights.sum(axis=1, keepdims=True)
