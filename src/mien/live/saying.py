"""What a mouth, and the face around it, does loop by loop while something is said."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any
from zlib import crc32

import numpy as np

from mien.core import Cue
from mien.gaze import brow_raises, find_accents, nods
from mien.speech.mouth import articulate
from mien.timeline.rates import time_of
from mien.vocab import vocabulary

from .messages import Message
from .mixing import CHANNELS
from .phrases import Piece, life_beside
from .slices import Floats

Cues = Sequence[tuple[float, float, str]]


@dataclass(frozen=True, eq=False)
class Utterance:
    """Something that is said: what follows from its phones alone, so that it can be made anywhere beforehand.

    Attributes:
        channels: (C, loops) what the channels do.
        events: what happens, by loop; that it ends is no part of it.
        acts: messages that marks in the text stand for, by loop.
        life: blinks and glances that go with its phrases.
    """

    channels: Floats
    events: Mapping[int, tuple[Mapping[str, Any], ...]]
    acts: Mapping[int, tuple[Message, ...]] = field(default_factory=dict)
    life: tuple[Piece, ...] = ()

    @property
    def loops(self) -> int:
        """How many it lasts."""
        return self.channels.shape[1]


@dataclass(frozen=True, eq=False)
class Turn:
    """An utterance whose turn it is in a session, or will be.

    Attributes:
        utterance: what is said.
        number: how many came before it in the session.
        more: whether more of its text follows.
        identity: of the message that asked for it, if it has one.
    """

    utterance: Utterance
    number: int
    more: bool = False
    identity: str | None = None

    def events(self, loop: int) -> tuple[dict[str, Any], ...]:
        """What happens at a loop of it."""
        found = tuple(self._event(event) for event in self.utterance.events.get(loop, ()))
        return found if loop < self.utterance.loops - 1 else (*found, self.ended(broken_off=False))

    def ended(self, *, broken_off: bool) -> dict[str, Any]:
        """The event that tells that it is over."""
        return self._event({"event": "speech.ended", "broken_off": broken_off, "more": self.more})

    def failed(self, message: str) -> dict[str, Any]:
        """The event that tells that a mark in it asked for what cannot be done."""
        return self._event({"event": "speech.failed", "message": message, "more": True})

    def _event(self, event: Mapping[str, Any]) -> dict[str, Any]:
        known = {} if self.identity is None else {"id": self.identity}
        return {"kind": "event", **event, "speech": self.number, **known}


def make_utterance(text: str, phones: Cues, words: Cues, *, rate: Fraction, seed: int) -> Utterance:
    """The utterance of some phones, at a rate of loops.

    Args:
        text: what is said.
        phones: start and end, seconds, and ARPABET symbol of each.
        words: likewise.
        rate: loops a second.
        seed: of the session. The text has its share in what chance decides, the utterances before it have none.

    Raises:
        UnknownNameError: a symbol is no phone.
        RangeError: a time is wrong.
    """
    said, spelled = _cues(phones), _cues(words)
    own = seed + crc32(text.encode())
    tracks = dict(articulate(said))
    if spelled:
        accents = find_accents(spelled, said, own)
        length_s = said[-1].end_s
        tracks |= {"head_nod": nods(accents, length_s, own), "brow_raise": brow_raises(accents, length_s, own)}
    longest = 1 + max(int(np.ceil(track.length_s * float(rate))) for track in tracks.values())
    times = time_of(np.arange(longest, dtype=np.float64), rate)
    table = vocabulary(CHANNELS)
    channels = np.zeros((len(table), longest))
    for name, track in tracks.items():
        # Once it is over, all of it is at rest.
        channels[table.index[name]] = np.where(times < track.length_s, track.evaluate(times)[0], 0.0)
    # What is said next need not wait for tracks that have come to rest.
    moved = 1 + int(np.flatnonzero(channels.any(axis=0)).max(initial=-1))
    loops = 1 + max(int(np.ceil(said[-1].end_s * float(rate))), moved)
    channels = np.ascontiguousarray(channels[:, :loops])
    events: dict[int, tuple[Mapping[str, Any], ...]] = {0: ({"event": "speech.started", "text": text},)}
    for number, word in enumerate(spelled):
        loop = min(int(word.start_s * float(rate)), loops - 1)
        event = {"event": "speech.word", "word": word.symbol, "number": number}
        events[loop] = (*events.get(loop, ()), event)
    return Utterance(channels, events, life=life_beside(said, times[:loops], own))


def _cues(cues: Cues) -> tuple[Cue, ...]:
    return tuple(Cue(start_s, end_s, symbol) for start_s, end_s, symbol in cues)
