"""What a live session was heard to say: its sounds in a log, and all of them on the clock of a replay."""

from __future__ import annotations

import base64
import binascii
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from mien.core import MienError, Sound
from mien.core.sound_store import SoundStore

from .fields import read_number, read_text, show
from .messages import PCM_HZ

BLOCK = 1 << 20
"""Samples of silence written at a time."""


def sound_line(speech: int, sound: Sound) -> str:
    """The line of a log with the sound of an utterance: its number, and 16-bit samples, low byte first, in base64."""
    data = base64.b64encode(sound.samples.astype("<i2").tobytes()).decode("ascii")
    # Base64 has nothing to escape, and looking for that takes JSON three times as long as all the rest.
    return f'{{"sound": {speech}, "rate_hz": {sound.rate_hz}, "data": "{data}"}}'


def parse_sound(value: Mapping[str, Any]) -> Sound:
    """The sound in such a line.

    Raises:
        MienError: there is none.
    """
    rate_hz = read_number("rate_hz", value.get("rate_hz"), *PCM_HZ, "Hz")
    data = read_text("data", value.get("data"), 0, math.inf)
    try:
        samples = np.frombuffer(base64.b64decode(data, validate=True), "<i2").astype(np.int16)
    except (binascii.Error, ValueError):
        raise MienError(f"data: want 16-bit samples in base64, got {show(data)}") from None
    return Sound(samples, round(rate_hz))


class Sounds:
    """Sounds of utterances by their numbers; many of them are kept in a file."""

    def __init__(self) -> None:
        self._store: SoundStore | None = None
        self._rate_hz = self._count = 0
        self._places: dict[int, slice] = {}

    def add(self, speech: int, sound: Sound) -> None:
        """Keep the sound of an utterance.

        Raises:
            MienError: its rate is another than that of those before, or there is no room for it.
        """
        if self._store is None:
            self._store, self._rate_hz = SoundStore(sound.rate_hz), sound.rate_hz
        if sound.rate_hz != self._rate_hz:
            raise MienError(f"rate_hz: {sound.rate_hz}, and {self._rate_hz} before — want one rate in a log")
        self._places[speech] = slice(self._count, self._count + len(sound.samples))
        self._store.write(sound.samples)
        self._count += len(sound.samples)

    def finish(self) -> Mapping[int, Sound]:
        """All of them."""
        if self._store is None:
            return {}
        samples = _finish(self._store).samples
        return {speech: Sound(samples[place], self._rate_hz) for speech, place in self._places.items()}


def join_sounds(
    sounds: Mapping[int, Sound], spans_s: Mapping[int, tuple[float, float]], length_s: float
) -> Sound | None:
    """One sound in which each is heard in its time; none if there is nothing to hear.

    Args:
        sounds: by numbers of utterances, at one rate.
        spans_s: by the same numbers, from when to when they may be heard, one after the other.
        length_s: of the whole.

    Raises:
        MienError: there is no room for it.
    """
    if not sounds:
        return None
    rate_hz = next(iter(sounds.values())).rate_hz
    store, count = SoundStore(rate_hz), 0
    for speech, (start_s, end_s) in spans_s.items():
        if speech in sounds:
            first = round(start_s * rate_hz)
            heard = sounds[speech].samples[: round(end_s * rate_hz) - first]
            _wait(store, first - count)
            store.write(heard)
            count = first + len(heard)
    _wait(store, round(length_s * rate_hz) - count)
    return _finish(store)


def _wait(store: SoundStore, count: int) -> None:
    for done in range(0, count, BLOCK):
        store.write(np.zeros(min(BLOCK, count - done), dtype=np.int16))


def _finish(store: SoundStore) -> Sound:
    try:
        return store.sound()
    finally:
        store.close()
