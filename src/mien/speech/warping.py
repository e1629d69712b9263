"""A recording in any language that espeak-ng speaks, heard by its transcript: the text is said, and the voice's sound
is stretched until it fits.

Both are cut at pauses, so that memory does not grow with the length. Between words the pattern has one frame of
silence, on which the way through it may stay as long as nobody speaks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby, pairwise

import numpy as np
from numpy.typing import NDArray

from mien.core import SILENCE, Cue, MienError, Sound

from .hearing_edges import sharpen
from .hearing_follow import NOISY_DB, UNEXPLAINED_S, UNFINISHED_S, find_piece
from .hearing_sound import FRAME_S, Loudness, measure_loudness, take_piece
from .phones import strip_stress
from .voice import Utterance, Voice
from .warping_path import find_path
from .warping_sound import STEP_S, Floats, compare_frames, measure_frames

FASTEST = 2.2
"""Times as fast as the voice that a person may speak."""

QUIET_IN_PAUSE, LOUD_IN_PAUSE = 0.8, 6.0
"""Distance of a quiet and of a loud frame from a pause; frames of the same sound are about one apart."""

DIMENSIONS = 13.0
"""Distances are divided by the root of this, so that they are about one."""

POOR_FIT, POOR_FIT_IN_NOISE = 0.88, 0.93
"""Cost of a text, as a share of that of its sounds backwards, from which on it is not what is said.

Measured on six sentences by five speakers: their own text has 0.79 to 0.86, in noise of 10 dB below them 0.88 to 0.92;
that of another sentence 0.87 to 0.99, 29 of 30 of them above 0.88, in noise 0.92 to 1.0.
"""

END_EARLY = 0.02
"""Cost of a frame, beside a mean of 1.4, for leaving words of a text out at the end of its sound.

The right text costs at most 0.015 more than the best part of it; one that is three words too long 0.08 and more.
"""

SURE_STEP = 0.02
"""Share that makes it e times as likely."""

LEAST_JUDGED_S = 2.0
"""A shorter piece may fit badly by chance, seconds."""


@dataclass(frozen=True)
class Part:
    """A phone of the voice: its symbol and how many frames it lasts."""

    symbol: str
    count: int


@dataclass(frozen=True, eq=False)
class Pattern:
    """A word as the voice says it.

    Attributes:
        written: without the punctuation around it.
        parts: its phones in order.
        frames: (F, 13) as measured, all phones in a row.
    """

    written: str
    parts: tuple[Part, ...]
    frames: Floats


@dataclass(frozen=True)
class WarpedWord:
    """A word that was found: as written, and its phones with their times."""

    written: str
    phones: tuple[Cue, ...]


@dataclass(frozen=True, eq=False)
class Warped:
    """The words of a text in a sound, in order.

    Attributes:
        words: those that are heard.
        sure: how likely each is what is heard, 0 to 1; the same for all words of a few seconds.
        missing: those that the sound ends before.
        skipped: what the voice cannot say.
        notices: where text and sound differ.
    """

    words: tuple[WarpedWord, ...]
    sure: tuple[float, ...]
    missing: tuple[str, ...]
    skipped: tuple[str, ...]
    notices: tuple[str, ...]


def warp(sound: Sound, loudness: Loudness, text: str, voice: Voice, tell: Callable[[float], None]) -> Warped:
    """The words of a text where they are in a sound.

    Args:
        sound: of any length.
        loudness: of it.
        text: what is said, in the voice's language.
        voice: which says it for comparison.
        tell: the time up to which it is done.

    Raises:
        MienError: there is nothing to say in the text, or it is not what is said.
    """
    patterns = _Patterns(voice, text)
    limit = POOR_FIT if loudness.loud_db - loudness.low_db >= NOISY_DB else POOR_FIT_IN_NOISE
    words: list[WarpedWord] = []
    sure: list[float] = []
    notices: list[str] = []
    fits: list[_Fit] = []
    piece = find_piece(sound, loudness, 0.0)
    while piece is not None:
        start_s, end_s = piece
        if not patterns.reach(FASTEST * (end_s - start_s)):
            if words and loudness.count_loud_s(start_s, sound.length_s) > UNEXPLAINED_S:
                notices.append(f"the text ends {start_s:.1f} s into the sound, which goes on")
            break
        last = find_piece(sound, loudness, end_s) is None
        fit = _fit(sound, loudness, piece, patterns.ahead, last=last and patterns.over)
        fits.append(fit)
        if fit.share > limit and end_s - start_s > LEAST_JUDGED_S:
            notices.append(f"{start_s:.1f} to {end_s:.1f} s: the text may not be what is said here")
        cut = len(fit.words) > 1 and not last and fit.words[-1].phones[-1].end_s > end_s - UNFINISHED_S
        words += fit.words[: len(fit.words) - cut]
        sure += [float(1.0 / (1.0 + np.exp((fit.share - limit) / SURE_STEP)))] * (len(fit.words) - cut)
        patterns.drop(len(fit.words) - cut)
        next_s = words[-1].phones[-1].end_s if cut else end_s
        tell(next_s)
        piece = find_piece(sound, loudness, next_s)
    if not words:
        raise MienError(
            f"transcript {text.strip()[:40]!r}: there is no word in it that can be said in {voice.language}"
        )
    share = sum(fit.cost for fit in fits) / sum(fit.backwards for fit in fits)
    if share > limit:
        raise MienError(
            f"the text is not what is said: it fits the sound hardly better than its own sounds backwards ({share:.2f} "
            f"of their cost) — is it the text of this sound, and in {voice.language}?"
        )
    missing = tuple(pattern.written for pattern in patterns.rest())
    if missing:
        notices.append(f"the sound ends before the text: {len(missing)} words, from {missing[0]!r} on, are not heard")
    return Warped(tuple(words), tuple(sure), missing, tuple(dict.fromkeys(patterns.skipped)), tuple(notices))


class _Patterns:
    """The words of a text as a voice says them, a sentence at a time."""

    def __init__(self, voice: Voice, text: str) -> None:
        self._voice = voice
        self._utterances = voice.utterances(text)
        self.ahead: list[Pattern] = []
        self.skipped: list[str] = []
        self.over = False

    def reach(self, length_s: float) -> bool:
        """Whether there are words ahead, after as many are said as last that long or until the text is over."""
        while not self.over and sum(len(pattern.frames) for pattern in self.ahead) * STEP_S < length_s:
            utterance = next(self._utterances, None)
            if utterance is None:
                self.over = True
            else:
                self.skipped += utterance.skipped
                self.ahead += _cut_words(utterance, self._voice.rate_hz)
        return bool(self.ahead)

    def drop(self, count: int) -> None:
        """The first words ahead are done."""
        del self.ahead[:count]

    def rest(self) -> Iterator[Pattern]:
        """The words ahead to the end of the text."""
        while self.reach(0.0) or not self.over:
            yield from self.ahead
            self.ahead.clear()
            self.reach(STEP_S)


def _cut_words(utterance: Utterance, rate_hz: int) -> Iterator[Pattern]:
    """The words of an utterance with their frames."""
    said = Sound(utterance.samples, rate_hz)
    if not utterance.words:
        return
    frames = measure_frames(take_piece(said, 0.0, said.length_s, measure_loudness(said)))
    for word in utterance.words:
        phones = [
            cue
            for cue in utterance.phones
            if cue.symbol != SILENCE and word.start_s <= 0.5 * (cue.start_s + cue.end_s) <= word.end_s
        ]
        spans = [(round(cue.start_s / STEP_S), round(cue.end_s / STEP_S)) for cue in phones]
        spans = [(first, min(max(last, first + 1), len(frames))) for first, last in spans]
        parts = tuple(Part(cue.symbol, last - first) for cue, (first, last) in zip(phones, spans, strict=True))
        yield Pattern(word.symbol, parts, np.concatenate([frames[first:last] for first, last in spans]))


@dataclass(frozen=True, eq=False)
class _Line:
    """Words in a row with a frame of silence before each and after the last.

    Attributes:
        frames: (M, 13); those of silence are of no account.
        silent: (M,).
        ends: (M,) where a word ends, and silence.
        owners: (M,) number of the phone, of all words; -1 in silence.
        words: (M,) number of the word; -1 in silence.
        phones: symbols in order.
    """

    frames: Floats
    silent: NDArray[np.bool_]
    ends: NDArray[np.bool_]
    owners: NDArray[np.int64]
    words: NDArray[np.int64]
    phones: tuple[str, ...]


def _line_up(patterns: Sequence[Pattern]) -> _Line:
    gap = np.zeros((1, patterns[0].frames.shape[1]))
    rows, owners, words, phones = [gap], [-1], [-1], list[str]()
    for number, pattern in enumerate(patterns):
        rows += [pattern.frames, gap]
        for part in pattern.parts:
            owners += [len(phones)] * part.count
            phones.append(part.symbol)
        owners.append(-1)
        words += [number] * len(pattern.frames) + [-1]
    silent = np.array(owners) < 0
    return _Line(
        np.concatenate(rows),
        silent,
        silent | np.append(silent[1:], True),
        np.array(owners),
        np.array(words),
        tuple(phones),
    )


@dataclass(frozen=True)
class _Fit:
    """The words of a piece of sound, what its frames cost, and what they cost with the same sounds backwards."""

    words: tuple[WarpedWord, ...]
    cost: float
    backwards: float

    @property
    def share(self) -> float:
        """How much cheaper the text is than none."""
        return self.cost / self.backwards


def _fit(
    sound: Sound, loudness: Loudness, piece: tuple[float, float], patterns: Sequence[Pattern], *, last: bool
) -> _Fit:
    """The first of the words in a piece of sound; all of them, if that fits as well, where both come to their last."""
    start_s, end_s = piece
    line = _line_up(patterns)
    samples = take_piece(sound, start_s, end_s, loudness)
    frames = measure_frames(samples)
    loud = _find_loud(loudness, start_s, len(frames))
    heard, said = compare_frames(frames, loud), compare_frames(line.frames, ~line.silent)
    squares = (heard * heard).sum(axis=1)[:, None] + (said * said).sum(axis=1) - 2.0 * (heard @ said.T)
    distances = np.sqrt(np.maximum(squares, 0.0) / DIMENSIONS)
    distances[:, line.silent] = np.where(loud, LOUD_IN_PAUSE, QUIET_IN_PAUSE)[:, None]
    ends = np.where(line.ends, END_EARLY if last else 0.0, np.inf)
    ends[-2:] = 0.0
    path, cost = find_path(distances, line.silent, ends)
    used = int(path[-1]) + 1
    mirrored, silent = distances[:, :used][:, ::-1], line.silent[:used][::-1]
    _, backwards = find_path(mirrored, silent, np.where(np.arange(used) >= used - 2, 0.0, np.inf))
    spans = _sharpen(_read_spans(path, line), samples)
    words = tuple(_read_words(spans, patterns, start_s))
    return _Fit(words, cost * len(path), backwards * len(path))


def _find_loud(loudness: Loudness, start_s: float, count: int) -> NDArray[np.bool_]:
    """(count,) the frames from a time on in which somebody speaks."""
    times = start_s + np.arange(count) * STEP_S
    places = np.clip((times / FRAME_S).astype(np.int64), 0, len(loudness.level_db) - 1)
    return np.asarray(loudness.level_db[places] > loudness.quiet_db)


@dataclass(frozen=True)
class _Heard:
    """A phone, or silence, with its word (-1 in silence) and its times from the beginning of a piece, seconds."""

    symbol: str
    word: int
    start_s: float
    end_s: float


def _read_spans(path: NDArray[np.int64], line: _Line) -> list[_Heard]:
    """The phones and silences that a path goes through; two frames meet half-way between their centres."""
    owners, words = line.owners[path], line.words[path]
    edges = [0, *(np.flatnonzero(np.diff(owners) | np.diff(words)) + 1), len(path)]
    return [
        _Heard(
            line.phones[owners[first]] if owners[first] >= 0 else SILENCE,
            int(words[first]),
            max(0.0, (int(first) - 0.5) * STEP_S),
            (int(last) - 0.5) * STEP_S,
        )
        for first, last in pairwise(edges)
    ]


def _sharpen(spans: Sequence[_Heard], samples: NDArray[np.int16]) -> list[_Heard]:
    """The same with boundaries where the sound changes."""
    moved = sharpen([(strip_stress(span.symbol), span.start_s, span.end_s) for span in spans], samples)
    return [replace(span, start_s=start_s, end_s=end_s) for span, (_, start_s, end_s) in zip(spans, moved, strict=True)]


def _read_words(spans: Sequence[_Heard], patterns: Sequence[Pattern], start_s: float) -> Iterator[WarpedWord]:
    """The words of a piece that begins at ``start_s``."""
    for word, phones in groupby((span for span in spans if span.word >= 0), key=lambda span: span.word):
        cues = (Cue(start_s + phone.start_s, start_s + phone.end_s, phone.symbol) for phone in phones)
        yield WarpedWord(patterns[word].written, tuple(cues))
