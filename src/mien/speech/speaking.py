"""A text said by a voice, as one sound with its words and phones."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from mien.core import SILENCE, Cue, MienError, SoundStore

from .phones import check_symbol
from .voice import Speech, Utterance, Voice, find_voice

LEAD_S = 0.2
"""Silence before the first word, seconds, so that a film does not begin in the middle of a sound."""

TAIL_S = 0.35
"""Silence after the last word, seconds."""

SHORTEST_TAIL_S = 0.05
SHORTEST_HEAD_S = 0.03
"""Silence of an utterance's own that is never cut off, seconds: it holds the last of the breath and the first."""

NO_PAUSES: Mapping[int, float] = MappingProxyType({})

Report = Callable[[int, int, str], None]


def speak(
    text: str,
    voice: str | Voice | None = None,
    *,
    pauses: Mapping[int, float] = NO_PAUSES,
    lead_s: float = LEAD_S,
    tail_s: float = TAIL_S,
    report: Report | None = None,
    folder: Path | str | None = None,
) -> Speech:
    """A text said: its sound, words and phones.

    Args:
        text: any text; what the voice cannot say is named in ``skipped``.
        voice: a voice or the name of one; the built-in one by default.
        pauses: how long nothing is heard, seconds, before characters of the text; before the first and after the last
            word it is never less than usual.
        lead_s: silence before the first word.
        tail_s: silence after the last word.
        report: called as characters of the text are done, with how many, of how many, and what is being done.
        folder: where long sound is kept until it is no longer used; the system's temporary folder by default.

    Raises:
        UnknownNameError: for a voice that is not there.
        MienError: for a text with nothing that the voice can say.
    """
    if not text.strip():
        raise MienError("the text is empty — write what is to be said, like 'Hello there.'")
    speaker = find_voice(voice) if voice is None or isinstance(voice, str) else voice
    store = SoundStore(speaker.rate_hz, folder)
    line = _Line(speaker.name, speaker.rate_hz, lead_s, tail_s)
    skipped: dict[str, None] = {}
    try:
        for piece in _split_at_pauses(text, pauses):
            for utterance in speaker.utterances(piece.text) if piece.text else ():
                skipped.update(dict.fromkeys(utterance.skipped))
                for samples in line.add(utterance):
                    store.write(samples)
                if report is not None:
                    report(min(piece.start + utterance.done, len(text)), len(text), "speaking")
            if piece.pause_s is not None:
                line.wait(piece.pause_s)
        if not line.words:
            raise MienError(_say_why_nothing(text, speaker, list(skipped)))
        store.write(line.finish())
        if report is not None:
            report(len(text), len(text), "speaking")
        return Speech(
            text,
            store.sound(),
            tuple(line.words),
            line.phones(),
            tuple(skipped),
            speaker.name,
        )
    finally:
        store.close()


@dataclass(frozen=True)
class _Piece:
    """Text without a pause in it, its first character, and the silence wanted after it; None is the voice's own."""

    text: str
    start: int
    pause_s: float | None


def _split_at_pauses(text: str, pauses: Mapping[int, float]) -> Iterator[_Piece]:
    """Pieces between pauses; where one ends within a clause, a comma makes the voice stay up."""
    edges = [0, *sorted({*pauses, len(text)})]
    for first, last in pairwise(edges):
        piece = text[first:last]
        said = piece.strip()
        if last in pauses and said[-1:].isalnum():
            piece = piece.rstrip() + ","
        yield _Piece(piece if said else "", first, pauses.get(last))


def _say_why_nothing(text: str, voice: Voice, skipped: list[str]) -> str:
    shown = repr(_shorten(text.strip(), 40))
    reason = (
        f"it cannot say {', '.join(_shorten(run, 20) for run in skipped[:5])}" if skipped else "there is no word in it"
    )
    return f"text {shown}: voice {voice.name!r} speaks {voice.language}, and {reason} — try a text with words it knows"


def _shorten(text: str, most: int) -> str:
    return text if len(text) <= most else text[:most] + "…"


class _Line:
    """Utterances laid one after another with the silence between them that each asks for."""

    def __init__(self, voice: str, rate_hz: int, lead_s: float, tail_s: float) -> None:
        self._voice, self._rate_hz = voice, rate_hz
        self._length = 0
        self._pause = round(lead_s * rate_hz)
        self._tail = self._usual_tail = round(tail_s * rate_hz)
        self._phones: list[tuple[int, str]] = []  # first sample and symbol; each lasts until the next
        self.words: list[Cue] = []

    def add(self, utterance: Utterance) -> Iterator[NDArray[np.int16]]:
        """Samples to append: the silence before the utterance and its speech, without the silence at its ends."""
        spoken = [cue for cue in utterance.phones if cue.symbol != SILENCE]
        if not spoken:
            return
        rate = self._rate_hz
        begin, end = round(spoken[0].start_s * rate), round(spoken[-1].end_s * rate)
        head = min(begin, round(SHORTEST_HEAD_S * rate))
        tail = min(len(utterance.samples) - end, round(SHORTEST_TAIL_S * rate))
        silence = np.zeros(max(0, self._pause - head), np.int16)
        yield silence
        yield utterance.samples[begin - head : end + tail]
        place = self._length + len(silence) + head
        if place > self._length:
            self._append(self._length, SILENCE)
        shift = place - begin
        last = begin
        for cue in utterance.phones:
            start, stop = round(cue.start_s * rate), round(cue.end_s * rate)
            if start >= end or stop <= begin:
                continue
            check_symbol(cue.symbol, self._voice)
            if start > last:
                self._append(last + shift, SILENCE)
            self._append(start + shift, cue.symbol)
            last = stop
        self.words += [
            replace(
                word,
                start_s=(round(word.start_s * rate) + shift) / rate,
                end_s=(round(word.end_s * rate) + shift) / rate,
            )
            for word in utterance.words
        ]
        self._append(end + shift, SILENCE)
        self._length = end + tail + shift
        self._pause = max(0, round(utterance.pause_s * rate) - tail)
        self._tail = self._usual_tail

    def wait(self, length_s: float) -> None:
        """Lets the silence that comes next be so long."""
        length = round(length_s * self._rate_hz)
        self._pause = max(0, length - self._silent) if self._phones else max(self._pause, length)
        self._tail = max(self._tail, length)

    @property
    def _silent(self) -> int:
        """Samples of silence at the end."""
        return self._length - (self._phones[-1][0] if self._phones else self._length)

    def finish(self) -> NDArray[np.int16]:
        """The silence at the end, without which the last word sounds cut off."""
        silence = np.zeros(max(0, self._tail - self._silent), np.int16)
        self._length += len(silence)
        return silence

    def phones(self) -> tuple[Cue, ...]:
        """Phones from 0 to the end without holes."""
        edges = [start / self._rate_hz for start, _ in self._phones] + [self._length / self._rate_hz]
        return tuple(
            Cue(start, end, symbol)
            for start, end, (_, symbol) in zip(edges, edges[1:], self._phones, strict=False)
            if end > start
        )

    def _append(self, start: int, symbol: str) -> None:
        if symbol == SILENCE and self._phones and self._phones[-1][1] == SILENCE:
            return
        self._phones.append((start, symbol))
