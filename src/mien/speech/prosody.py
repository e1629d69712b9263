"""How something is said: its pitch and loudness, the words that stand out by them, and where phrases end.

All sums are of whole numbers, so that the same sound has the same prosody, and a face the same movements, everywhere.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from mien.core import SILENCE, Cue, Sound

Floats = NDArray[np.float64]

STEP_S = 0.01
WINDOW_STEPS = 3
"""Length of a step, and how many steps are looked at together: a window of 30 ms."""

LOW_HZ, HIGH_HZ = 60.0, 500.0
"""Between the lowest man's and the highest child's voice."""

ANALYSIS_HZ = 8000
"""Samples a second that are enough for pitch; more of them are summed to so many, or to nearly twice as many."""

DIP = 0.15
"""A period must repeat itself better than this. Source: de Cheveigné and Kawahara 2002, YIN, JASA 111, step 4."""

QUIET_SHARE = 0.03
"""Loudness, as a share of the greatest, below which no pitch is looked for."""

CHUNK_STEPS = 3000
"""Steps that are measured at once; bounds the memory of a long sound."""

SPREADS = {"pitch": 0.25, "loudness": 0.6, "length": 0.6}
SHARES = {"pitch": 0.4, "loudness": 0.35, "length": 0.25}
"""How far above the median of the words is far, and how much each counts.

Source: pitch, loudness and length all make a word stand out (Kochanski and others 2005, Loudness predicts prominence,
JASA 118); the numbers are our choice.
"""

PAUSE_S = 0.12
SHORTEST_PHRASE_S = 0.5
RESET = 1.2
EDGE_S = 0.12
DIM_SHARE = 0.4
"""A phrase ends before a pause; also where the voice grows dim and begins anew, higher by this factor, if it has
lasted for a while.

Source: pitch falls to the end of a phrase and is reset at the next (Ladd 2008, Intonational Phonology, chapter 1);
the numbers are our choice.
"""


@dataclass(frozen=True, eq=False)
class Contour:
    """Pitch and loudness in steps.

    Attributes:
        step_s: length of a step, seconds; step k has its middle at (k + 1/2) ``step_s``.
        pitch_hz: (N,) Hz, 0 where there is none.
        loudness: (N,) root mean square, of 1, of what lies below half of ``ANALYSIS_HZ``.
    """

    step_s: float
    pitch_hz: Floats
    loudness: Floats

    def within(self, start_s: float, end_s: float) -> slice:
        """Steps whose middles lie between two moments; one at least."""
        first = min(max(0, int(start_s / self.step_s + 0.5)), max(0, len(self.loudness) - 1))
        return slice(first, max(first + 1, int(end_s / self.step_s + 0.5)))


@dataclass(frozen=True)
class Prosody:
    """What a listener would notice.

    Attributes:
        prominence: how much each word stands out, 0..1; 0.5 is as words usually do.
        ends_s: moments at which phrases end, in order.
    """

    prominence: Mapping[Cue, float] = field(default_factory=dict)
    ends_s: tuple[float, ...] = ()


def measure_prosody(sound: Sound, words: Sequence[Cue], phones: Sequence[Cue]) -> Prosody:
    """Which words of a sound stand out and where its phrases end; nothing where nothing is heard or no word said."""
    words = sorted(words)
    contour = measure_contour(sound)
    if not words or not len(contour.loudness) or not contour.loudness.max():
        return Prosody()
    return Prosody(_find_prominence(contour, words, phones), tuple(_find_ends(contour, words)))


def measure_contour(sound: Sound) -> Contour:
    """Pitch and loudness of a sound, in steps of about 10 ms.

    Source: de Cheveigné and Kawahara 2002, YIN, a fundamental frequency estimator, JASA 111, steps 1 to 5.
    """
    factor = max(1, sound.rate_hz // ANALYSIS_HZ)
    rate = sound.rate_hz / factor
    hop = max(1, round(rate * STEP_S))
    count = -(-len(sound.samples) // (factor * hop))
    lags = int(rate / LOW_HZ)
    before = (WINDOW_STEPS * hop + lags - hop) // 2
    pitch, power = np.zeros(count), np.zeros(count)
    chunks = [slice(first, min(first + CHUNK_STEPS, count)) for first in range(0, count, CHUNK_STEPS)]

    def take(chunk: slice) -> Floats:
        length = (chunk.stop - chunk.start + WINDOW_STEPS - 1) * hop + lags
        return _take(sound, chunk.start * hop - before, length, factor)

    for chunk in chunks:
        signal = take(chunk)[lags // 2 :]
        power[chunk] = _sum_windows(signal * signal, hop, chunk.stop - chunk.start) / (WINDOW_STEPS * hop)
    loudness = np.sqrt(power) / (factor * 32768.0)
    floor = QUIET_SHARE * loudness.max(initial=0.0)
    for chunk in chunks:
        loud = loudness[chunk] > floor
        if loud.any() and rate > 2.0 * HIGH_HZ:
            pitch[chunk] = np.where(loud, _find_pitch(take(chunk), rate, hop, lags, len(loud)), 0.0)
    return Contour(hop * factor / sound.rate_hz, pitch, loudness)


def _take(sound: Sound, first: int, length: int, factor: int) -> Floats:
    """(length,) sums of ``factor`` samples each, from sum ``first`` on; 0 where there is no sound."""
    start, stop = first * factor, (first + length) * factor
    inside = np.asarray(sound.samples[max(0, start) : max(0, stop)], dtype=np.float64)
    whole = np.zeros(length * factor)
    offset = max(0, -start)
    whole[offset : offset + len(inside)] = inside
    return whole.reshape(length, factor).sum(axis=1)


def _sum_windows(values: Floats, hop: int, count: int) -> Floats:
    """(count,) sums over windows of ``WINDOW_STEPS`` hops, one hop apart."""
    steps = values[: (count + WINDOW_STEPS - 1) * hop].reshape(-1, hop).sum(axis=1)
    return sliding_window_view(steps, WINDOW_STEPS).sum(axis=1)


def _find_pitch(signal: Floats, rate: float, hop: int, lags: int, count: int) -> Floats:
    """(count,) Hz, 0 where the signal does not repeat itself."""
    steps = sliding_window_view(signal, hop + lags)[::hop][: count + WINDOW_STEPS - 1]
    powers = np.cumsum(np.pad(steps * steps, ((0, 0), (1, 0))), axis=1)
    power = powers[:, hop:] - powers[:, : lags + 1]
    product = np.stack([np.correlate(step, step[:hop], "valid") for step in steps])
    # (a - b)² = a² + b² - 2 a b, to the last bit, because all are whole numbers under 2⁵³.
    changes = power[:, :1] + power - 2.0 * product
    difference = sliding_window_view(changes, WINDOW_STEPS, axis=0).sum(axis=2)
    total = np.cumsum(difference, axis=1)
    share = np.divide(difference * np.arange(lags + 1), total, out=np.ones_like(total), where=total > 0.0)
    first = max(1, int(rate / HIGH_HZ))
    dips = (share[:, first:-1] < DIP) & (share[:, first:-1] <= share[:, first + 1 :])
    rows, best = np.arange(count), first + dips.argmax(axis=1)
    left, middle, right = (difference[rows, best + step] for step in (-1, 0, 1))
    bend = left - 2.0 * middle + right
    aside = np.divide(0.5 * (left - right), bend, out=np.zeros(count), where=bend > 0.0)
    return np.where(dips.any(axis=1), rate / (best + np.clip(aside, -0.5, 0.5)), 0.0)


def _find_prominence(contour: Contour, words: Sequence[Cue], phones: Sequence[Cue]) -> dict[Cue, float]:
    # Windows at the ends of a word hear its neighbours too.
    edge_s = 0.5 * WINDOW_STEPS * contour.step_s
    spans = [contour.within(word.start_s + edge_s, word.end_s - edge_s) for word in words]
    counts = _count_phones(words, phones)
    measured = {
        "pitch": [_hold(contour.pitch_hz[span], np.max) for span in spans],
        "loudness": [float(contour.loudness[span].max()) for span in spans],
        "length": [word.length_s / max(1, count) for word, count in zip(words, counts, strict=True)],
    }
    scores = np.zeros(len(words))
    for name, values in measured.items():
        column = np.array(values)
        middle = float(np.median(column[column > 0.0])) if (column > 0.0).any() else 0.0
        if middle:
            above = np.where(column > 0.0, (column / middle - 1.0) / SPREADS[name], 0.0)
            scores += SHARES[name] * np.clip(above, -1.0, 1.0)
    return dict(zip(words, np.clip(0.5 + 0.5 * scores, 0.0, 1.0).tolist(), strict=True))


def _count_phones(words: Sequence[Cue], phones: Sequence[Cue]) -> list[int]:
    middles = np.array([phone.centre_s for phone in phones if phone.symbol != SILENCE])
    edges = np.searchsorted(middles, [[word.start_s, word.end_s] for word in words])
    return [int(last - first) for first, last in edges]


def _hold(pitch_hz: Floats, choose: Callable[[Floats], np.float64]) -> float:
    """One pitch of several, without those of single steps, which are mistakes more often than not; 0 without any."""
    held = pitch_hz[pitch_hz > 0.0]
    return float(choose(held)) if len(held) >= 2 else 0.0


def _find_ends(contour: Contour, words: Sequence[Cue]) -> Iterator[float]:
    usual = float(np.median([contour.loudness[contour.within(word.start_s, word.end_s)].max() for word in words]))
    begun_s = words[0].start_s
    for word, following in pairwise(words):
        lasted = word.end_s - begun_s >= SHORTEST_PHRASE_S
        if following.start_s - word.end_s >= PAUSE_S or (lasted and _begins_anew(contour, word, following, usual)):
            yield word.end_s
            begun_s = following.start_s
    yield words[-1].end_s


def _begins_anew(contour: Contour, word: Cue, following: Cue, usual: float) -> bool:
    edge = contour.within(word.end_s - EDGE_S / 2.0, following.start_s + EDGE_S / 2.0)
    before = _hold(
        contour.pitch_hz[contour.within(max(word.start_s, word.end_s - 2.0 * EDGE_S), word.end_s)], np.median
    )
    after = _hold(
        contour.pitch_hz[contour.within(following.start_s, min(following.end_s, following.start_s + 2.0 * EDGE_S))],
        np.median,
    )
    return bool(contour.loudness[edge].min() < DIM_SHARE * usual and 0.0 < RESET * before < after)
