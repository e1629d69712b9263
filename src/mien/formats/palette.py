"""Pictures in at most 256 colours, chosen for each of them.

Colours are counted in bins, the bins put into ever smaller boxes, each cut where it is widest; the mean of a box is a
colour. A bin counts by the square root of its pixels, so that an iris is not lost beside a background.

Source: Heckbert 1982, "Color image quantization for frame buffer display" (boxes); Wan, Wong and Prusinkiewicz 1988,
"An algorithm for multidimensional data clustering" (the box with the greatest variance, cut at its mean).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.compiling import kernel

Words = NDArray[np.uint32]
Numbers = NDArray[np.signedinteger[Any]]
Floats = NDArray[np.float64]
Codes = NDArray[np.uint8]

COLORS = 256

BINS = 64**3
"""Six bits of each of red, green and blue."""

VISIBLE = 128
"""Least alpha of a pixel that is shown."""

DITHER = 2
"""Codes by which the pattern shifts a colour at most: enough to break up bands, too little to be seen as a pattern.

The pattern stays where it is from frame to frame; diffused errors would crawl over what does not move.
"""


def _make_pattern() -> NDArray[np.int64]:
    """(8, 8) codes to add, as even as they can be in any part of it.

    Source: Bayer 1973, "An optimum method for two-level rendition of continuous-tone pictures".
    """
    steps = np.zeros((1, 1), dtype=np.int64)
    for _ in range(3):
        steps = np.block([[4 * steps, 4 * steps + 2], [4 * steps + 3, 4 * steps + 1]])
    middle = (steps.size - 1) / 2
    return np.rint((steps - middle) * (DITHER / middle)).astype(np.int64)


PATTERN = _make_pattern()


class Quantiser:
    """Reduces one picture after another; its memory is used again."""

    def __init__(self, clear: bool) -> None:
        """With ``clear``, the last colour is none, for what is not visible."""
        self._limit = COLORS - 1 if clear else COLORS
        self._bins = np.zeros((BINS, 4), dtype=np.int64)
        self._used = np.empty(BINS, dtype=np.int32)
        self._nearest = np.empty(BINS, dtype=np.int32)

    def reduce(self, words: Words) -> tuple[Codes, Codes]:
        """(H, W) number of each pixel's colour, and (COLORS, 4) RGBA of the colours.

        Args:
            words: (H, W) pixels as ``yuv.to_words`` gives them.
        """
        palette = np.zeros((COLORS, 3), dtype=np.int64)
        used = count_colors(words, self._bins, self._used)
        boxes, ends = np.zeros((COLORS, 3)), np.zeros((COLORS, 2), dtype=np.int64)
        count = choose_colors(self._bins, self._used, used, self._limit, boxes, ends, palette)
        numbers = np.empty(words.shape, dtype=np.uint8)
        self._nearest[:] = -1
        find_nearest(words, palette, max(count, 1), self._nearest, PATTERN, numbers)
        self._bins[self._used[:used]] = 0
        colors = np.full((COLORS, 4), 255, dtype=np.uint8)
        colors[:, :3] = palette
        colors[self._limit :] = 0
        return numbers, colors


@kernel("u4[:,:], i8[:,:], i4[:] -> i8")
def count_colors(words: Words, bins: Numbers, used: Numbers) -> int:
    """How many bins hold visible pixels.

    Args:
        words: (H, W).
        bins: (BINS, 4), nothing before; gets pixels, sums of red, green and blue.
        used: (BINS,), gets the numbers of the bins, in the order in which they were met.
    """
    count = 0
    for row in range(words.shape[0]):
        for x in range(words.shape[1]):
            word = np.int64(words[row, x])
            if word >> 24 < VISIBLE:
                continue
            red, green, blue = word & 255, (word >> 8) & 255, (word >> 16) & 255
            number = _bin(red, green, blue)
            if bins[number, 0] == 0:
                used[count] = number
                count += 1
            bins[number, 0] += 1
            bins[number, 1] += red
            bins[number, 2] += green
            bins[number, 3] += blue
    return count


@kernel("i8[:,:], i4[:], i8, i8, f8[:,:], i8[:,:], i8[:,:] -> i8")
def choose_colors(
    bins: Numbers, used: Numbers, count: int, limit: int, boxes: Floats, ends: Numbers, palette: Numbers
) -> int:
    """How many colours were chosen.

    Args:
        bins: (BINS, 4), as counted.
        used: (BINS,), the first ``count`` are sorted into boxes.
        count: of bins.
        limit: of colours.
        boxes: (COLORS, 3), to work in: variance, widest channel, mean of it.
        ends: (COLORS, 2), to work in: where a box begins and ends among the bins.
        palette: (COLORS, 3), gets red, green and blue.
    """
    if count == 0:
        return 0
    ends[0, 0], ends[0, 1] = 0, count
    _measure_box(bins, used, ends[0], boxes[0])
    number = 1
    while number < limit:
        widest = 0
        for box in range(1, number):
            if boxes[box, 0] > boxes[widest, 0]:
                widest = box
        if boxes[widest, 0] <= 0.0:
            break
        middle = _cut_box(bins, used, ends[widest], int(boxes[widest, 1]), boxes[widest, 2])
        ends[number, 0], ends[number, 1] = middle, ends[widest, 1]
        ends[widest, 1] = middle
        _measure_box(bins, used, ends[widest], boxes[widest])
        _measure_box(bins, used, ends[number], boxes[number])
        number += 1
    for box in range(number):
        for channel in range(3):
            pixels, total = 0, 0
            for place in range(ends[box, 0], ends[box, 1]):
                pixels += bins[used[place], 0]
                total += bins[used[place], channel + 1]
            palette[box, channel] = (2 * total + pixels) // (2 * pixels)
    return number


@kernel("u4[:,:], i8[:,:], i8, i4[:], i8[:,:], u1[:,:]")
def find_nearest(
    words: Words, palette: Numbers, count: int, nearest: Numbers, pattern: Numbers, numbers: Codes
) -> None:
    """Fills in the number of the colour that is nearest to each pixel, shifted by the pattern.

    Args:
        words: (H, W).
        palette: (COLORS, 3) red, green and blue.
        count: how many of them there are.
        nearest: (BINS,), -1 where the colour nearest to a bin was not looked for yet.
        pattern: (8, 8) codes to add.
        numbers: (H, W), to fill; what is not visible gets the last colour.
    """
    for row in range(words.shape[0]):
        for x in range(words.shape[1]):
            word = np.int64(words[row, x])
            if word >> 24 < VISIBLE:
                numbers[row, x] = COLORS - 1
                continue
            shift = pattern[row & 7, x & 7]
            red = min(max((word & 255) + shift, 0), 255)
            green = min(max(((word >> 8) & 255) + shift, 0), 255)
            blue = min(max(((word >> 16) & 255) + shift, 0), 255)
            number = _bin(red, green, blue)
            if nearest[number] < 0:
                nearest[number] = _search(palette, count, red & ~3, green & ~3, blue & ~3)
            numbers[row, x] = nearest[number]


@kernel()
def _bin(red: int, green: int, blue: int) -> int:
    return (red >> 2) << 12 | (green >> 2) << 6 | (blue >> 2)


@kernel()
def _measure_box(bins: Numbers, used: Numbers, ends: Numbers, box: Floats) -> None:
    box[0] = box[1] = box[2] = 0.0
    widest = -1.0
    for channel in range(1, 4):
        weights, mean, square = 0.0, 0.0, 0.0
        for place in range(ends[0], ends[1]):
            count = float(bins[used[place], 0])
            weight, value = np.sqrt(count), bins[used[place], channel] / count
            weights += weight
            mean += weight * value
            square += weight * value * value
        mean /= weights
        variance = square - weights * mean * mean
        box[0] += variance
        if variance > widest:
            widest = variance
            box[1], box[2] = channel, mean
    # What rounding leaves of a box with a single bin is no variance.
    if ends[1] - ends[0] < 2:
        box[0] = 0.0


@kernel()
def _cut_box(bins: Numbers, used: Numbers, ends: Numbers, channel: int, mean: float) -> int:
    """Where the upper part of a box begins, its bins sorted into two parts; neither is empty."""
    low, high = ends[0], ends[1] - 1
    while low <= high:
        number = used[low]
        if bins[number, channel] <= mean * bins[number, 0]:
            low += 1
        else:
            used[low], used[high] = used[high], number
            high -= 1
    return min(max(low, ends[0] + 1), ends[1] - 1)


@kernel()
def _search(palette: Numbers, count: int, red: int, green: int, blue: int) -> int:
    """The colour nearest to the middle of a bin that begins here."""
    found, least = 0, 1 << 30
    for number in range(count):
        # Twice the difference from the middle, which lies between two codes.
        reds, greens, blues = (
            2 * palette[number, 0] - 2 * red - 3,
            2 * palette[number, 1] - 2 * green - 3,
            2 * palette[number, 2] - 2 * blue - 3,
        )
        distance = reds * reds + greens * greens + blues * blues
        if distance < least:
            found, least = number, distance
    return found
