"""The text of a file of cues, whatever it is encoded as, and its intervals, checked where they stand."""

from __future__ import annotations

import codecs
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from mien.core import Cue, LoadError

from .cue_sheet import LONGEST_S, find_fault

_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
"""Byte order marks and what they tell."""


@dataclass(frozen=True)
class Interval:
    """A cue as it stands in a file; its symbol may be blank.

    Attributes:
        place: for messages, such as ``tier 'phones', interval 12``.
        line: where it begins, if there are lines.
        cue: what it says.
    """

    place: str
    line: int | None
    cue: Cue


def read_text(path: Path) -> str:
    """The text of a file in UTF-8 or UTF-16, with or without a byte order mark; lines end in a newline alone.

    Raises:
        LoadError: it cannot be read, is empty or is no such text.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise LoadError(path, f"cannot be read ({error.strerror})") from error
    if not data.strip():
        raise LoadError(path, "is empty")
    encoding = _find_encoding(data)
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError as error:
        raise LoadError(
            path, f"is no {encoding.upper()} text (byte {error.start})", hint="save it as text in UTF-8"
        ) from None
    return text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")


def _find_encoding(data: bytes) -> str:
    for mark, encoding in _MARKS:
        if data.startswith(mark):
            return encoding
    # Files of cues begin with a plain character, of which one byte is nothing where a character is two.
    if data[1:2] == b"\0":
        return "utf-16-le"
    return "utf-16-be" if data[:1] == b"\0" else "utf-8"


def check_intervals(source: str, intervals: Iterable[Interval], length_s: float = LONGEST_S) -> tuple[Cue, ...]:
    """The cues of a tier, in order; blank ones are gaps and left out.

    Raises:
        LoadError: one is turned round, overlaps the one before it or lies outside the recording; names its place.
    """
    cues: list[Cue] = []
    end_s = 0.0
    for interval in intervals:
        cue = interval.cue
        if wrong := find_fault(cue, end_s, length_s):
            raise LoadError(source, f"{interval.place}: {wrong}", line=interval.line)
        end_s = cue.end_s
        if cue.symbol.strip():
            cues.append(Cue(cue.start_s, cue.end_s, cue.symbol.strip()))
    return tuple(cues)


def parse_number(source: str, text: str, what: str, line: int | None = None) -> float:
    """The number that a text is.

    Raises:
        LoadError: it is none.
    """
    try:
        return float(text)
    except ValueError:
        raise LoadError(source, f"{what}: want a number, got {text!r}", line=line) from None
