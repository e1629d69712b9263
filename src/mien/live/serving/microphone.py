"""A live voice moves the mouth: blocks of samples go in, moves of the layer ``speech`` come out."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError
from mien.live.messages import Message
from mien.live.wire import check_rate
from mien.speech.listening import DELAY_S, Heard, Listener
from mien.speech.listening_sound import HOP_S
from mien.speech.mouth import MOUTH_CHANNELS
from mien.speech.mouth_table import HELD

MOST_AHEAD_S = 1.0
"""Sound that may come before its time; what comes on top of it is dropped, and so no sender keeps us busy, seconds."""

NEW_RATE_S = 0.05
"""What another rate counts as, seconds of sound: it takes as long as listening to so much."""

LONGEST_S = 0.2
"""Only so much of the end of a block is listened to, seconds: the mouth of what was before is of no use any more."""

USUAL_BLOCK_S = 0.02
"""What pages send at once, seconds."""

STALE_S = 0.2
"""Without a block for so long the mouth shuts, seconds."""

SHUT_MS = 100.0
"""In so long a time."""

HELD_FRAMES = 5
"""Among so many of the newest frames none in which the lips were shut is passed over."""

DIGITS = 3
"""Of the values, after the point: they are logged."""


class Microphone:
    """One stream of sound, which moves the mouth of a live face.

    It keeps no sound but the tail of a window. ``tick`` tells it the time, loop by loop; without ticks, time stands.

    Args:
        loop_s: length of a loop, seconds.
    """

    def __init__(self, loop_s: float) -> None:
        self.loop_s = loop_s
        self.heard_s = 0.0
        """Sound that was listened to."""
        self.dropped_s = 0.0
        """Sound that came too much at once, or too fast."""
        self._listener: Listener | None = None
        self._loop = self._last = 0
        self._ahead_s = 0.0
        self._shut = True

    @property
    def behind_s(self) -> float:
        """How far behind a sound the mouth is drawn at most, with blocks of ``USUAL_BLOCK_S``, seconds."""
        return USUAL_BLOCK_S + HOP_S + DELAY_S + (1 + self._loops(USUAL_BLOCK_S)) * self.loop_s

    def describe(self) -> str:
        """What it is, for people."""
        return (
            f"spectrum regression, no phone recogniser: at most {1000 * self.behind_s:.0f} ms behind, "
            f"{self.heard_s:.1f} s heard, {self.dropped_s:.1f} s dropped"
        )

    def hear(self, samples: NDArray[np.int16], rate_hz: int) -> Message | None:
        """What moves the mouth now; None where nothing changes, or where too much comes at once.

        Raises:
            MienError: these are no samples, or at a rate of no sound.
        """
        if samples.ndim != 1 or samples.dtype != np.int16:
            raise MienError(f"speech.pcm: want (N,) int16, got {samples.shape} {samples.dtype}")
        length_s = len(samples) / check_rate(rate_hz)
        known = self._listener is not None and self._listener.rate_hz == rate_hz
        needs_s = length_s if known else length_s + NEW_RATE_S
        if self._ahead_s + needs_s > MOST_AHEAD_S:
            self.dropped_s += length_s
            return None
        if self._listener is None or not known:
            self._listener = Listener(rate_hz)
        kept = samples[-math.ceil(LONGEST_S * rate_hz) :]
        self._ahead_s += needs_s
        self._last = self._loop
        self.heard_s += len(kept) / rate_hz
        self.dropped_s += (len(samples) - len(kept)) / rate_hz
        heard = self._listener.feed(kept)
        return self._move(_newest(heard), self._loops(length_s) * self.loop_s * 1000.0) if heard else None

    def tick(self, loop: int) -> Message | None:
        """What shuts the mouth when no sound has come for a while; called with the number of every loop."""
        self._ahead_s = max(0.0, self._ahead_s - (loop - self._loop) * self.loop_s)
        self._loop = loop
        if self._shut or (loop - self._last) * self.loop_s < STALE_S:
            return None
        return self._move(dict.fromkeys(MOUTH_CHANNELS, 0.0), SHUT_MS)

    def _loops(self, length_s: float) -> int:
        """In how many loops the mouth goes to where a block wants it: one or two."""
        return 1 if length_s <= self.loop_s else 2

    def _move(self, values: Mapping[str, float], over_ms: float) -> Message | None:
        shut = not any(values.values())
        if shut and self._shut:
            return None
        self._shut = shut
        fields = {"values": MappingProxyType(dict(values)), "over_ms": over_ms, "change": "linear", "layer": "speech"}
        return Message("move", MappingProxyType(fields))


def _newest(heard: Sequence[Heard]) -> dict[str, float]:
    """What the newest says; lips that were shut a moment ago are shut still, so that somebody sees it."""
    values = {name: round(value, DIGITS) for name, value in heard[-1].channels.items()}
    for name in HELD:
        values[name] = round(max(each.channels[name] for each in heard[-HELD_FRAMES:]), DIGITS)
    return values
