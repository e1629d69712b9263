"""Arrays by name in one file that is read at once: a line of JSON with names, kinds and shapes, then their numbers.

An ``.npz`` takes ten times as long to open, and a face is loaded by every command.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.generic]

ALIGNED_BYTES = 8


def parse_arrays(data: bytes) -> dict[str, Array]:
    """The arrays in the bytes of a file, read-only; they share its memory."""
    index, _, _ = data.partition(b"\n")
    place, out = len(index) + 1, {}
    for name, kind, shape in json.loads(index):
        dtype, count = np.dtype(kind), math.prod(shape)
        out[name] = np.frombuffer(data, dtype, count, place).reshape(shape)
        place += _padded(count * dtype.itemsize)
    return out


def format_arrays(arrays: Mapping[str, Array]) -> bytes:
    """The bytes of a file of arrays."""
    index = [(name, array.dtype.str, array.shape) for name, array in arrays.items()]
    line = json.dumps(index, separators=(",", ":")).encode()
    # Spaces before the end of the line, so that every array begins where numbers of eight bytes may.
    parts = [line.ljust(_padded(len(line) + 1) - 1) + b"\n"]
    for array in arrays.values():
        raw = array.tobytes()
        parts.append(raw.ljust(_padded(len(raw)), b"\0"))
    return b"".join(parts)


def _padded(size: int) -> int:
    return -(-size // ALIGNED_BYTES) * ALIGNED_BYTES
