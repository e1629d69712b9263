"""Files of cues: one module a format, listed in one table; the suffix and the layout decide."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from types import MappingProxyType

from mien.core import LoadError, MienError, UnknownNameError
from mien.timeline import Rate
from mien.timeline.json_form import FORMAT as TIMELINE
from mien.timeline.json_form import from_json
from mien.timeline.json_reader import parse_json

from .atomic import check_file, writing
from .cue_chart import format_chart
from .cue_dat import format_dat, format_rhubarb_dat, parse_dat
from .cue_json import format_json, read_json
from .cue_page import format_page
from .cue_rhubarb import (
    format_rhubarb_json,
    format_rhubarb_tsv,
    format_rhubarb_xml,
    parse_rhubarb_tsv,
    parse_rhubarb_xml,
    read_rhubarb_json,
)
from .cue_sheet import SHAPES, CueSheet, sheet_of
from .cue_subtitles import parse_subtitles, subtitles_of
from .cue_text import read_text
from .cue_textgrid import format_textgrid, parse_textgrid
from .cue_tsv import COLUMNS, format_tsv, parse_tsv
from .rates import DEFAULT_FPS, check_rate
from .subtitle_files import format_srt, format_vtt
from .table import find_format

LAYOUTS = ("mien", "rhubarb")
"""Whose file of a suffix is written: ours, or what Rhubarb Lip Sync 1.13 writes."""


@dataclass(frozen=True)
class Wanted:
    """What a writer is asked for, beside the sheet.

    Attributes:
        rate: frames a second, of files that count frames.
        tier: the one to write where there is room for one; None is the usual one of the format.
    """

    rate: Fraction
    tier: str | None = None


Writer = Callable[[CueSheet, Wanted], Iterable[str]]
Reader = Callable[[str, str, Fraction], CueSheet]
"""Takes the text, the file's name for messages, and frames a second."""


WRITERS: Mapping[tuple[str, str], Writer] = MappingProxyType(
    {
        (".textgrid", "mien"): lambda sheet, _: format_textgrid(sheet),
        (".json", "mien"): lambda sheet, _: format_json(sheet),
        (".json", "rhubarb"): lambda sheet, wanted: format_rhubarb_json(sheet, wanted.tier or SHAPES),
        (".tsv", "mien"): lambda sheet, _: format_tsv(sheet),
        (".tsv", "rhubarb"): lambda sheet, wanted: format_rhubarb_tsv(sheet, wanted.tier or SHAPES),
        (".xml", "rhubarb"): lambda sheet, wanted: format_rhubarb_xml(sheet, wanted.tier or SHAPES),
        (".srt", "mien"): lambda sheet, wanted: format_srt(subtitles_of(sheet, wanted.tier)),
        (".vtt", "mien"): lambda sheet, wanted: format_vtt(subtitles_of(sheet, wanted.tier)),
        (".dat", "mien"): lambda sheet, wanted: format_dat(sheet, wanted.rate, wanted.tier or SHAPES),
        (".dat", "rhubarb"): lambda sheet, wanted: format_rhubarb_dat(sheet, wanted.rate, wanted.tier or SHAPES),
        (".csv", "mien"): lambda sheet, wanted: format_chart(sheet, wanted.rate, wanted.tier or SHAPES),
        (".html", "mien"): lambda sheet, wanted: format_page(sheet, wanted.rate, wanted.tier or SHAPES),
    }
)
"""By suffix and layout."""

READERS: Mapping[str, Reader] = MappingProxyType(
    {
        ".textgrid": lambda text, source, _: parse_textgrid(text, source),
        ".json": lambda text, source, _: _parse_json(text, source),
        ".tsv": lambda text, source, _: _parse_tsv(text, source),
        ".xml": lambda text, source, _: parse_rhubarb_xml(text, source),
        ".srt": lambda text, source, _: parse_subtitles(text, source),
        ".vtt": lambda text, source, _: parse_subtitles(text, source),
        ".dat": parse_dat,
    }
)
"""By suffix; where there are two layouts, the reader sees which it has before it."""


def write_cue_file(
    sheet: CueSheet, path: Path | str, *, layout: str = "mien", fps: Rate = DEFAULT_FPS, tier: str | None = None
) -> None:
    """Writes words, phones and shapes with their times; the suffix decides.

    Args:
        sheet: what to write.
        path: ``.TextGrid``, ``.json`` and ``.tsv`` hold every tier; Rhubarb's files and ``.dat`` one, the shapes;
            ``.srt`` and ``.vtt`` the words, as sentences; ``.csv`` and ``.html`` are exposure sheets, a row a frame.
        layout: ``mien``, or ``rhubarb``: what Rhubarb Lip Sync writes, for programs that read its files.
        fps: frames a second of what counts frames.
        tier: the one to write where there is room for one only; of subtitles, a cue each.

    Raises:
        MienError: suffix, layout, rate or tier are not there, or the place cannot be written; nothing has changed then.
    """
    path = Path(path)
    write = WRITERS[_check(path, layout)]
    if tier is not None:
        sheet.tier(tier)
    pieces = write(sheet, Wanted(check_rate(fps), tier))
    with writing(path) as temporary, temporary.open("w", encoding="utf-8", errors="replace", newline="\n") as file:
        file.writelines(pieces)


def read_cue_file(path: Path | str, *, fps: Rate = DEFAULT_FPS) -> CueSheet:
    """Words, phones and shapes of a file that ``write_cue_file`` or another program wrote; the suffix decides.

    Args:
        path: any but an exposure sheet; of a ``.json`` timeline, as ``mien say`` writes, its words and phones.
        fps: frames a second that a ``.dat`` file counts in.

    Raises:
        LoadError: the file cannot be read, is cut off or not in order; names the line or the interval.
        UnknownNameError: files with cues have no such suffix.
    """
    path = Path(path)
    find_format(path, "timing")
    rate = check_rate(fps)
    text = read_text(path)
    try:
        return READERS[path.suffix.lower()](text, str(path), rate)
    except LoadError:
        raise
    except MienError as error:
        raise LoadError(path, str(error)) from None


def check_cue_file(path: Path | str, layout: str = "mien") -> None:
    """Makes sure that cues could be written there.

    Raises:
        MienError: suffix or layout are not there, or the place cannot be written.
    """
    _check(Path(path), layout)
    check_file(path)


def _check(path: Path, layout: str) -> tuple[str, str]:
    """The key of the table of writers."""
    find_format(path, "cues")
    if layout not in LAYOUTS:
        raise UnknownNameError("layout", layout, LAYOUTS)
    suffix = path.suffix.lower()
    there = [each for each in LAYOUTS if (suffix, each) in WRITERS]
    if layout in there:
        return suffix, layout
    if layout == LAYOUTS[0]:  # what nobody asked for need not be refused
        return suffix, there[0]
    others = ", ".join(suffix for suffix, each in WRITERS if each == layout)
    raise MienError(f"{path}: there is no layout {layout!r} of such a file — it writes {others}")


def _parse_json(text: str, source: str) -> CueSheet:
    """The sheet of a document of ours, of Rhubarb's, or of a timeline, which has words and phones too."""
    document = parse_json(text, source)
    keys = document.value if isinstance(document.value, dict) else {}
    if "mouthCues" in keys:
        return read_rhubarb_json(document)
    if keys.get("format") == TIMELINE:
        return sheet_of(from_json(document.value, source).timeline)
    return read_json(document)


def _parse_tsv(text: str, source: str) -> CueSheet:
    ours = text.split("\n", 1)[0].split("\t") == list(COLUMNS)
    return parse_tsv(text, source) if ours else parse_rhubarb_tsv(text, source)
