"""A drawing as the arrays that the compiled filler takes: every outline once, whoever is cut by it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import accumulate

import numpy as np
from numpy.typing import NDArray

from mien.core import Drawing, Path, Region

from .filling import INSIDE, OUTSIDE, UNDER
from .pixels import ONE, to_samples, to_words
from .sweeping import END, FIRST, LEFT, RIGHT, place_edges

Ints = NDArray[np.int64]
Box = list[int]
Clip = tuple[int, int]
"""Number of a shape, and what it does to a path: INSIDE, OUTSIDE, UNDER."""


@dataclass(frozen=True, eq=False)
class Outlines:
    """What ``filling.fill_bands`` takes of a drawing, under the same names; E edges, S shapes."""

    edges: NDArray[np.float64]
    ways: NDArray[np.int32]
    starts: Ints
    nonzero: NDArray[np.uint8]
    paths: Ints
    colors: NDArray[np.uint64]
    clips: Ints
    masks: Ints


def place_canvas(drawing: Drawing, size_px: tuple[int, int]) -> tuple[float, float, float]:
    """Pixels a unit, and where the origin lies, pixels from the upper left.

    The canvas is as large as fits, in the middle between the sides, and stands on the lower edge of the picture: what
    lies below it, such as a hand that rests, is out of sight.
    """
    width, height = size_px
    scale = min(width / drawing.size[0], height / drawing.size[1])
    return scale, (width - scale * drawing.size[0]) / 2.0, float(height)


def find_fillings(drawing: Drawing) -> Iterator[tuple[int, int]]:
    """Numbers of paths that fill a hole exactly which a later path has, and of that one.

    Along the border of the hole each covers its part of a pixel; what is behind both would shine through between them.
    """
    own = [_key(path) for path in drawing.paths]
    for later, path in enumerate(drawing.paths):
        if path.outside:
            holes = {_key(region) for region in path.outside}
            yield from ((before, later) for before in range(later) if own[before] in holes)


def place_outlines(drawing: Drawing, size_px: tuple[int, int]) -> Outlines:
    """The outlines of a drawing in a picture of that size."""
    shapes = _Shapes()
    own = [shapes.number(path) for path in drawing.paths]
    clips = [
        [
            (shapes.number(region), kind)
            for kind, regions in ((INSIDE, path.inside), (OUTSIDE, path.outside))
            for region in regions
        ]
        for path in drawing.paths
    ]
    for path, later in find_fillings(drawing):
        clips[path].append((own[later], UNDER))
    edges, ways, starts, boxes = shapes.place(place_canvas(drawing, size_px), size_px)
    masks = sorted({shape for each in clips for shape, _ in each})
    number = {shape: mask for mask, shape in enumerate(masks)}
    windows = [_window(boxes[shape], each, boxes) for shape, each in zip(own, clips, strict=True)]
    reach: dict[int, Box] = {}
    for window, each in zip(windows, clips, strict=True):
        for shape, _ in each:
            reach[shape] = _around(reach[shape], window) if shape in reach else window
    ends = [*accumulate((len(each) for each in clips), initial=0)]
    colors = np.array([path.color for path in drawing.paths]).reshape(-1, 4)
    alphas = np.rint(colors[:, 3] * ONE).astype(np.int64)
    colors[:, 3] = 1.0
    rows = [
        (*window, shape, 0, first, end) for window, shape, first, end in zip(windows, own, ends, ends[1:], strict=False)
    ]
    paths = np.array(rows, dtype=np.int64).reshape(-1, 8)
    paths[:, 5] = alphas
    flat = [(number[shape], kind) for each in clips for shape, kind in each]
    return Outlines(
        edges, ways, starts, np.array(shapes.nonzero, dtype=np.uint8), paths, to_words(to_samples(colors)),
        np.array(flat, dtype=np.int64).reshape(-1, 2),
        np.array([(*_common(boxes[shape], reach[shape]), shape) for shape in masks], dtype=np.int64).reshape(-1, 5),
    )  # fmt: skip


class _Shapes:
    """Outlines by number; those made of the same arrays are the same."""

    def __init__(self) -> None:
        self.nonzero: list[bool] = []
        self._numbers: dict[tuple[object, ...], int] = {}
        self._contours: list[NDArray[np.float64]] = []
        self._ends = [0]

    def number(self, outline: Path | Region) -> int:
        key = _key(outline)
        if key not in self._numbers:
            self._numbers[key] = len(self.nonzero)
            self.nonzero.append(outline.rule == "nonzero")
            self._contours.extend(outline.contours)
            self._ends.append(len(self._contours))
        return self._numbers[key]

    def place(
        self, canvas: tuple[float, float, float], size_px: tuple[int, int]
    ) -> tuple[NDArray[np.float64], NDArray[np.int32], Ints, list[Box]]:
        """Edges, their ways, where those of each shape start, and its box."""
        points = np.concatenate([np.zeros((0, 2)), *self._contours])
        contours = np.array([*accumulate(map(len, self._contours), initial=0)])
        edges, ways = np.empty((len(points), 4)), np.empty(len(points), dtype=np.int32)
        starts, boxes = np.empty(len(self._ends), dtype=np.int64), np.empty((len(self.nonzero), 4), dtype=np.int64)
        place_edges(points, contours, np.array(self._ends), *canvas, *size_px, edges, ways, starts, boxes)
        return edges, ways, starts, boxes.tolist()


def _key(outline: Path | Region) -> tuple[object, ...]:
    """What outlines made of the same arrays have in common, while these are kept."""
    return (outline.rule, *map(id, outline.contours))


def _window(box: Box, clips: list[Clip], boxes: list[Box]) -> Box:
    for shape, kind in clips:
        if kind == INSIDE:
            box = _common(box, boxes[shape])
    return box


def _common(a: Box, b: Box) -> Box:
    return [max(a[LEFT], b[LEFT]), max(a[FIRST], b[FIRST]), min(a[RIGHT], b[RIGHT]), min(a[END], b[END])]


def _around(a: Box, b: Box) -> Box:
    return [min(a[LEFT], b[LEFT]), min(a[FIRST], b[FIRST]), max(a[RIGHT], b[RIGHT]), max(a[END], b[END])]
