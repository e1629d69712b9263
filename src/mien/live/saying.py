"""What a mouth, and the face around it, does loop by loop while something is said."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from mien.core import Cue
from mien.gaze import brow_raises, find_accents, nods
from mien.speech.mouth import articulate
from mien.timeline.rates import time_of
from mien.vocab import vocabulary

from .mixing import CHANNELS
from .slices import Floats

Cues = Sequence[tuple[float, float, str]]


@dataclass(frozen=True, eq=False)
class Utterance:
    """Something that is said.

    Attributes:
        channels: (C, loops) what the channels do.
        events: what happens, by loop.
        identity: of the message that asked for it, if it has one.
    """

    channels: Floats
    events: Mapping[int, tuple[dict[str, Any], ...]]
    identity: str | None = None

    @property
    def loops(self) -> int:
        """How many it lasts."""
        return self.channels.shape[1]

    def ended(self, *, broken_off: bool) -> dict[str, Any]:
        """The event that tells that it is over."""
        return _event({"event": "speech.ended", "broken_off": broken_off}, self.identity)


def make_utterance(
    text: str, phones: Cues, words: Cues, *, rate: Fraction, seed: int, identity: str | None
) -> Utterance:
    """The utterance of some phones, at a rate of loops.

    Raises:
        UnknownNameError: a symbol is no phone.
        RangeError: a time is wrong.
    """
    said, spelled = _cues(phones), _cues(words)
    tracks = dict(articulate(said))
    if spelled:
        accents = find_accents(spelled, said, seed)
        length_s = said[-1].end_s
        tracks |= {"head_nod": nods(accents, length_s, seed), "brow_raise": brow_raises(accents, length_s, seed)}
    loops = 1 + max(int(np.ceil(track.length_s * float(rate))) for track in tracks.values())
    times = time_of(np.arange(loops, dtype=np.float64), rate)
    table = vocabulary(CHANNELS)
    channels = np.zeros((len(table), loops))
    for name, track in tracks.items():
        # Once it is over, all of it is at rest.
        channels[table.index[name]] = np.where(times < track.length_s, track.evaluate(times)[0], 0.0)
    events: dict[int, tuple[dict[str, Any], ...]] = {}
    for loop, event in _events(text, spelled, loops, rate):
        events[loop] = (*events.get(loop, ()), _event(event, identity))
    return Utterance(channels, events, identity)


def _event(event: Mapping[str, Any], identity: str | None) -> dict[str, Any]:
    return {"kind": "event", **event} | ({} if identity is None else {"id": identity})


def _events(text: str, words: Sequence[Cue], loops: int, rate: Fraction) -> Iterator[tuple[int, dict[str, Any]]]:
    yield 0, {"event": "speech.started", "text": text}
    for number, word in enumerate(words):
        loop = min(int(word.start_s * float(rate)), loops - 1)
        yield loop, {"event": "speech.word", "word": word.symbol, "number": number}
    yield loops - 1, {"event": "speech.ended", "broken_off": False}


def _cues(cues: Cues) -> tuple[Cue, ...]:
    return tuple(Cue(start_s, end_s, symbol) for start_s, end_s, symbol in cues)
