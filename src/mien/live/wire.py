"""Binary messages of a WebSocket: what is too much, or too often, for JSON. Little endian; docs/frames.md has all."""

from __future__ import annotations

import struct
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError, RangeError

from .messages import PCM_HZ

VERSION = 1
HEADER = struct.Struct("<BBHId")
"""Type, version, number of the setup, loop, time in seconds."""

SETUP, FRAME, SOUND = 1, 2, 3
"""Types of messages to a page."""

DRAWN, PCM = 1, 2
"""Types of messages from a page."""

_DRAWN = struct.Struct("<BBHI")
_PCM = struct.Struct("<B3xI")
_SOUND = struct.Struct("<II")


@dataclass(frozen=True)
class Drawn:
    """A picture has been drawn.

    Attributes:
        setup: number of its setup.
        loop: which picture.
    """

    setup: int
    loop: int


@dataclass(frozen=True, eq=False)
class Pcm:
    """Some sound.

    Attributes:
        rate_hz: samples a second.
        samples: (N,) int16, mono.
    """

    rate_hz: int
    samples: NDArray[np.int16]


def sound_message(number: int, samples: NDArray[np.int16], rate_hz: int) -> bytes:
    """The sound of an utterance, by its number in events of speech."""
    return HEADER.pack(SOUND, VERSION, 0, 0, 0.0) + _SOUND.pack(number, rate_hz) + samples.astype("<i2").tobytes()


def read_binary(data: bytes) -> Drawn | Pcm:
    """What a page has sent.

    Raises:
        MienError: it is neither.
        RangeError: the rate of sound is out of range.
    """
    kind = data[0] if data else 0
    if kind == DRAWN and len(data) == _DRAWN.size:
        _, _, setup, loop = _DRAWN.unpack(data)
        return Drawn(setup, loop)
    if kind == PCM and len(data) >= _PCM.size and len(data) % 2 == 0:
        _, rate_hz = _PCM.unpack_from(data)
        return Pcm(check_rate(rate_hz), np.frombuffer(data, "<i2", offset=_PCM.size).astype(np.int16))
    raise MienError(
        f"a binary message of {len(data)} bytes and type {kind}: want {_DRAWN.size} bytes of type {DRAWN} (drawn), or "
        f"{_PCM.size} and an even number of type {PCM} (sound)"
    )


def check_rate(rate_hz: float) -> int:
    """Samples a second of sound that comes in.

    Raises:
        RangeError: out of range.
    """
    low, high = PCM_HZ
    if not low <= rate_hz <= high:
        raise RangeError(f"rate_hz: {rate_hz:g} is out of range — it goes from {low} to {high} Hz")
    return round(rate_hz)
