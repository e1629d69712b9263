"""Cues as subtitles, SubRip and WebVTT: what is said in sentences, or any tier a cue at a time; and read back."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator, Sequence
from itertools import groupby

from mien.core import Cue, LoadError, MienError
from mien.timeline import Timeline

from .cue_sheet import LINES, WORDS, CueSheet
from .cue_text import Interval, check_intervals
from .subtitles import Subtitle, make_subtitles

_TIMES = re.compile(r"\s*([\d:.,]+)\s+-->\s+([\d:.,]+)(?:\s.*)?")
_CLOCK = re.compile(r"(?:(\d{1,4}):)?(\d{1,2}):(\d{1,2})[.,](\d{3})")
_SRT_TAG = re.compile(r"</?(?:[bius]|font)(?: [^>]*)?>|\{\\[^}]*\}", re.IGNORECASE)
_VTT_TAG = re.compile(r"</?[a-zA-Z0-9][^>]*>")
"""Italics and places on the screen; in WebVTT, voices and the times of words as well."""

_UNSEEN = ("WEBVTT", "NOTE", "STYLE", "REGION")
"""First words of the blocks of a WebVTT file that nobody reads."""


def subtitles_of(sheet: CueSheet, tier: str | None = None) -> Sequence[Subtitle]:
    """Subtitles of a sheet: the cues of the tier asked for; else its lines; else its words, in sentences.

    Raises:
        UnknownNameError: there is no such tier.
        MienError: there is nothing in it.
    """
    if tier is None and LINES not in sheet.tiers:
        timeline = Timeline((), sheet.length_s, words=sheet.tier(WORDS), text=sheet.text)
        subtitles: Sequence[Subtitle] = make_subtitles(timeline)
    else:
        subtitles = [
            Subtitle(cue.start_s, cue.end_s, (" ".join(cue.symbol.split()),)) for cue in sheet.tier(tier or LINES)
        ]
    if not subtitles:
        raise MienError(f"tier {tier or WORDS!r} is empty, so there are no subtitles")
    return subtitles


def parse_subtitles(text: str, source: str) -> CueSheet:
    """What is read in a file of subtitles: the tier ``words`` where all are single words, else ``lines``.

    Raises:
        LoadError: a block has no times, there is no block, or one begins before the one before it ends.
    """
    intervals = list(_read_blocks(text, source))
    if not intervals:
        raise LoadError(source, "there is no subtitle in it", hint="is it cut off?")
    cues = check_intervals(source, intervals)
    tier = WORDS if all(len(cue.symbol.split()) == 1 for cue in cues) else LINES
    return CueSheet(intervals[-1].cue.end_s, {tier: cues}, text=" ".join(cue.symbol for cue in cues))


def _read_blocks(text: str, source: str) -> Iterator[Interval]:
    lines = enumerate(text.split("\n"), start=1)
    marked_up = text.startswith("WEBVTT")
    number = 0
    for blank, block in groupby(lines, key=lambda numbered: not numbered[1].strip()):
        rows = list(block)
        if blank or rows[0][1].split(maxsplit=1)[0] in _UNSEEN:
            continue
        number += 1
        # The times are on the first line, or on the second below a number or name.
        at = next((place for place, (_, row) in enumerate(rows[:2]) if "-->" in row), 0)
        line, row = rows[at]
        match = _TIMES.fullmatch(row)
        if match is None:
            raise LoadError(source, f"subtitle {number}: want '00:00:01,000 --> 00:00:02,000', got {row!r}", line=line)
        start_s, end_s = (_seconds(clock, source, line) for clock in match.groups())
        shown = " ".join(row.strip() for _, row in rows[at + 1 :])
        shown = html.unescape(_VTT_TAG.sub("", shown)) if marked_up else _SRT_TAG.sub("", shown)
        yield Interval(f"subtitle {number}", line, Cue(start_s, end_s, shown))


def _seconds(clock: str, source: str, line: int) -> float:
    match = _CLOCK.fullmatch(clock)
    if match is None:
        raise LoadError(source, f"want a time such as 00:00:01,000, got {clock!r}", line=line)
    hours, minutes, seconds, thousandths = (int(part or 0) for part in match.groups())
    return (((hours * 60 + minutes) * 60 + seconds) * 1000 + thousandths) / 1000
