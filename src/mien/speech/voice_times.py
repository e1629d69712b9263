"""When each phone and word is heard: from what a voice says about its letters, and from the sound itself."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mien.core import SILENCE, Cue

from .phones import STOPS, VOWELS, convert_ipa, read_ipa_table, strip_stress

STRESS_MARKS = {"ˈ": 1, "ˌ": 2}
PAUSE_MARKS = frozenset('.,;:!?—…"“”()')

FRAME_S = 0.005
"""Length of the pieces whose loudness is looked at, seconds."""

QUIET_SHARE = 1e-4
"""Power of a frame, as a share of the mean power of the utterance, below which nobody speaks (-40 dB)."""

SHORTEST_PAUSE_S = 0.04
"""Silence between words that counts as a pause, seconds; less belongs to the phones on both sides."""

SHORTEST_PHONE_S = 0.02
CLOSURE_S = 0.06
"""Silence before the sound of a stop during which the mouth is already shut, seconds."""


@dataclass(frozen=True)
class Letter:
    """One letter of a voice's alphabet, the sample where it begins, and the word it belongs to (-1: none)."""

    symbol: str
    start: int
    word: int = -1


@dataclass(frozen=True)
class TimedPhone:
    """A phone that lasts from one sample to another, and the word it belongs to (-1: none)."""

    start: int
    end: int
    symbol: str
    word: int = -1


def time_phones(letters: Sequence[Letter], end: int) -> list[TimedPhone]:
    """Phones and pauses of English in order, each ending where the next begins, the last at sample ``end``.

    The time of a stress mark belongs to the vowel after it, that of a space or a length mark to the phone before it.
    """
    found: list[TimedPhone] = []
    part: list[Letter] = []
    stresses: list[int] = []
    marked: tuple[int, int] | None = None

    def finish_part(stop: int) -> None:
        edges = [letter.start for letter in part] + [stop]
        for phone, start, count in _share_letters("".join(letter.symbol for letter in part), edges):
            digit = str(max(stresses[start:count])) if phone.symbol in VOWELS else ""
            found.append(replace(phone, symbol=phone.symbol + digit, word=part[start].word))
        part.clear()
        stresses.clear()

    for letter in letters:
        if letter.symbol in STRESS_MARKS:
            marked = STRESS_MARKS[letter.symbol], letter.start
        elif letter.symbol == " " or letter.symbol in PAUSE_MARKS:
            finish_part(letter.start)
            if letter.symbol != " ":
                found.append(TimedPhone(letter.start, end, SILENCE))
        else:
            stress, start = marked or (0, letter.start)
            part.append(replace(letter, start=start))
            stresses.append(stress)
            marked = None
    finish_part(end)
    starts = [phone.start for phone in found] + [end]
    return [replace(phone, end=stop) for phone, stop in zip(found, starts[1:], strict=True)]


def _share_letters(symbols: str, edges: Sequence[int]) -> Iterable[tuple[TimedPhone, int, int]]:
    """Phones of a word's letters with times, and the range of letters each came from."""
    phones = convert_ipa(symbols, read_ipa_table("en"))
    for number, (phone, first, stop) in enumerate(phones):
        sharers = [other for other, (_, start, _) in enumerate(phones) if start == first]
        step = (edges[stop] - edges[first]) // len(sharers)
        start = edges[first] + step * (number - sharers[0])
        yield TimedPhone(start, start, phone), first, stop


def find_quiet(samples: NDArray[np.int16], rate_hz: int) -> NDArray[np.bool_]:
    """For each whole frame of ``FRAME_S`` (F,): whether nobody speaks in it."""
    size = round(FRAME_S * rate_hz)
    frames = samples[: len(samples) // size * size].reshape(-1, size).astype(np.float64)
    power = (frames * frames).mean(axis=1)
    return power <= QUIET_SHARE * power.mean() if len(power) else power > 0


def fit_pauses(phones: Sequence[TimedPhone], samples: NDArray[np.int16], rate_hz: int) -> list[TimedPhone]:
    """The phones with pauses where the sound is silent, from sample 0 to the last without holes.

    A voice's own times say where a comma stands, not how long the silence lasts. A pause is the longest silence
    between the middle of the phone before it and the middle of the phone after it; without one it is left out. A stop
    after a pause keeps the end of the silence: the mouth is shut before the sound breaks out.
    """
    quiet = find_quiet(samples, rate_hz)
    spoken: list[TimedPhone] = []
    marked = {0}
    for phone in phones:
        if phone.symbol == SILENCE:
            marked.add(len(spoken))
        else:
            spoken.append(phone)
    if not spoken:
        return [TimedPhone(0, len(samples), SILENCE)]
    marked.add(len(spoken))
    pauses = {place: _find_pause(spoken, place, quiet, len(samples), rate_hz) for place in sorted(marked)}
    found: list[TimedPhone] = []
    for place, phone in enumerate(spoken):
        start, stop = pauses.get(place) or ((0, 0) if place == 0 else (phone.start, phone.start))
        found += [TimedPhone(start, stop, SILENCE)] if stop > start else []
        found.append(replace(phone, start=stop))
    start, stop = pauses[len(spoken)] or (len(samples), len(samples))
    found += [TimedPhone(start, stop, SILENCE)] if stop > start else []
    return _close_gaps(found, len(samples), round(SHORTEST_PHONE_S * rate_hz))


def _find_pause(
    spoken: Sequence[TimedPhone], place: int, quiet: NDArray[np.bool_], length: int, rate_hz: int
) -> tuple[int, int] | None:
    """First sample of the silence before ``spoken[place]`` and the sample after its last; None for too short a one."""
    size = round(FRAME_S * rate_hz)
    first, last = place == 0, place == len(spoken)
    earliest = 0 if first else _middle(spoken[place - 1])
    latest = length if last else _middle(spoken[place])
    offset = earliest // size
    start, stop = ((offset + frame) * size for frame in _longest_run(quiet[offset : -(-latest // size)]))
    start, stop = 0 if first else start, length if last else stop
    if first:
        stop = min(stop, spoken[0].start)
    elif not last and strip_stress(spoken[place].symbol) in STOPS:
        stop -= round(CLOSURE_S * rate_hz)
    shortest = 1 if first or last else round(SHORTEST_PAUSE_S * rate_hz)
    return (start, stop) if stop - start >= shortest else None


def _middle(phone: TimedPhone) -> int:
    return (phone.start + phone.end) // 2


def _longest_run(quiet: NDArray[np.bool_]) -> tuple[int, int]:
    """First frame and the one after the last of the longest silence; twice the same when there is none."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], quiet, [False]]).astype(np.int8)))
    if not len(edges):
        return len(quiet), len(quiet)
    best = int((edges[1::2] - edges[::2]).argmax())
    return int(edges[2 * best]), int(edges[2 * best + 1])


def _close_gaps(phones: Sequence[TimedPhone], length: int, shortest: int) -> list[TimedPhone]:
    """The phones, each at least ``shortest`` samples long where there is room, ending where the next begins."""
    starts: list[int] = []
    for phone in phones:
        starts.append(max(phone.start, starts[-1] + shortest) if starts else 0)
    room = length
    for place in reversed(range(len(starts))):
        room = max(0, room - 1)
        starts[place] = min(starts[place], room)
    return [
        replace(phone, start=start, end=stop)
        for phone, start, stop in zip(phones, starts, [*starts[1:], length], strict=True)
    ]


def to_cues(phones: Sequence[TimedPhone], rate_hz: int) -> tuple[Cue, ...]:
    """The phones in seconds."""
    return tuple(Cue(phone.start / rate_hz, phone.end / rate_hz, phone.symbol) for phone in phones)


def time_words(phones: Sequence[TimedPhone], words: Sequence[str], rate_hz: int) -> tuple[Cue, ...]:
    """Each word from its first phone to its last; a word without phones has no cue."""
    spans: dict[int, tuple[int, int]] = {}
    for phone in phones:
        if phone.word >= 0:
            start, _ = spans.get(phone.word, (phone.start, 0))
            spans[phone.word] = start, phone.end
    return tuple(Cue(start / rate_hz, end / rate_hz, words[word]) for word, (start, end) in sorted(spans.items()))
