"""Animated PNG: every picture whole, so that any reader shows the same and none waits in memory.

FFmpeg's own writer stores what changed. That saves a fifth of the bytes, takes three to five times as long, and some
readers show its transparent frames wrong.

Source: W3C, PNG specification (third edition), sections 5, 11 and 13.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from .codecs import FilmPlan
from .film_stills import StillEncoder

Pixels = NDArray[np.uint8]

SIGNATURE = b"\x89PNG\r\n\x1a\n"

RGB, RGBA = 2, 6
"""Types of colour."""

SHORT = 65535
"""The time that a picture stays is a fraction of two numbers of 16 bits."""


class ApngFilm:
    """An animation that is shown again and again."""

    def __init__(self, file: BinaryIO, plan: FilmPlan, notes: Mapping[str, str]) -> None:
        self._file, self._plan = file, plan
        self._encoder = StillEncoder(plan)
        self._pictures = self._number = 0
        file.write(SIGNATURE)
        self._write(b"IHDR", struct.pack(">IIBBBBB", *plan.size_px, 8, RGBA if plan.transparent else RGB, 0, 0, 0))
        self._count_place = file.tell()
        self._write_count()
        for key, value in notes.items():
            # Not compressed, no language, keyword not translated.
            self._write(b"iTXt", key.encode() + bytes(5) + value.encode())

    def show(self, pixels: Pixels, start: int, count: int) -> None:
        """Adds a picture that stays for ``count`` frames."""
        delay = Fraction(count) / self._plan.rate
        delay = delay.limit_denominator(SHORT // (1 + int(delay)))
        place = struct.pack(">IIII", *self._plan.size_px, 0, 0)
        # The last two: nothing is cleared after a picture, and it takes the place of the one before.
        self._write(b"fcTL", self._next() + place + struct.pack(">HHBB", delay.numerator, delay.denominator, 0, 0))
        for data in _image_data(self._encoder.encode(pixels)):
            if self._pictures:
                self._write(b"fdAT", self._next() + data)
            else:
                self._write(b"IDAT", data)
        self._pictures += 1

    def finish(self) -> None:
        """Writes the end, and at the beginning how many pictures there are."""
        self._write(b"IEND", b"")
        self._file.seek(self._count_place)
        self._write_count()

    def _write_count(self) -> None:
        self._write(b"acTL", struct.pack(">II", self._pictures, 0))

    def _next(self) -> bytes:
        """The number of the next chunk of those that are numbered."""
        self._number += 1
        return struct.pack(">I", self._number - 1)

    def _write(self, name: bytes, data: bytes) -> None:
        self._file.write(struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)))


def _image_data(file: bytes) -> Iterator[bytes]:
    """What is in the chunks of pixels of a still PNG."""
    place = len(SIGNATURE)
    while place < len(file):
        (length,) = struct.unpack_from(">I", file, place)
        if file[place + 4 : place + 8] == b"IDAT":
            yield file[place + 8 : place + 8 + length]
        place += length + 12
