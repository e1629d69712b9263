"""Pictures as luma and chroma, ITU-R BT.709 in the narrow range, by whole numbers alone.

A pixel is read as one number of 32 bits, red in the lowest eight: the order of bytes (R, G, B, A) on a little-endian
processor. Chroma of 4:2:0 is the mean of two by two pixels.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.compiling import kernel

Pixels = NDArray[np.uint8]
Words = NDArray[np.uint32]
Plane = NDArray[np.unsignedinteger[Any]]

# Source: ITU-R BT.709-6, items 3.2 to 3.5: 219 and 224 steps of 255, times 2^16. Each row of chroma adds up to nothing,
# so that greys have none.
YR, YG, YB = 11966, 40254, 4064
UR, UG, UB = 6596, 22188, 28784
VR, VG, VB = 28784, 26145, 2639


def to_words(pixels: Pixels) -> Words:
    """(H, W) numbers of the same bytes as (H, W, 4) pixels."""
    return np.ascontiguousarray(pixels).view(np.uint32)[..., 0]


@kernel("u4[:,:], u1[:,:], u1[:,:], u1[:,:]")
def fill_420(pixels: Words, luma: Plane, blue: Plane, red: Plane) -> None:
    """Fills planes of 8 bits; chroma has half the rows and columns.

    Args:
        pixels: (H, W), even sides.
        luma: (H, at least W), codes 16..235.
        blue: (H / 2, at least W / 2), codes 16..240.
        red: the same.
    """
    width = pixels.shape[1]
    for pair in range(pixels.shape[0] // 2):
        upper, lower = pixels[2 * pair], pixels[2 * pair + 1]
        _luma_8(upper, luma[2 * pair, :width])
        _luma_8(lower, luma[2 * pair + 1, :width])
        _chroma_of_four(upper, lower, blue[pair, : width // 2], red[pair, : width // 2])


@kernel("u4[:,:], u2[:,:], u2[:,:], u2[:,:]")
def fill_444(pixels: Words, luma: Plane, blue: Plane, red: Plane) -> None:
    """Fills planes of 10 bits, as many rows and columns in each.

    Args:
        pixels: (H, W).
        luma: (H, at least W), codes 64..940.
        blue: (H, at least W), codes 64..960.
        red: the same.
    """
    width = pixels.shape[1]
    for row in range(pixels.shape[0]):
        _color_10(pixels[row], luma[row, :width], blue[row, :width], red[row, :width])


@kernel("u4[:,:], u1[:,:]")
def fill_alpha_8(pixels: Words, alpha: Plane) -> None:
    """Fills a plane (H, at least W) with alpha, 0..255."""
    for row in range(pixels.shape[0]):
        source, target = pixels[row], alpha[row]
        for x in range(source.shape[0]):
            target[x] = source[x] >> np.uint32(24)


@kernel("u4[:,:], u2[:,:]")
def fill_alpha_10(pixels: Words, alpha: Plane) -> None:
    """Fills a plane (H, at least W) with alpha, 0..1023."""
    for row in range(pixels.shape[0]):
        source, target = pixels[row], alpha[row]
        for x in range(source.shape[0]):
            share = source[x] >> np.uint32(24)
            target[x] = (share << np.uint32(2)) | (share >> np.uint32(6))


@kernel("u4[:,:], u4[:,:]")
def spread_color(pixels: Words, spread: Words) -> None:
    """Gives what is wholly transparent the colour of what is beside it, so that no edge turns dark when it is scaled.

    A gap in a row takes the colour of its nearer end; a row with nothing in it that of the next one above, or below.

    Args:
        pixels: (H, W).
        spread: (H, W), what to fill; alpha stays.

    Source: ISO/IEC 14496-2, section 7.6.1, repetitive padding.
    """
    height = pixels.shape[0]
    filled = -1
    for row in range(height):
        if _spread_row(pixels[row], spread[row]):
            if filled < 0:
                for above in range(row):
                    _copy_color(spread[row], spread[above])
            filled = row
        elif filled >= 0:
            _copy_color(spread[filled], spread[row])


@kernel()
def _luma_8(row: Words, luma: Plane) -> None:
    for x in range(row.shape[0]):
        word = row[x]
        red, green, blue = word & 255, (word >> np.uint32(8)) & 255, (word >> np.uint32(16)) & 255
        luma[x] = (YR * red + YG * green + YB * blue + ((16 << 16) + (1 << 15))) >> 16


@kernel()
def _chroma_of_four(upper: Words, lower: Words, blues: Plane, reds: Plane) -> None:
    ends = np.uint32(0x00FF00FF)
    for x in range(blues.shape[0]):
        a, b, c, d = upper[2 * x], upper[2 * x + 1], lower[2 * x], lower[2 * x + 1]
        # Red and blue are added in one go, with eight free bits above each.
        both = (a & ends) + (b & ends) + (c & ends) + (d & ends)
        middle = np.uint32(8)
        green = ((a >> middle) & 255) + ((b >> middle) & 255) + ((c >> middle) & 255) + ((d >> middle) & 255)
        red, blue = np.int32(both & 0xFFFF), np.int32(both >> np.uint32(16))
        blues[x] = (UB * blue - UR * red - UG * np.int32(green) + ((128 << 18) + (1 << 17))) >> 18
        reds[x] = (VR * red - VG * np.int32(green) - VB * blue + ((128 << 18) + (1 << 17))) >> 18


@kernel()
def _color_10(row: Words, lumas: Plane, blues: Plane, reds: Plane) -> None:
    for x in range(row.shape[0]):
        word = row[x]
        red, green = np.int32(word & 255), np.int32((word >> np.uint32(8)) & 255)
        blue = np.int32((word >> np.uint32(16)) & 255)
        lumas[x] = (YR * red + YG * green + YB * blue + ((64 << 14) + (1 << 13))) >> 14
        blues[x] = (UB * blue - UR * red - UG * green + ((512 << 14) + (1 << 13))) >> 14
        reds[x] = (VR * red - VG * green - VB * blue + ((512 << 14) + (1 << 13))) >> 14


@kernel()
def _spread_row(row: Words, spread: Words) -> bool:
    """Whether anything in the row is visible."""
    width = row.shape[0]
    last = -1
    for x in range(width):
        spread[x] = row[x]
        if row[x] >> np.uint32(24):
            # The gap before this pixel: all of it at the left side, else its nearer half.
            for gap in range(0 if last < 0 else (last + 1 + x) // 2, x):
                spread[gap] = row[x] & np.uint32(0x00FFFFFF)
            last = x
        elif last >= 0:
            spread[x] = row[last] & np.uint32(0x00FFFFFF)
    return last >= 0


@kernel()
def _copy_color(source: Words, target: Words) -> None:
    for x in range(target.shape[0]):
        target[x] = source[x] & np.uint32(0x00FFFFFF)
