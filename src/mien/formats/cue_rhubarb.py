"""Mouth shapes as Rhubarb Lip Sync 1.13 writes them, to the byte: TSV, XML and JSON in hundredths of a second.

Source: the files that its Linux program writes, and its manual, section "Output formats".
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from html import escape
from itertools import pairwise

from mien.core import Cue, LoadError
from mien.timeline.json_reader import Node

from .cue_shapes import ShapeSet, find_set
from .cue_sheet import SHAPES, CueSheet, fill_gaps, place_of
from .cue_text import Interval, check_intervals, parse_number
from .cue_tsv import check_plain


def format_rhubarb_tsv(sheet: CueSheet, tier: str = SHAPES) -> Iterator[str]:
    """Lines of a time and the shape that begins there; the last is the end, with the mouth at rest."""
    for number, cue in enumerate(find_steps(sheet, tier), start=1):
        yield f"{cue.start_s:.2f}\t{check_plain(cue.symbol, place_of(tier, number))}\n"
    yield f"{sheet.length_s:.2f}\t{set_of(sheet, tier).rest}\n"


def format_rhubarb_xml(sheet: CueSheet, tier: str = SHAPES) -> Iterator[str]:
    """Lines of the document."""
    yield '<?xml version="1.0" encoding="utf-8"?>\n<rhubarbResult>\n  <metadata>\n'
    yield f"    <soundFile>{_escape(sheet.sound)}</soundFile>\n    <duration>{sheet.length_s:.2f}</duration>\n"
    yield "  </metadata>\n  <mouthCues>\n"
    for cue in find_steps(sheet, tier):
        shape = _escape(cue.symbol)
        yield f'    <mouthCue start="{cue.start_s:.2f}" end="{cue.end_s:.2f}">{shape}</mouthCue>\n'
    yield "  </mouthCues>\n</rhubarbResult>\n"


def format_rhubarb_json(sheet: CueSheet, tier: str = SHAPES) -> Iterator[str]:
    """Lines of the document."""
    yield f'{{\n  "metadata": {{\n    "soundFile": {json.dumps(sheet.sound)},\n    "duration": {sheet.length_s:.2f}\n'
    yield '  },\n  "mouthCues": ['
    for number, cue in enumerate(find_steps(sheet, tier)):
        span = f'"start": {cue.start_s:.2f}, "end": {cue.end_s:.2f}'
        yield f'{"," if number else ""}\n    {{ {span}, "value": {json.dumps(cue.symbol)} }}'
    yield "\n  ]\n}\n"


def set_of(sheet: CueSheet, tier: str) -> ShapeSet:
    """Whose names the shapes of a tier have."""
    return find_set(cue.symbol for cue in sheet.tier(tier))


def find_steps(sheet: CueSheet, tier: str) -> Iterator[Cue]:
    """Shapes from 0 to the end without holes, each another than the one before, in whole hundredths of a second.

    What lasts less than half a hundredth has no place in such a file.
    """
    cues = fill_gaps(sheet.tier(tier), sheet.length_s, set_of(sheet, tier).rest)
    edges = [(round(100 * cue.start_s), cue.symbol) for cue in cues]
    end = round(100 * sheet.length_s)
    lasting = [(start, symbol) for (start, symbol), (stop, _) in pairwise([*edges, (end, "")]) if stop > start]
    changes = [step for before, step in pairwise([(0, ""), *lasting]) if step[1] != before[1]]
    for (start, symbol), (stop, _) in pairwise([*changes, (end, "")]):
        yield Cue(start / 100, stop / 100, symbol)


def parse_rhubarb_tsv(text: str, source: str) -> CueSheet:
    """The shapes of lines with a time and a name; the last line is the end.

    Raises:
        LoadError: a line is something else, or times do not rise.
    """
    steps: list[tuple[int, float, str]] = []
    for line, cells in enumerate((row.split("\t") for row in text.split("\n")), start=1):
        if cells == [""]:
            continue
        if len(cells) != 2:
            raise LoadError(source, f"want a time, a tab and a shape, got {len(cells)} cells", line=line)
        steps.append((line, parse_number(source, cells[0], f"shape {len(steps) + 1}", line), cells[1]))
    return sheet_of_steps(source, steps)


def sheet_of_steps(source: str, steps: Sequence[tuple[int, float, str]]) -> CueSheet:
    """The shapes of lines that tell where each begins: number of the line, time in seconds, symbol; the last ends all.

    Raises:
        LoadError: there is no end, or times do not rise.
    """
    if len(steps) < 2:
        raise LoadError(source, "has no end: want at least two shapes", hint="is it cut off?")
    intervals = (
        Interval(place_of(SHAPES, number), line, Cue(start_s, end_s, symbol))
        for number, ((line, start_s, symbol), (_, end_s, _)) in enumerate(pairwise(steps), start=1)
    )
    return CueSheet(steps[-1][1], {SHAPES: check_intervals(source, intervals)})


def parse_rhubarb_xml(text: str, source: str) -> CueSheet:
    """The shapes of a document.

    Raises:
        LoadError: it is no XML, something is missing, or times do not rise.
    """
    from xml.etree import ElementTree

    if "<!" in text.replace("<!--", ""):  # nothing that Rhubarb writes, and a way to make a small file endless
        raise LoadError(source, "declares a document type or data, which is not for mouth cues")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise LoadError(source, f"is not XML: {error.msg}", line=error.position[0], hint="is it cut off?") from None
    duration, cues = root.findtext("metadata/duration"), root.find("mouthCues")
    if root.tag != "rhubarbResult" or duration is None or cues is None:
        raise LoadError(source, "want a rhubarbResult with metadata/duration and mouthCues", line=1)
    intervals = []
    for number, cue in enumerate(cues, start=1):
        start_s, end_s = (
            parse_number(source, cue.get(end, ""), f"mouthCue {number}, {end}") for end in ("start", "end")
        )
        intervals.append(Interval(place_of(SHAPES, number), None, Cue(start_s, end_s, cue.text or "")))
    return _make_sheet(
        source, intervals, parse_number(source, duration, "duration"), root.findtext("metadata/soundFile")
    )


def read_rhubarb_json(document: Node) -> CueSheet:
    """The shapes of a document.

    Raises:
        LoadError: something in it is missing, unknown or out of order.
    """
    members = document.members(("metadata", "mouthCues"))
    metadata = members["metadata"].members(("soundFile", "duration"))
    intervals = []
    for number, item in enumerate(members["mouthCues"].items(), start=1):
        cue = item.members(("start", "end", "value"))
        times = cue["start"].number(), cue["end"].number()
        intervals.append(Interval(place_of(SHAPES, number), None, Cue(*times, cue["value"].text())))
    return _make_sheet(document.source, intervals, metadata["duration"].number(), metadata["soundFile"].text())


def _make_sheet(source: str, intervals: Iterable[Interval], duration_s: float, sound: str | None) -> CueSheet:
    return CueSheet(duration_s, {SHAPES: check_intervals(source, intervals, duration_s)}, sound or "")


def _escape(text: str) -> str:
    return escape(text, quote=False).replace("'", "&apos;").replace('"', "&quot;")
