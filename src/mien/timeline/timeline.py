"""Everything that moves a face over time, as layers of tracks."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mien.core import Cue, MienError, ParameterTable, Pose, RangeError, UnknownNameError

from .layers import BLENDS, Layer
from .rates import Rate, exact_rate, time_of
from .track import LIMIT, Floats

CHUNK_FRAMES = 256
"""Frames evaluated at once; bounds the memory of a long timeline."""

_BOUND = 1e30  # far outside every range; keeps many multiplied layers from reaching infinity, and so NaN


@dataclass(frozen=True)
class Timeline:
    """Layers of tracks, lowest first, with the words and phones they go with; immutable.

    Attributes:
        layers: from the lowest to the one that has the last word.
        length_s: duration, s.
        fps: frame rate it was made for, if any; it can be played at every rate.
        words: cues of the words, in order.
        phones: cues of the phones, in order.
        title: what a person would call it.
        text: what is said, as it was written; the words are found in it, in order.
        seed: of the generators that made it, if any.
    """

    layers: tuple[Layer, ...]
    length_s: float
    fps: float | None = None
    words: tuple[Cue, ...] = ()
    phones: tuple[Cue, ...] = ()
    title: str = ""
    text: str = ""
    seed: int | None = None

    def __post_init__(self) -> None:
        for name in ("layers", "words", "phones"):
            object.__setattr__(self, name, tuple(getattr(self, name)))
        if not 0.0 <= self.length_s <= LIMIT:
            raise RangeError(f"timeline: a length of {self.length_s} s is not a number from 0 to {LIMIT:g}")
        if self.fps is not None:
            exact_rate(self.fps)
        seen: set[str] = set()
        for layer in self.layers:
            if layer.name in seen:
                raise MienError(f"timeline: there are two layers {layer.name!r} — give one of them another name")
            seen.add(layer.name)

    def layer(self, name: str) -> Layer:
        """The layer of a name.

        Raises:
            UnknownNameError: there is none.
        """
        for layer in self.layers:
            if layer.name == name:
                return layer
        raise UnknownNameError("layer", name, [layer.name for layer in self.layers])

    def with_layer(self, layer: Layer) -> Timeline:
        """The timeline with a layer on top, or in the place of the one that has its name; as long as either."""
        names = [each.name for each in self.layers]
        if layer.name in names:
            layers = tuple(layer if each.name == layer.name else each for each in self.layers)
        else:
            layers = (*self.layers, layer)
        return replace(self, layers=layers, length_s=max(self.length_s, layer.length_s))

    def frame_count(self, fps: Rate) -> int:
        """Number of frames at a rate; at least one, the last starts before the end.

        A length that is a whole number of frames but for rounding (a millionth of a frame) counts as whole.
        """
        return max(1, math.ceil(self.length_s * float(exact_rate(fps)) - 1e-6))

    def frame_times(self, fps: Rate) -> Floats:
        """(N,) s, the time of each frame: frame k is at k / fps, exactly (at 23.976 that is k · 1001 / 24000)."""
        return time_of(np.arange(self.frame_count(fps), dtype=np.float64), exact_rate(fps))

    def driven(self, table: ParameterTable) -> tuple[str, ...]:
        """Names of the rows that some track drives, in the table's order.

        Raises:
            UnknownNameError: a track's parameter is not in the table.
        """
        rows = {row for layer in self.layers for name in layer.tracks for row in table.resolve(name)}
        return tuple(name for name in table.names if name in rows)

    def values(self, times_s: ArrayLike, table: ParameterTable) -> Floats:
        """(N, P) values at times (N,) s, within the table's ranges.

        Starts from the defaults and lets the layers act in order; only the outcome is brought into range, so that a
        sum may pass through values outside it.

        Raises:
            MienError: a time is not finite.
            UnknownNameError: a track's parameter is not in the table.
        """
        return self.evaluate(times_s, table)[0]

    def evaluate(self, times_s: ArrayLike, table: ParameterTable) -> tuple[Floats, NDArray[np.bool_]]:
        """Values (N, P) as ``values`` gives them, and which of them some segment covers at that moment, (N, P)."""
        times = np.atleast_1d(np.asarray(times_s, dtype=np.float64))
        if times.ndim != 1 or not np.all(np.isfinite(times)):
            raise MienError("timeline: want a list of finite times in seconds")
        columns = np.repeat(table.defaults[:, None], len(times), axis=1)
        covered = np.zeros(columns.shape, dtype=np.bool_)
        for layer in self.layers:
            blend = BLENDS[layer.blend]
            for name, track in layer.tracks.items():
                numbers, covers = track.evaluate(times)
                silent = np.isnan(numbers)
                for row_name in table.resolve(name):
                    row = table.index[row_name]
                    acted = np.clip(blend(columns[row], numbers, layer.weight), -_BOUND, _BOUND)
                    columns[row] = np.where(silent, columns[row], acted)
                    covered[row] |= covers
        # Adding 0 makes -0 a 0: they look alike everywhere but in the bytes.
        return np.clip(columns.T, table.lows, table.highs) + 0.0, covered.T

    def chunks(self, table: ParameterTable, fps: Rate) -> Iterator[tuple[int, Floats, NDArray[np.bool_]]]:
        """The frames at a rate in pieces of bounded size: number of the first frame, values (N, P), covered (N, P)."""
        rate, count = exact_rate(fps), self.frame_count(fps)
        for first in range(0, count, CHUNK_FRAMES):
            frames = np.arange(first, min(first + CHUNK_FRAMES, count), dtype=np.float64)
            yield first, *self.evaluate(time_of(frames, rate), table)

    def poses(self, table: ParameterTable, fps: Rate) -> Iterator[Pose]:
        """The pose of each frame at a rate, in order."""
        for _, values, _ in self.chunks(table, fps):
            for row in values:
                yield Pose(table, row)
