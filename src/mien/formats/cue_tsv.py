"""Cues as a table of our own, separated by tabs: ``tier``, ``start_s``, ``end_s``, ``symbol``, a row a cue."""

from __future__ import annotations

from collections.abc import Iterator

from mien.core import Cue, LoadError, MienError

from .cue_sheet import CueSheet, place_of
from .cue_text import Interval, check_intervals, parse_number

COLUMNS = ("tier", "start_s", "end_s", "symbol")


def format_tsv(sheet: CueSheet) -> Iterator[str]:
    """Rows of the table, tier after tier; one without a symbol where the recording goes on after a tier's last cue.

    Raises:
        MienError: a name or symbol holds a tab or a line break.
    """
    yield "\t".join(COLUMNS) + "\n"
    for name, cues in sheet.tiers.items():
        check_plain(name, "name of a tier")
        for number, cue in enumerate(cues, start=1):
            yield f"{name}\t{cue.start_s!r}\t{cue.end_s!r}\t{check_plain(cue.symbol, place_of(name, number))}\n"
        end_s = cues[-1].end_s if cues else 0.0
        if end_s < sheet.length_s:
            yield f"{name}\t{end_s!r}\t{sheet.length_s!r}\t\n"


def parse_tsv(text: str, source: str) -> CueSheet:
    """The tiers of a table; the last end is that of the recording.

    Raises:
        LoadError: a row has other columns, a time is no number, or the cues of a tier are not in order.
    """
    rows: dict[str, list[Interval]] = {}
    for line, cells in enumerate((row.split("\t") for row in text.split("\n")), start=1):
        if line == 1 or cells == [""]:
            continue
        if len(cells) != len(COLUMNS):
            raise LoadError(source, f"want {len(COLUMNS)} cells between tabs, got {len(cells)}", line=line)
        tier, start, end, symbol = cells
        intervals = rows.setdefault(tier, [])
        place = place_of(tier, len(intervals) + 1)
        start_s, end_s = (parse_number(source, each, place, line) for each in (start, end))
        intervals.append(Interval(place, line, Cue(start_s, end_s, symbol)))
    if not rows:
        raise LoadError(source, "there is no cue in it", hint="is it cut off?")
    tiers = {name: check_intervals(source, intervals) for name, intervals in rows.items()}
    return CueSheet(max(intervals[-1].cue.end_s for intervals in rows.values()), tiers)


def check_plain(text: str, place: str) -> str:
    """The text, which a table separated by tabs can hold.

    Raises:
        MienError: it cannot.
    """
    if set(text) & set("\t\n\r"):
        raise MienError(f"{place}: {text!r} holds a tab or a line break, which has no place here — write .json")
    return text
