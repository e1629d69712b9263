"""The sound of a film, fed in step with its pictures so that no packet waits long."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from av.audio.frame import AudioFrame

from mien.core import Sound

from .codecs import Codec

BLOCK = 1024
"""Samples that are handed over at once: a frame of AAC."""


class SoundStream:
    """One mono stream of a container. Its first sample is heard with the first picture.

    What an encoder puts before the first sample (1024 of AAC, 312 of Opus) it also declares, and players skip it.
    """

    def __init__(self, container: Any, sound: Sound, codec: Codec) -> None:
        taken = codec.voice_rates_hz
        rate_hz = sound.rate_hz if not taken or sound.rate_hz in taken else max(taken)
        self._container, self._sound = container, sound
        self._stream = container.add_stream(codec.voice, rate=rate_hz, layout="mono", options={"flags": "+bitexact"})
        if codec.voice_bits_per_s:
            self._stream.bit_rate = codec.voice_bits_per_s
        self._place = self._end = 0

    def play_until(self, time_s: Fraction) -> None:
        """Encodes whole blocks up to the time that the picture has reached."""
        self._end = max(round(time_s * self._sound.rate_hz), self._end)
        while self._place + BLOCK <= self._end:
            self._encode(BLOCK)

    def finish(self) -> None:
        """Encodes what is left, to the sample."""
        self._end = max(self._end, len(self._sound.samples))
        while self._place < self._end:
            self._encode(min(BLOCK, self._end - self._place))
        self._container.mux(self._stream.encode(None))

    def _encode(self, count: int) -> None:
        """The next samples; beyond the sound there is silence."""
        samples = np.zeros((1, count), dtype=np.int16)
        given = self._sound.samples[self._place : self._place + count]
        samples[0, : len(given)] = given
        frame = AudioFrame.from_ndarray(samples, format="s16", layout="mono")
        frame.sample_rate = self._sound.rate_hz
        frame.pts, frame.time_base = self._place, Fraction(1, self._sound.rate_hz)
        self._container.mux(self._stream.encode(frame))
        self._place += count
