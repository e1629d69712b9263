"""Sound of any length while it is made: in memory, and in a temporary file once there is much of it."""

from __future__ import annotations

import tempfile
from contextlib import suppress
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .errors import MienError
from .sound import Sound

LONGEST_IN_MEMORY_S = 120.0
"""Sound longer than this goes to a file, seconds."""


class SoundStore:
    """Samples in memory, and in a file without a name once there are many."""

    def __init__(self, rate_hz: int, folder: Path | str | None = None) -> None:
        self._parts: list[NDArray[np.int16]] = []
        self._count = 0
        self._rate_hz = rate_hz
        self._most = round(LONGEST_IN_MEMORY_S * rate_hz)
        self._folder = folder
        self._file: tempfile._TemporaryFileWrapper[bytes] | None = None

    @property
    def length_s(self) -> float:
        """Duration so far, seconds."""
        return self._count / self._rate_hz

    def write(self, samples: NDArray[np.int16]) -> None:
        """Samples appended."""
        self._parts.append(samples)
        self._count += len(samples)
        if self._count > self._most:
            self._flush()

    def sound(self) -> Sound:
        """All of it; what is in a file is mapped, and the file goes when the map does."""
        if self._file is None:
            return Sound(np.concatenate([np.zeros(0, np.int16), *self._parts]), self._rate_hz)
        self._flush()
        return Sound(np.memmap(self._file, dtype=np.int16, mode="r", shape=(self._count,)), self._rate_hz)

    def close(self) -> None:
        """The file's name given back; a map of it stays good."""
        if self._file is not None:
            with suppress(OSError):  # what could not be written was told when it was written
                self._file.close()

    def _flush(self) -> None:
        try:
            if self._file is None:
                self._file = tempfile.NamedTemporaryFile(prefix="mien-", suffix=".pcm", dir=self._folder)  # noqa: SIM115
            for part in self._parts:
                self._file.write(part.tobytes())
            self._file.flush()
        except OSError as error:
            place = self._folder or tempfile.gettempdir()
            raise MienError(
                f"{place}: cannot keep {2 * self._count >> 20} MB of sound here: {error.strerror} — "
                "set TMPDIR to a folder with room"
            ) from None
        self._parts.clear()
