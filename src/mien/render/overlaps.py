"""Which pieces of a picture hide which others: read off a raster of samples with the nearest piece at each.

Source: Catmull 1974 (the depth buffer).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .pieces import Pieces, count_up

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

RASTER = 1536
"""Samples along the longer side of a picture of any size."""

CHUNK = 1 << 20
"""About as many samples are looked at together: what is needed on the way to them is not held for all at once."""


@dataclass(frozen=True, eq=False)
class Overlaps:
    """What a raster shows.

    Attributes:
        seen: numbers of the pieces that are the nearest somewhere.
        hidden: (above, below) -> on how many samples the one piece is the nearest and hides the other.
    """

    seen: tuple[int, ...]
    hidden: Mapping[tuple[int, int], int]


def find_overlaps(pieces: Pieces, size_px: tuple[int, int]) -> Overlaps:
    """Who hides whom, among those pieces that are seen at all, in a picture of that size."""
    width, height = (max(1, round(side * RASTER / max(size_px))) for side in size_px)
    scale = (width / size_px[0], height / size_px[1])
    samples = list(_Raster(pieces, scale, width, height).samples())
    count = len(pieces.polygon)
    nearest = np.zeros(width * height)
    for place, _, nearness in samples:
        np.maximum.at(nearest, place, nearness)
    winner = np.full(width * height, count)
    for place, piece, nearness in samples:
        hit = nearness == nearest[place]
        np.minimum.at(winner, place[hit], piece[hit])
    shown = np.zeros(count + 1, dtype=bool)
    shown[winner] = True
    pairs = [np.zeros(0, dtype=np.int64)]
    for place, piece, _ in samples:
        above = winner[place]
        pairs.append((above * count + piece)[(above != piece) & shown[piece]])
    pair, amount = np.unique(np.concatenate(pairs), return_counts=True)
    hidden = {divmod(key, count): number for key, number in zip(pair.tolist(), amount.tolist(), strict=True)}
    return Overlaps(tuple(np.flatnonzero(shown[:count]).tolist()), hidden)


class _Raster:
    """The triangles of pieces, and the samples that they cover."""

    def __init__(self, pieces: Pieces, scale: tuple[float, float], width: int, height: int) -> None:
        fans = np.diff(pieces.starts) - 2
        first = np.repeat(pieces.starts[:-1], fans)
        second = first + 1 + count_up(fans)
        triangles = (pieces.corners * (*scale, 1.0))[np.stack([first, second, second + 1], axis=1)]
        downwards = np.argsort(triangles[:, :, 1], axis=1, kind="stable")
        self._corners: Floats = np.take_along_axis(triangles, downwards[:, :, None], axis=1)
        self._owner = np.repeat(np.arange(len(fans)), fans)
        self._width, self._height = width, height

    def samples(self) -> Iterator[tuple[Ints, Ints, Floats]]:
        """Place on the raster, piece and 1 / depth of all samples, some at a time."""
        triangle, row, first, lengths = self._spans()
        along, down = (slope[triangle] for slope in self._slopes())
        top = self._corners[triangle, 0]
        start = top[:, 2] + (first + 0.5 - top[:, 0]) * along + (row + 0.5 - top[:, 1]) * down
        place, piece = row * self._width + first, self._owner[triangle]
        for spans in _runs(np.cumsum(lengths) // CHUNK):
            length = lengths[spans]
            step = count_up(length)
            nearness: Floats = np.repeat(start[spans], length) + step * np.repeat(along[spans], length)
            yield np.repeat(place[spans], length) + step, np.repeat(piece[spans], length), nearness

    def _spans(self) -> tuple[Ints, Ints, Ints, Ints]:
        """Triangle, row, first column and length of every run of samples."""
        first, last = (_first_centre(self._corners[:, k, 1], self._height) for k in (0, 2))
        triangle = np.repeat(np.arange(len(first)), last - first)
        row = first[triangle] + count_up(last - first)
        upper, middle, lower = (self._corners[triangle, k] for k in range(3))
        y: Floats = (row + 0.5).astype(np.float64)
        bend = np.where((y < middle[:, 1])[:, None], upper, lower)
        long, short = _crossing(y, upper, lower), _crossing(y, bend, middle)
        first, last = (_first_centre(end(long, short), self._width) for end in (np.minimum, np.maximum))
        return triangle, row, first, last - first

    def _slopes(self) -> tuple[Floats, Floats]:
        """Change of 1 / depth along and down the raster, of every triangle."""
        b, c = (self._corners[:, k] - self._corners[:, 0] for k in (1, 2))
        area = b[:, 0] * c[:, 1] - c[:, 0] * b[:, 1]
        area = np.where(area == 0.0, 1.0, area)
        return (b[:, 2] * c[:, 1] - c[:, 2] * b[:, 1]) / area, (b[:, 0] * c[:, 2] - c[:, 0] * b[:, 2]) / area


def _first_centre(place: Floats, size: int) -> Ints:
    """Number of the first sample whose centre is not before a place, within 0..size."""
    return np.ceil(np.clip(place, 0.0, float(size)) - 0.5).astype(np.int64)


def _crossing(y: Floats, start: Floats, end: Floats) -> Floats:
    """x at which edges cross rows; neighbours that share an edge find the same."""
    height = end[:, 1] - start[:, 1]
    return start[:, 0] + (y - start[:, 1]) * ((end[:, 0] - start[:, 0]) / np.where(height == 0.0, 1.0, height))


def _runs(values: Ints) -> Iterator[slice]:
    """Each run of equal values."""
    ends = np.flatnonzero(np.diff(values)) + 1
    for start, end in zip([0, *ends.tolist()], [*ends.tolist(), len(values)], strict=True):
        yield slice(start, end)
