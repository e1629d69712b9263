"""How well phones and shapes fit labels: boundary errors, agreement of shapes, closures; with bootstrap intervals."""

from __future__ import annotations

import csv
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mien.core import SILENCE, Cue
from mien.speech.phones import VOWELS, strip_stress

from .labels import Segment

Floats = NDArray[np.float64]

FRAME_S = 0.01
BLOCK_S = 1.0
"""The bootstrap draws seconds of speech."""

DRAWS = 1000
SHORT_PAUSE_S = 0.2
FIRST_TARGET_SHARE = 0.6
CLOSED, LIP_TUCK = ("A", "X"), "G"
SHUT, TUCKED = frozenset("PBM"), frozenset("FV")

PLACES = tuple(
    frozenset(place.split())
    for place in ("P B M", "F V", "T D N L", "K G NG", "S Z", "SH ZH CH JH", "TH DH", "R ER W", "Y IY IH")
)
"""Phones that are easily taken for one another: they are made at one place."""


@dataclass(frozen=True)
class Allowed:
    """Shapes of a phone: the one that is meant, the others that pass, and those that pass late in it."""

    shape: str
    also: frozenset[str]
    late: frozenset[str]


@cache
def allowed_shapes() -> dict[str, Allowed]:
    """The rule of agreement by phone, ``allowed_shapes.csv``."""
    with (Path(__file__).parent / "allowed_shapes.csv").open(encoding="utf-8") as file:
        return {
            row["phone"]: Allowed(row["shape"], frozenset(row["also"].split()), frozenset(row["late"].split()))
            for row in csv.DictReader(file)
        }


@dataclass
class Block:
    """Counts of a second of speech."""

    errors_s: list[float] = field(default_factory=list)
    boundaries: int = 0
    frames: int = 0
    strict: int = 0
    lenient: int = 0
    open_frames: int = 0
    false_closures: int = 0
    labials: int = 0
    shut: int = 0
    tuckable: int = 0
    tucked: int = 0


@dataclass(frozen=True)
class Figure:
    """A measure with its 95 % interval."""

    value: float
    low: float
    high: float


def score(segments: Sequence[Segment], phones: Sequence[Cue] | None, shapes: Sequence[Cue]) -> list[Block]:
    """Counts of a clip, second by second; boundaries only where the phones are known."""
    blocks = [Block() for _ in range(int(segments[-1].end_s / BLOCK_S) + 1)]
    _score_frames(segments, shapes, blocks)
    _score_lips(segments, shapes, blocks)
    if phones is not None:
        _score_boundaries(segments, phones, blocks)
    return blocks


@dataclass(frozen=True, eq=False)
class Sums:
    """Errors of boundaries, seconds, and the sums of all other counts, of some seconds of speech."""

    errors_s: Floats
    counts: dict[str, float]

    def share(self, count: str, of: str) -> float:
        """Per cent."""
        return 100.0 * self.counts[count] / self.counts[of] if self.counts[of] else np.nan

    def within(self, limit_s: float) -> float:
        """Per cent of the boundaries that are no farther off."""
        return 100.0 * float(np.mean(np.abs(self.errors_s) <= limit_s + 1e-9)) if len(self.errors_s) else np.nan


MEASURES: dict[str, Callable[[Sums], float]] = {
    "boundary ms": lambda sums: 1000.0 * float(np.median(np.abs(sums.errors_s))) if len(sums.errors_s) else np.nan,
    "20 ms %": lambda sums: sums.within(0.020),
    "50 ms %": lambda sums: sums.within(0.050),
    "found %": lambda sums: sums.share("found", "boundaries"),
    "strict %": lambda sums: sums.share("strict", "frames"),
    "lenient %": lambda sums: sums.share("lenient", "frames"),
    "p b m shut %": lambda sums: sums.share("shut", "labials"),
    "f v tucked %": lambda sums: sums.share("tucked", "tuckable"),
    "false closures %": lambda sums: sums.share("false_closures", "open_frames"),
}
"""Columns of the table."""


def figures(blocks: Sequence[Block], seed: int = 0) -> dict[str, Figure]:
    """Every measure, with the interval between the 2.5th and 97.5th percentile of a thousand draws of seconds."""
    random = np.random.default_rng(seed)
    names = [field.name for field in fields(Block) if field.name != "errors_s"]
    table = np.array([[getattr(block, name) for name in names] for block in blocks], dtype=np.float64)
    errors = np.array([error for block in blocks for error in block.errors_s])
    owners = np.array([number for number, block in enumerate(blocks) for _ in block.errors_s], dtype=np.int64)

    def sums(times: NDArray[np.int64]) -> Sums:
        counts = dict(zip(names, map(float, times @ table), strict=True))
        return Sums(np.repeat(errors, times[owners]), counts | {"found": float(times[owners].sum())})

    draws = [sums(times) for times in random.multinomial(len(blocks), [1.0 / len(blocks)] * len(blocks), size=DRAWS)]
    whole = sums(np.ones(len(blocks), dtype=np.int64))
    out = {}
    for name, measure in MEASURES.items():
        spread = np.array([measure(draw) for draw in draws])
        spread = spread[np.isfinite(spread)]
        low, high = np.percentile(spread, [2.5, 97.5]) if len(spread) else (np.nan, np.nan)
        out[name] = Figure(measure(whole), float(low), float(high))
    return out


def match_phones(wanted: Sequence[tuple[float, float, str]], heard: Sequence[tuple[float, float, str]]) -> list[int]:
    """For each labelled phone the heard one that is it, or -1: the cheapest pairing in order.

    Both are (start, end, phone without stress). Sounds alike cost little, other places in time cost more.
    """
    cost = np.zeros((len(wanted) + 1, len(heard) + 1))
    cost[:, 0], cost[0, :] = np.arange(len(wanted) + 1), np.arange(len(heard) + 1)
    step = np.zeros(cost.shape, dtype=np.int8)
    step[0, :] = 2
    step[:, 0] = 1
    for i, (start_s, end_s, phone) in enumerate(wanted, start=1):
        for j, (begin_s, stop_s, other) in enumerate(heard, start=1):
            apart = min(1.0, 2.0 * (abs(start_s - begin_s) + abs(end_s - stop_s)))
            ways = (cost[i - 1, j - 1] + _unlike(phone, other) + apart, cost[i - 1, j] + 1.0, cost[i, j - 1] + 1.0)
            step[i, j] = int(np.argmin(ways))
            cost[i, j] = ways[step[i, j]]
    pairs, i, j = [-1] * len(wanted), len(wanted), len(heard)
    while i or j:
        if step[i, j] == 0:
            i, j = i - 1, j - 1
            pairs[i] = j if _unlike(wanted[i][2], heard[j][2]) < 1.0 else -1
        elif step[i, j] == 1:
            i -= 1
        else:
            j -= 1
    return pairs


def boundary_errors(segments: Sequence[Segment], phones: Sequence[Cue]) -> list[tuple[Segment, Segment, float | None]]:
    """Every labelled boundary: segment before and after, and heard minus labelled time, None where it is not found.

    It is found where the phone after it is. Pauses count as phones.
    """
    spelled = [(segment.start_s, segment.end_s, phone) for segment in segments for phone in segment.phones or ("?",)]
    first = np.cumsum([0, *(len(segment.phones or ("?",)) for segment in segments)])
    heard = [(cue.start_s, cue.end_s, strip_stress(cue.symbol)) for cue in phones]
    pairs = match_phones(spelled, heard)
    out: list[tuple[Segment, Segment, float | None]] = []
    for number in range(1, len(segments)):
        before, after = segments[number - 1], segments[number]
        if not before.phones or not after.phones:
            continue
        pair = pairs[first[number]]
        out.append((before, after, heard[pair][0] - after.start_s if pair > 0 else None))
    return out


def _score_boundaries(segments: Sequence[Segment], phones: Sequence[Cue], blocks: list[Block]) -> None:
    for _, after, error in boundary_errors(segments, phones):
        block = blocks[int(after.start_s / BLOCK_S)]
        block.boundaries += 1
        if error is not None:
            block.errors_s.append(error)


def _score_frames(segments: Sequence[Segment], shapes: Sequence[Cue], blocks: list[Block]) -> None:
    for segment in segments:
        if not segment.phones:
            continue
        for time_s in _frames(segment.start_s, segment.end_s):
            block, shape = blocks[int(time_s / BLOCK_S)], shape_at(shapes, time_s)
            share = (time_s - segment.start_s) / (segment.end_s - segment.start_s)
            strict, lenient = _wanted(segment, share)
            block.frames += 1
            block.strict += shape in strict
            block.lenient += shape in lenient
            if not segment.is_pause and not SHUT & set(segment.phones):
                block.open_frames += 1
                block.false_closures += shape in CLOSED


def _score_lips(segments: Sequence[Segment], shapes: Sequence[Cue], blocks: list[Block]) -> None:
    for segment in segments:
        shown = {shape_at(shapes, time_s) for time_s in _frames(segment.start_s, segment.end_s)}
        block = blocks[int(segment.start_s / BLOCK_S)]
        if SHUT & set(segment.phones):
            block.labials += 1
            block.shut += bool(shown & set(CLOSED))
        if TUCKED & set(segment.phones):
            block.tuckable += 1
            block.tucked += LIP_TUCK in shown


def _wanted(segment: Segment, share: float) -> tuple[set[str], set[str]]:
    """Shapes that agree strictly and leniently, so far into a segment."""
    table = allowed_shapes()
    strict: set[str] = set()
    lenient: set[str] = set()
    for phone in segment.phones:
        name = "SIL-short" if phone == SILENCE and segment.end_s - segment.start_s < SHORT_PAUSE_S else phone
        targets = [table[each] for each in (name, name + "+") if each in table]
        late = share >= FIRST_TARGET_SHARE
        strict.add(targets[-1 if late else 0].shape)
        for target in targets:
            lenient |= {target.shape} | target.also | (target.late if late else frozenset())
    return strict, lenient


def shape_at(cues: Sequence[Cue], time_s: float) -> str:
    """The symbol at that time; after the end the last one."""
    low, high = 0, len(cues) - 1
    while low < high:
        middle = (low + high) // 2
        if time_s < cues[middle].end_s:
            high = middle
        else:
            low = middle + 1
    return cues[low].symbol if cues else ""


def _frames(start_s: float, end_s: float) -> Floats:
    """Middles of the frames whose middle is in this time."""
    first, last = np.ceil(start_s / FRAME_S - 0.5), np.ceil(end_s / FRAME_S - 0.5)
    return (np.arange(first, last) + 0.5) * FRAME_S


@cache
def _unlike(phone: str, other: str) -> float:
    """What it costs to take one phone for the other: 0 for the same, 2 for a pause taken for a sound."""
    if phone == other:
        return 0.0
    if SILENCE in (phone, other):
        return 2.0
    if any({phone, other} <= place for place in PLACES):
        return 0.3
    return 0.4 if phone in VOWELS and other in VOWELS else 1.6 if (phone in VOWELS) != (other in VOWELS) else 1.0
