"""One parameter's change over time: pieces of curves, holds between them."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mien.core import MienError

from .change import CHANGE_NAMES, CHANGES, change_code

Floats = NDArray[np.float64]

LIMIT = 1e9
"""Greatest size of a value or a time, s. No face goes there, and sums and products of such numbers stay finite."""


@dataclass(frozen=True)
class Segment:
    """One line of a specification list: from ``first`` at ``start_s`` to ``last`` at ``end_s``, both included.

    A segment without length sets ``last`` at one moment.

    Source: Parke 1974, section 4.1.
    """

    start_s: float
    end_s: float
    first: float
    last: float
    change: str = "linear"


@dataclass(frozen=True, eq=False)
class Track:
    """Segments of one parameter, in the order in which they were given; immutable.

    Where several segments cover a moment the later one wins; the visible parts of the others keep the curve of their
    whole. Between and after segments the last value is held. Before the first segment there is no value.
    Millions of segments are meant to fit: a track made of keys holds two views of its two arrays.

    Attributes:
        start_s: (M,) s, start of each segment.
        end_s: (M,) s, its end.
        first: (M,) value at its start.
        last: (M,) value at its end.
        change: (M,) uint8 row number in ``CHANGES``.
    """

    start_s: Floats
    end_s: Floats
    first: Floats
    last: Floats
    change: NDArray[np.uint8]
    name: str = field(default="", repr=False)

    def __post_init__(self) -> None:
        if len(self.start_s) == 0:
            raise MienError(f"{self._place()} has no key — give it one, or leave the track out")
        for numbers in (self.start_s, self.end_s):
            _refuse_times(numbers, self._place())
        backwards = np.flatnonzero(self.end_s < self.start_s)
        if len(backwards):
            row = int(backwards[0])
            start, end = float(self.start_s[row]), float(self.end_s[row])
            raise MienError(f"{self._place()}: a segment ends at {end!r} s, before it starts at {start!r} s")
        _refuse_values(self.first, self.start_s, self._place())
        _refuse_values(self.last, self.end_s, self._place())

    @classmethod
    def from_keys(
        cls, times_s: ArrayLike, values: ArrayLike, change: str | Sequence[str] = "linear", *, name: str = ""
    ) -> Track:
        """The track that goes through keys.

        Args:
            times_s: (K,) s, never decreasing; two keys at one time are a jump. A read-only array is kept, not copied,
                so that many tracks can share their times.
            values: (K,) value of each key.
            change: one change function for all, or K - 1 names, one for each way between two keys.
            name: the parameter, for messages only.

        Raises:
            MienError: no keys, unequal lengths, a number that is not finite, or times that go back.
            UnknownNameError: there is no such change function.
        """
        times, numbers = _frozen(times_s), _frozen(values)
        place = f"track {name!r}" if name else "track"
        if times.ndim != 1 or times.shape != numbers.shape:
            raise MienError(f"{place}: want as many times as values, got shapes {times.shape} and {numbers.shape}")
        _refuse_times(times, place)
        _refuse_values(numbers, times, place)
        back = np.flatnonzero(times[1:] < times[:-1])
        if len(back):
            row = int(back[0])
            raise MienError(f"{place}: key {row + 1} at {times[row + 1]} s comes before key {row} at {times[row]} s")
        ways = max(len(times) - 1, 0)
        if isinstance(change, str):
            codes = np.broadcast_to(np.uint8(change_code(change)), (max(ways, 1),))
        elif len(change) == ways:
            codes = np.array([change_code(each) for each in change] or [0], dtype=np.uint8)
        else:
            raise MienError(f"{place}: {len(times)} keys want {ways} change functions, got {len(change)}")
        if len(times) < 2:
            return cls(times, times, numbers, numbers, np.zeros(len(times), dtype=np.uint8), name)
        return cls(times[:-1], times[1:], numbers[:-1], numbers[1:], codes, name)

    @classmethod
    def from_segments(cls, segments: Iterable[Segment], *, name: str = "") -> Track:
        """The track of some segments; where two cover the same moment the later in the list wins.

        Raises:
            MienError: no segment, one that ends before it starts, or a number that is not finite.
            UnknownNameError: there is no such change function.
        """
        rows = list(segments)
        return cls(
            _frozen([row.start_s for row in rows]),
            _frozen([row.end_s for row in rows]),
            _frozen([row.first for row in rows]),
            _frozen([row.last for row in rows]),
            np.array([change_code(row.change) for row in rows], dtype=np.uint8),
            name,
        )

    def __len__(self) -> int:
        return len(self.start_s)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Track):
            return NotImplemented
        return all(np.array_equal(mine, theirs) for mine, theirs in zip(self._columns, other._columns, strict=True))

    def __hash__(self) -> int:
        return hash(tuple(column.tobytes() for column in self._columns))

    @property
    def length_s(self) -> float:
        """When the last segment ends, s."""
        return float(self.end_s.max())

    @property
    def first_s(self) -> float:
        """When the first segment starts, s; before it the track says nothing."""
        return float(self.start_s.min())

    def segments(self) -> Iterator[Segment]:
        """The segments, in the order in which they were given."""
        for start, end, first, last, code in zip(*self._columns, strict=True):
            yield Segment(float(start), float(end), float(first), float(last), CHANGE_NAMES[code])

    def keys(self) -> tuple[Floats, Floats] | None:
        """Times (K,) s and values (K,), when the track is nothing but a way through keys; else None."""
        joined = np.array_equal(self.end_s[:-1], self.start_s[1:]) and np.array_equal(self.last[:-1], self.first[1:])
        if not joined:
            return None
        if len(self) == 1 and self == Track.from_keys(self.start_s, self.first):
            return self.start_s, self.first
        return np.append(self.start_s, self.end_s[-1]), np.append(self.first, self.last[-1])

    def given(self) -> tuple[Floats, Floats]:
        """Times (K,) s and values (K,) of all ends of segments: the dots of Parke's Appendix B, sorted by time."""
        keys = self.keys()
        if keys is not None:
            return keys
        points = np.stack([np.append(self.start_s, self.end_s), np.append(self.first, self.last)], axis=1)
        points = np.unique(points, axis=0)
        return points[:, 0], points[:, 1]

    def evaluate(self, times_s: ArrayLike) -> tuple[Floats, NDArray[np.bool_]]:
        """Values (N,) at times (N,) s, and whether some segment covers each time (N,).

        A time that none covers has the value held since the last one, and before the first NaN.

        Source: Parke 1974, section 4.1: value = initial + PCF * DIFF.
        """
        times = np.asarray(times_s, dtype=np.float64)
        starts, ends, rows = self._pieces
        piece = np.searchsorted(starts, times, side="right") - 1
        begun = piece >= 0
        piece = np.maximum(piece, 0)
        covered = begun & (times <= ends[piece])
        row = piece if rows is None else rows[piece]
        start, end = self.start_s[row], self.end_s[row]
        first, last = self.first[row], self.last[row]
        # Times are held inside the piece first, so that nothing overflows and holding is the value at its end.
        inside = np.clip(times, starts[piece], ends[piece])
        length = end - start
        fraction = np.where(length > 0.0, (inside - start) / np.where(length > 0.0, length, 1.0), 1.0)
        share = self._shares(fraction, row)
        values = np.where(share >= 1.0, last, first + share * (last - first))
        return np.where(begun, values, np.nan), covered

    @cached_property
    def _pieces(self) -> tuple[Floats, Floats, NDArray[np.intp] | None]:
        """Starts and ends of what is seen of the segments, sorted, and the segment of each (None: its own row)."""
        if np.all(self.start_s[1:] >= self.end_s[:-1]):
            return self.start_s, self.end_s, None
        return _resolve(self.start_s, self.end_s)

    @cached_property
    def _codes(self) -> tuple[int, ...]:
        """The change functions that occur."""
        return tuple(int(code) for code in np.flatnonzero(np.bincount(self.change)))

    @property
    def _columns(self) -> tuple[NDArray[Any], ...]:
        return self.start_s, self.end_s, self.first, self.last, self.change

    def _shares(self, fraction: Floats, row: NDArray[np.intp]) -> Floats:
        if len(self._codes) == 1:
            return CHANGES[CHANGE_NAMES[self._codes[0]]](fraction)
        codes, share = self.change[row], np.empty_like(fraction)
        for code in self._codes:
            here = codes == code
            share[here] = CHANGES[CHANGE_NAMES[code]](fraction[here])
        return share

    def _place(self) -> str:
        return f"track {self.name!r}" if self.name else "track"


def _resolve(start_s: Floats, end_s: Floats) -> tuple[Floats, Floats, NDArray[np.intp]]:
    """What is seen of closed intervals when each hides the earlier ones: starts, ends and row numbers, sorted.

    Floating-point numbers are a discrete set, so a closed interval without a closed interval is again closed: it ends
    at the number just before, or starts just after. Both ends of a segment thus belong to it, as Parke's frames do.
    """
    after = np.nextafter(end_s, np.inf)
    bounds = np.unique(np.concatenate([start_s, after]))
    order = np.argsort(start_s, kind="stable")
    active: list[tuple[int, float]] = []
    starts: list[float] = []
    ends: list[float] = []
    rows: list[int] = []
    shown, nxt = -1, 0
    for bound in bounds.tolist():
        while nxt < len(order) and start_s[order[nxt]] <= bound:
            heapq.heappush(active, (-int(order[nxt]), float(after[order[nxt]])))
            nxt += 1
        while active and active[0][1] <= bound:
            heapq.heappop(active)
        top = -active[0][0] if active else -1
        if top == shown:
            continue
        if shown >= 0:
            ends.append(float(np.nextafter(bound, -np.inf)))
        if top >= 0:
            starts.append(bound)
            rows.append(top)
        shown = top
    return _frozen(starts), _frozen(ends), np.array(rows, dtype=np.intp)


def _refuse_times(times_s: Floats, place: str) -> None:
    wrong = np.flatnonzero(~(np.abs(times_s) <= LIMIT))
    if len(wrong):
        row = int(wrong[0])
        raise MienError(f"{place}: time {float(times_s[row])!r} of key {row} is not a finite number within ±{LIMIT:g}")


def _refuse_values(values: Floats, times_s: Floats, place: str) -> None:
    wrong = np.flatnonzero(~(np.abs(values) <= LIMIT))
    if len(wrong):
        value, time = float(values[wrong[0]]), float(times_s[wrong[0]])
        raise MienError(f"{place}: value {value!r} at {time!r} s is not a finite number within ±{LIMIT:g}")


def _frozen(numbers: ArrayLike) -> Floats:
    array = np.asarray(numbers, dtype=np.float64)
    if array.flags.writeable:
        array = array.copy()
        array.flags.writeable = False
    return array
