"""Animated WebP: still pictures of libwebp, each written as soon as it is encoded.

libwebp's own writer of animations, and FFmpeg's, hold a film in memory until its end or let transparent frames shine
through one another.

Source: RFC 9649, sections 2.3 to 2.7.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Mapping
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError

from .codecs import FilmPlan
from .film_notes import format_xmp
from .film_stills import StillEncoder

Pixels = NDArray[np.uint8]

ANIMATED, XMP, ALPHA = 0x02, 0x04, 0x10
"""Bits of what is in a file."""

REPLACE = 0x02
"""A frame takes the place of the one before; without this bit it is laid over it."""

MOST_BYTES = 2**32 - 2
"""A file says its own length in 32 bits."""


class WebpFilm:
    """An animation that is shown again and again."""

    def __init__(self, file: BinaryIO, plan: FilmPlan, notes: Mapping[str, str]) -> None:
        self._file, self._plan = file, plan
        self._size = b"".join(_int24(side - 1) for side in plan.size_px)
        self._encoder = StillEncoder(plan)
        self._notes = format_xmp(notes) if notes else b""
        flags = ANIMATED | (ALPHA if plan.transparent else 0) | (XMP if notes else 0)
        file.write(b"RIFF\0\0\0\0WEBP")
        self._write(b"VP8X", struct.pack("<I", flags) + self._size)
        # Background none, repeated for ever.
        self._write(b"ANIM", bytes(6))

    def show(self, pixels: Pixels, start: int, count: int) -> None:
        """Adds a picture that stays for ``count`` frames from frame ``start`` on."""
        stays = self._plan.ticks(start + count) - self._plan.ticks(start)
        picture = b"".join(
            _chunk(name, data)
            for name, data in _chunks(self._encoder.encode(pixels))
            if name in (b"ALPH", b"VP8 ", b"VP8L")
        )
        self._write(b"ANMF", bytes(6) + self._size + _int24(stays) + bytes([REPLACE]) + picture)

    def finish(self) -> None:
        """Writes the notes and the length of the file."""
        if self._notes:
            self._write(b"XMP ", self._notes)
        length = self._file.tell()
        self._file.seek(4)
        self._file.write(struct.pack("<I", length - 8))

    def _write(self, name: bytes, data: bytes) -> None:
        if self._file.tell() + len(data) > MOST_BYTES:
            raise MienError(
                f"{self._plan.codec.suffix}: the film is longer than 4 GB — write .webm, or smaller pictures"
            )
        self._file.write(_chunk(name, data))


def _chunk(name: bytes, data: bytes) -> bytes:
    return name + struct.pack("<I", len(data)) + data + bytes(len(data) % 2)


def _chunks(file: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Name and bytes of each chunk of a still picture."""
    place = 12
    while place < len(file):
        name, (length,) = file[place : place + 4], struct.unpack_from("<I", file, place + 4)
        yield name, file[place + 8 : place + 8 + length]
        place += 8 + length + length % 2


def _int24(number: int) -> bytes:
    return number.to_bytes(3, "little")
