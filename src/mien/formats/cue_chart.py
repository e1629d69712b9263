"""What is said on each frame, as rows: Parke's frame-by-frame chart of the speech on a film, here as CSV.

Source: Parke 1974, section 4.3: "a frame by frame chart of the speech contained on the film".
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from mien.core import Cue, MienError
from mien.timeline.rates import time_of

from .cue_frames import choose_shapes, count_frames, place_cues
from .cue_shapes import find_set
from .cue_sheet import PHONES, SHAPES, WORDS, CueSheet
from .numbers import format_number

COLUMNS = ("frame", "time_s", "word", "phone", "shape")


@dataclass(frozen=True)
class Row:
    """A frame.

    Attributes:
        frame: its number, from 0, as of numbered pictures.
        time_s: its moment, seconds.
        words: what is said at it, usually one or none.
        phones: the same for phones; more than one where they are shorter than a frame.
        shape: the mouth to draw; empty when the sheet has none.
    """

    frame: int
    time_s: float
    words: tuple[Cue, ...]
    phones: tuple[Cue, ...]
    shape: str


def chart_rows(sheet: CueSheet, rate: Fraction, tier: str = SHAPES) -> list[Row]:
    """The frames of a recording; nothing that is said falls between two of them.

    Raises:
        MienError: the sheet has neither words nor phones nor shapes.
    """
    if not {WORDS, PHONES, tier} & sheet.tiers.keys():
        raise MienError(f"cues: want a tier {WORDS!r}, {PHONES!r} or {tier!r}, got {', '.join(map(repr, sheet.tiers))}")
    words, phones = (place_cues(sheet.tiers.get(name, ()), sheet.length_s, rate) for name in (WORDS, PHONES))
    shapes: Sequence[str] = [""] * count_frames(sheet.length_s, rate)
    if tier in sheet.tiers:
        names = find_set(cue.symbol for cue in sheet.tiers[tier])
        shapes = choose_shapes(sheet.tiers[tier], sheet.length_s, rate, names)
    return [
        Row(frame, time_of(float(frame), rate), *cells)
        for frame, cells in enumerate(zip(words, phones, shapes, strict=True))
    ]


def format_chart(sheet: CueSheet, rate: Fraction, tier: str = SHAPES) -> Iterator[str]:
    """Lines of the table, a row a frame."""
    yield _line(COLUMNS)
    for row in chart_rows(sheet, rate, tier):
        words, phones = (" ".join(cue.symbol for cue in cues) for cues in (row.words, row.phones))
        yield _line((str(row.frame), format_number(row.time_s, 6), words, phones, row.shape))


def _line(cells: Sequence[str]) -> str:
    line = io.StringIO()
    csv.writer(line, lineterminator="\n").writerow(cells)
    return line.getvalue()
