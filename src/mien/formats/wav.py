"""WAV: mono, 16 bits, as long as a disk holds; read as a memory map."""

from __future__ import annotations

import struct
import wave
from pathlib import Path

import numpy as np

from mien.core import LoadError, MienError, Sound

from .atomic import writing

BLOCK = 1 << 16
"""Samples written at a time, so that hours of sound need no memory."""


def write_wav(sound: Sound, path: Path | str) -> None:
    """Writes the sound as a WAV file.

    Raises:
        MienError: the place cannot be written, or the sound is longer than the format can hold (4 GB).
    """
    if 2 * len(sound.samples) >= 1 << 32:
        raise MienError(
            f"{path}: {sound.length_s / 3600:.1f} hours are more than a WAV file holds — write .mp4 instead"
        )
    with writing(path) as temporary:
        write_samples(sound, temporary)


def write_samples(sound: Sound, path: Path) -> None:
    """Writes a WAV file of less than 4 GB right where it is to be."""
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(sound.rate_hz)
        for first in range(0, len(sound.samples), BLOCK):
            file.writeframes(sound.samples[first : first + BLOCK].astype("<i2").tobytes())


def read_wav(path: Path | str) -> Sound:
    """The sound in a mono WAV file of 16 bits, as a memory map.

    Raises:
        LoadError: it is no such file.
    """
    path = Path(path)
    try:
        with path.open("rb") as file:
            rate, first, count = _find_samples(path, file.read(1 << 16), path.stat().st_size)
    except OSError as error:
        raise LoadError(path, f"cannot be read ({error.strerror})") from error
    except struct.error:
        raise LoadError(path, "ends in the middle of its header", hint="is it cut off?") from None
    if not count:
        return Sound(np.zeros(0, dtype=np.int16), rate)
    return Sound(np.memmap(path, dtype="<i2", mode="r", offset=first, shape=(count,)), rate)


def _find_samples(path: Path, head: bytes, size: int) -> tuple[int, int, int]:
    """(samples a second, offset of the first sample, number of samples)."""
    if head[:4] != b"RIFF" or head[8:12] != b"WAVE":
        raise LoadError(path, "is no WAV file", hint="convert it first, for example with ffmpeg")
    place, rate = 12, 0
    while place + 8 <= len(head):
        name, length = head[place : place + 4], struct.unpack_from("<I", head, place + 4)[0]
        place += 8
        if name == b"fmt ":
            kind, channels, rate, _, _, bits = struct.unpack_from("<HHIIHH", head, place)
            if (kind, channels, bits) != (1, 1, 16) or not rate:
                raise LoadError(
                    path, f"want mono samples of 16 bits, got {channels} channels of {bits} bits, format {kind}"
                )
        if name == b"data":
            if not rate:
                break
            return rate, place, min(length, size - place) // 2
        place += length + (length & 1)
    raise LoadError(path, "is a WAV file without sound in it", hint="is it cut off?")
