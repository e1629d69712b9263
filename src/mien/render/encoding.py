"""Rows of samples to rows of pixels, compiled; the same numbers as ``pixels.encode`` gives."""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: allow-untyped-defs, allow-untyped-calls, no-check-untyped-defs

from __future__ import annotations

import numpy as np

from mien.compiling import kernel

from .pixels import ONE


# Loops where a slice could be assigned: Numba takes ten times as long to compile an assignment to a slice.
@kernel()
def fill(values, value):
    """Make all values this one."""
    for x in range(np.uint64(len(values))):
        values[x] = value


@kernel()
def encode_row(samples, codes, opaque, out):
    """Samples as packed pixels; ``codes`` (ONE + 1,) has the sRGB code of every linear value.

    Where they are not all ``opaque``, what is partly covered in ``samples`` loses its multiplication by coverage.
    """
    if opaque:
        _encode(samples, codes, out)
    else:
        _make_straight(samples)
        _encode(samples, codes, out)
        _encode_cover(samples, out)


@kernel()
def _encode(samples, codes, out):
    """Samples with full coverage as sRGB; ``codes`` (ONE + 1,) has the code of every linear value."""
    low = np.uint64(0xFFFF)
    for x in range(np.uint64(len(out))):
        sample = samples[x]
        red, green = codes[sample & low], codes[(sample >> np.uint64(16)) & low]
        blue = codes[(sample >> np.uint64(32)) & low]
        packed = np.uint32(red) | (np.uint32(green) << np.uint32(8)) | (np.uint32(blue) << np.uint32(16))
        out[x] = packed | np.uint32(255 << 24)


@kernel()
def _make_straight(samples):
    """Divide colours by their coverage where it is neither nothing nor full."""
    low = np.uint64(0xFFFF)
    one = np.uint64(ONE)
    for x in range(len(samples)):
        sample = samples[x]
        cover = sample >> np.uint64(48)
        if cover > np.uint64(0) and cover < one:
            red = min((sample & low) * one // cover, one)
            green = min(((sample >> np.uint64(16)) & low) * one // cover, one)
            blue = min(((sample >> np.uint64(32)) & low) * one // cover, one)
            samples[x] = red | (green << np.uint64(16)) | (blue << np.uint64(32)) | (cover << np.uint64(48))


@kernel()
def _encode_cover(samples, out):
    for x in range(len(out)):
        alpha = ((samples[x] >> np.uint64(48)) * np.uint64(255) + np.uint64(ONE // 2)) >> np.uint64(14)
        out[x] = (out[x] & np.uint32(0xFFFFFF)) | np.uint32(alpha << np.uint64(24))
