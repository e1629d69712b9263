"""Praat's TextGrid: written in its long form, read in the long and the short one.

Source: Boersma and Weenink, Praat, manual pages "TextGrid file formats" and "Text files".
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from mien.core import Cue, LoadError

from .cue_sheet import LONGEST_S, CueSheet, fill_gaps, place_of
from .cue_text import Interval, check_intervals

_POINT_TIERS = ("TextTier", "PointTier")

_TOKEN = re.compile(
    r"(?<!\S)(?:"
    r'(?P<text>"[^"]*(?:""[^"]*)*")|(?P<open>")|(?P<flag><\w+>)|(?P<comment>!.*)|'
    r"(?P<number>(?:[-+]?\.?\d\S*|nan|inf|--undefined--)(?!\S)))"
)
"""What counts of what stands free between blanks: texts, flags and numbers. All else is there for people."""

_NUMBER = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)[a-zA-Z]*")
"""A number, with a unit if it has one."""


def format_textgrid(sheet: CueSheet) -> Iterator[str]:
    """Lines of the long form: every tier an interval tier from 0 to the end, gaps as intervals without a text."""
    length = _number(sheet.length_s)
    yield 'File type = "ooTextFile"\nObject class = "TextGrid"\n\n'
    yield f"xmin = 0 \nxmax = {length} \ntiers? <exists> \nsize = {len(sheet.tiers)} \nitem []: \n"
    for number, (name, cues) in enumerate(sheet.tiers.items(), start=1):
        filled = list(fill_gaps(cues, sheet.length_s))
        yield f'    item [{number}]:\n        class = "IntervalTier" \n        name = {_quote(name)} \n'
        yield f"        xmin = 0 \n        xmax = {length} \n        intervals: size = {len(filled)} \n"
        for place, cue in enumerate(filled, start=1):
            # The last one ends where the tier does: Praat opens nothing else.
            end = length if place == len(filled) else _number(cue.end_s)
            yield f"        intervals [{place}]:\n            xmin = {_number(cue.start_s)} \n"
            yield f"            xmax = {end} \n            text = {_quote(cue.symbol)} \n"


def parse_textgrid(text: str, source: str) -> CueSheet:
    """The interval tiers of a TextGrid; intervals without a text are gaps, tiers of points are left out.

    The second of two tiers with one name becomes ``name (2)``.

    Raises:
        LoadError: it is no TextGrid, is cut off, declares other sizes than it has, or its intervals are not in order.
    """
    tokens = _Tokens(text, source)
    _read_head(tokens)
    start_s, length_s = tokens.number("xmin"), tokens.number("xmax")
    if not (0.0 <= start_s < length_s <= LONGEST_S):
        raise tokens.error(f"goes from {start_s:g} to {length_s:g} s, which is no span of time from 0 on")
    if tokens.take("flag", "tiers?").text != "<exists>":
        raise tokens.error("has no tiers")
    count = tokens.count("size")
    tiers: dict[str, tuple[Cue, ...]] = {}
    for number in range(1, count + 1):
        if tokens.next is None:
            raise tokens.error(f"its size is {count}, but the tiers end after {number - 1}", "is it cut off?")
        kind, name = tokens.text(f"class of tier {number}"), tokens.text(f"name of tier {number}")
        if kind == "IntervalTier":
            tiers[_free_name(name, tiers)] = _read_intervals(tokens, name, length_s)
        elif kind in _POINT_TIERS:
            _skip_points(tokens, name)
        else:
            raise tokens.error(f"tier {number} is a {kind!r}, want an 'IntervalTier'")
    if tokens.next is not None:
        raise tokens.error(f"its size is {count}, but more tiers follow")
    if not tiers:
        raise tokens.error("has no tier of intervals")
    return CueSheet(length_s, tiers)


def _quote(text: str) -> str:
    doubled = text.replace('"', '""')
    return f'"{doubled}"'


def _number(value: float) -> str:
    """The shortest text that reads back as the same number."""
    return repr(float(value)).removesuffix(".0")


def _free_name(name: str, taken: dict[str, tuple[Cue, ...]]) -> str:
    names = (name if number == 1 else f"{name} ({number})" for number in range(1, len(taken) + 2))
    return next(each for each in names if each not in taken)


@dataclass(frozen=True)
class _Token:
    kind: str
    text: str
    line: int


class _Tokens:
    """What counts in the file, one after another; ``next`` is None behind the last."""

    def __init__(self, text: str, source: str) -> None:
        self._text, self.source = text, source
        self._place, self._counted, self._line = 0, 0, 1
        self.last_line = 1
        self.next = self._find()

    def take(self, kind: str, what: str) -> _Token:
        """The next one, which must be a ``text``, ``number`` or ``flag``."""
        token = self.next
        if token is None:
            raise self.error(f"ends where {what} should be", "is it cut off?")
        self.last_line = token.line
        if token.kind != kind:
            raise self.error(f"{what}: want a {kind}, got {token.text}")
        self.next = self._find()
        return token

    def text(self, what: str) -> str:
        """A text without its quotes."""
        return self.take("text", what).text[1:-1].replace('""', '"')

    def number(self, what: str) -> float:
        """A finite number."""
        token = self.take("number", what)
        match = _NUMBER.fullmatch(token.text)
        if match is None:
            raise self.error(f"{what}: want a number, got {token.text}")
        return float(match[1])

    def count(self, what: str) -> int:
        """A whole number, 0 or more."""
        number = self.number(what)
        if not (number >= 0.0 and number.is_integer()):
            raise self.error(f"{what}: want a whole number, got {number:g}")
        return int(number)

    def error(self, message: str, hint: str = "") -> LoadError:
        """A complaint about what was taken last."""
        return LoadError(self.source, message, line=self.last_line, hint=hint)

    def _find(self) -> _Token | None:
        while match := _TOKEN.search(self._text, self._place):
            self._line += self._text.count("\n", self._counted, match.start())
            self._counted, self._place = match.start(), match.end()
            token = _Token(match.lastgroup or "", match[0], self._line)
            if token.kind == "open":
                self.last_line = token.line
                raise self.error("a text begins here and is never closed", "is it cut off?")
            if token.kind != "comment":
                return token
        return None


def _read_head(tokens: _Tokens) -> None:
    if tokens.next is None or tokens.next.kind != "text":
        raise tokens.error("is no TextGrid", "in Praat: Save as text file")
    kind = tokens.text("file type")
    held = tokens.text("object class") if kind.startswith("ooTextFile") else kind
    if held != "TextGrid":
        raise tokens.error(f"holds {held!r}, want a TextGrid", "in Praat: Save as text file")


def _read_intervals(tokens: _Tokens, name: str, length_s: float) -> tuple[Cue, ...]:
    count = _read_size(tokens, name)
    return check_intervals(tokens.source, _intervals(tokens, name, count), length_s)


def _read_size(tokens: _Tokens, name: str) -> int:
    """How many intervals or points a tier declares; its own ends tell nothing that they do not."""
    for what in ("xmin", "xmax"):
        tokens.number(f"{what} of tier {name!r}")
    return tokens.count(f"size of tier {name!r}")


def _intervals(tokens: _Tokens, name: str, count: int) -> Iterator[Interval]:
    for number in range(1, count + 1):
        if tokens.next is None or tokens.next.kind != "number":
            raise tokens.error(
                f"tier {name!r}: its size is {count}, but the intervals end after {number - 1}", "is it cut off?"
            )
        line, place = tokens.next.line, place_of(name, number)
        start_s, end_s = tokens.number(f"{place}: xmin"), tokens.number(f"{place}: xmax")
        yield Interval(place, line, Cue(start_s, end_s, tokens.text(f"{place}: text")))
    _check_over(tokens, name, count)


def _skip_points(tokens: _Tokens, name: str) -> None:
    count = _read_size(tokens, name)
    for number in range(1, count + 1):
        tokens.number(f"tier {name!r}, point {number}: time")
        tokens.text(f"tier {name!r}, point {number}: text")
    _check_over(tokens, name, count)


def _check_over(tokens: _Tokens, name: str, count: int) -> None:
    if tokens.next is not None and tokens.next.kind == "number":
        raise tokens.error(f"tier {name!r}: its size is {count}, but more follow")
