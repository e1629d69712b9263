"""The chart of the speech on a film as an exposure sheet to print: HTML, two columns of frames on each page."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from html import escape
from importlib import resources
from itertools import pairwise

from mien.core import SILENCE, Cue

from .cue_chart import Row, chart_rows
from .cue_mouths import mouth_sayings, mouth_symbols
from .cue_shapes import ShapeSet, find_set
from .cue_sheet import SHAPES, CueSheet
from .notes import software
from .numbers import format_number

ROWS = 48
"""Frames of a column that a page has room for: two seconds of film."""

COLUMN_MM, LEGEND_MM = 245.0, 8.0
"""Height of the frames of a column on paper, of which each row of mouths below takes some."""

LONGEST_BEAT = 8
"""Frames between two stronger lines at most: half a foot of film."""

LEGEND = 9
"""Mouths beside one another at the foot of a page, at most."""

TITLE_LENGTH = 150


def format_page(sheet: CueSheet, rate: Fraction, tier: str = SHAPES) -> Iterator[str]:
    """Pieces of the page, which needs nothing else: style, mouths, and a section for each sheet of paper.

    Raises:
        MienError: the sheet has neither words nor phones nor shapes.
    """
    rows = chart_rows(sheet, rate, tier)
    names = find_set(row.shape for row in rows)
    legend = _legend_of(names) if tier in sheet.tiers else {}
    yield _format_head(_title_of(sheet), mouth_symbols() if legend else "")
    length = _column_length(rate)
    columns = [rows[first : first + length] for first in range(0, len(rows), length)]
    pages = [columns[first : first + 2] for first in range(0, len(columns), 2)]
    row_mm = format_number((COLUMN_MM - LEGEND_MM * _legend_rows(legend)) / length, 3)
    for number, page in enumerate(pages, start=1):
        yield f'<section class="sheet" style="--row: {row_mm}mm">\n'
        yield _format_header(sheet, rate, len(rows), f"<b>{number}</b> / {len(pages)}")
        yield "<main>\n"
        for column in page:
            first = column[0].frame
            yield from _format_column(column, rows[first - 1] if first else None, names, rate)
        yield f"</main>\n{_format_legend(legend)}</section>\n"
    yield "</body>\n</html>\n"


def _title_of(sheet: CueSheet) -> str:
    title = " ".join(sheet.text.split()) or sheet.sound or "Exposure sheet"
    return escape(title if len(title) <= TITLE_LENGTH else title[: TITLE_LENGTH - 1].rstrip() + "…")


def _format_head(title: str, symbols: str) -> str:
    style = resources.files(__package__).joinpath("data/exposure_sheet.css").read_text(encoding="utf-8")
    return (
        f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<title>{title}</title>\n'
        f'<meta name="generator" content="{escape(software())}">\n<style>\n{style}</style>\n</head>\n<body>\n'
        f'<svg class="store" aria-hidden="true">\n{symbols}\n</svg>\n'
    )


def _format_header(sheet: CueSheet, rate: Fraction, frames: int, page: str) -> str:
    facts = [
        escape(sheet.sound),
        f"{format_number(float(rate), 3)} frames a second",
        f"{format_number(sheet.length_s, 3)} s",
        f"{frames} frames",
    ]
    told = " · ".join(fact for fact in facts if fact)
    return f'<header><div><h1>{_title_of(sheet)}</h1><p>{told}</p></div><p class="number">{page}</p></header>\n'


def _column_length(rate: Fraction) -> int:
    """Frames of a column: whole seconds, as many as are nearest to ``ROWS``."""
    second = _second(rate)
    return max(1, round(ROWS / second)) * second if second <= 1.5 * ROWS else ROWS


def _second(rate: Fraction) -> int:
    """Frames of a second, rounded; 23.976 are 24."""
    return max(1, round(rate))


def _beat(rate: Fraction) -> int:
    """Frames between two stronger lines, which divide a second evenly."""
    second = _second(rate)
    return max(number for number in range(1, LONGEST_BEAT + 1) if second % number == 0)


def _format_column(rows: Sequence[Row], before: Row | None, names: ShapeSet, rate: Fraction) -> Iterator[str]:
    yield (
        '<table>\n<thead><tr><th class="frame">frame</th><th class="time">s</th><th>word</th>'
        '<th class="phone">phone</th><th class="shape" colspan="2">mouth</th></tr></thead>\n<tbody>\n'
    )
    words = _format_blocks("word", [row.words for row in rows], before.words if before else ())
    phones = _format_blocks("phone", [row.phones for row in rows], before.phones if before else ())
    shape = before.shape if before else ""
    for row, word, phone in zip(rows, words, phones, strict=True):
        kind = "second" if row.frame % _second(rate) == 0 else "beat" if row.frame % _beat(rate) == 0 else ""
        yield (
            f'<tr class="{kind}"><th class="frame">{row.frame}</th><td class="time">{row.time_s:.3f}</td>'
            f"{word}{phone}{_format_shape(row.shape, shape, names)}</tr>\n"
        )
        shape = row.shape
    yield "</tbody>\n</table>\n"


def _format_blocks(kind: str, cells: Sequence[tuple[Cue, ...]], before: tuple[Cue, ...]) -> list[str]:
    """The cell of each frame: one for as long as nothing new begins, and nothing for the frames that it covers."""
    heard = [tuple(cue for cue in cues if cue.symbol != SILENCE) for cues in cells]
    earlier = [tuple(cue for cue in before if cue.symbol != SILENCE), *heard]
    starts = [
        place == 0 or bool(set(cues) - set(earlier[place])) or (not cues and bool(earlier[place]))
        for place, cues in enumerate(heard)
    ]
    edges = [place for place, begins in enumerate(starts) if begins] + [len(heard)]
    formatted = [""] * len(heard)
    for first, last in pairwise(edges):
        new = [cue.symbol for cue in heard[first] if cue not in earlier[first]]
        label = " ".join(new) if new or not heard[first] else "… " + heard[first][-1].symbol
        state = "" if heard[first] else " pause"
        formatted[first] = f'<td class="{kind}{state}" rowspan="{last - first}">{escape(label)}</td>'
    return formatted


def _format_shape(shape: str, before: str, names: ShapeSet) -> str:
    state = ("sealed " if names.is_sealed(shape) else "") + ("" if shape != before else "held")
    drawn = _format_mouth(names.mouths[shape]) if shape in names.mouths else ""
    return f'<td class="shape {state}">{escape(shape)}</td><td class="mouth">{drawn}</td>'


def _format_mouth(mouth: str) -> str:
    return f'<svg><use href="#mouth-{mouth}"/></svg>'


def _format_legend(entries: Mapping[str, str]) -> str:
    """The mouths below, each with the shapes that it is drawn for."""
    if not entries:
        return ""
    across = math.ceil(len(entries) / _legend_rows(entries))
    says = mouth_sayings()
    items = "".join(
        f"<li>{_format_mouth(mouth)}<span><b>{escape(shapes)}</b>{escape(says[mouth])}</span></li>"
        for mouth, shapes in entries.items()
    )
    return f'<footer style="--across: {across}"><ul>{items}</ul></footer>\n'


def _legend_rows(entries: Mapping[str, str]) -> int:
    return math.ceil(len(entries) / LEGEND)


def _legend_of(names: ShapeSet) -> Mapping[str, str]:
    """Shapes by their mouth."""
    entries: dict[str, list[str]] = {}
    for shape, mouth in names.mouths.items():
        entries.setdefault(mouth, []).append(shape)
    return {mouth: " ".join(shapes) for mouth, shapes in entries.items()}
