"""Parke's specification list as text: one line for each way of a parameter from one value to another.

A ``.spec`` file::

    title   A nod
    fps     24                         # frames a second; 24 unless said
    unit    frames                     # or seconds
    length  48                         # optional; else the last line's end
    word    0 12 Hello                 # optional, for plots: start, end, text
    phone   0 3 h

    # parameter    first frame  last frame  first value  last value  change function
    jaw.rotation   0            12          0            8           cosine

A line is a specification unless its first word is one of the six of the heading. Both frames belong to it. Where two
lines cover a frame the later wins; frames that none covers hold the last value, and before the first line a parameter
has its default.

Source: Parke 1974, section 4.1; the last three rules are ours, the thesis has none.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from mien.core import Cue, LoadError, MienError, ParameterTable, RangeError, UnknownNameError

from .change import CHANGE_NAMES
from .layers import Layer
from .rates import exact_rate, time_of
from .timeline import Timeline
from .track import LIMIT, Segment, Track

FILM_FPS = 24.0
"""Frames a second of Parke's film."""

UNITS = ("frames", "seconds")
HEADINGS = ("title", "fps", "unit", "length", "word", "phone")
WANTED = "parameter, first and last frame, first and last value, change function"

_COMMENT = re.compile(r"(^|\s)#.*")


@dataclass(frozen=True)
class Specification:
    """One line: how a parameter goes from one value to another; ``begin`` and ``end`` in the list's unit."""

    parameter: str
    begin: float
    end: float
    first: float
    last: float
    change: str = "linear"
    line: int | None = field(default=None, compare=False)


@dataclass(frozen=True)
class Mark:
    """A word or phone from ``begin`` to ``end``, in the list's unit."""

    begin: float
    end: float
    symbol: str


@dataclass(frozen=True)
class Specifications:
    """A whole list, as written.

    Attributes:
        rows: the specifications, in order.
        fps: frames a second.
        unit: ``frames`` or ``seconds``: what times are counted in.
        length: of the whole, in that unit (frames: their number); None: to the end of the last row, word or phone.
        title: what a person would call it.
        words: the words, in order.
        phones: the phones, in order.
        source: the file's name, for messages.
    """

    rows: tuple[Specification, ...]
    fps: float = FILM_FPS
    unit: str = "frames"
    length: float | None = None
    title: str = ""
    words: tuple[Mark, ...] = ()
    phones: tuple[Mark, ...] = ()
    source: str = field(default="specification list", compare=False)

    @property
    def length_s(self) -> float:
        """Duration, s; the last frame is seen as long as the others."""
        if self.length is not None:
            return self._seconds(self.length)
        whole = 1.0 if self.unit == "frames" else 0.0
        ends = [row.end + whole for row in self.rows] + [mark.end for mark in (*self.words, *self.phones)]
        return self._seconds(max(ends, default=0.0))

    def check(self, table: ParameterTable) -> None:
        """Nothing, when a face with this table can play the list.

        Raises:
            LoadError: a parameter is not in the table or a value is out of its range; names the line.
        """
        for row in self.rows:
            try:
                for name in table.resolve(row.parameter):
                    table[name].check(row.first)
                    table[name].check(row.last)
            except MienError as error:
                raise LoadError(self.source, str(error), line=row.line) from None

    def to_timeline(self, table: ParameterTable | None = None) -> Timeline:
        """The timeline of the list: one layer, ``direct``, that replaces.

        With a table the list is checked against it, and lines that reach the same row by several names (a symmetric
        name, an alias) count as lines of that row; without, each name is a track of its own.

        Raises:
            LoadError: as ``check``.
        """
        if table is not None:
            self.check(table)
        segments: dict[str, list[Segment]] = {}
        for row in self.rows:
            segment = Segment(self._seconds(row.begin), self._seconds(row.end), row.first, row.last, row.change)
            for name in (row.parameter,) if table is None else table.resolve(row.parameter):
                segments.setdefault(name, []).append(segment)
        tracks = {name: Track.from_segments(parts, name=name) for name, parts in segments.items()}
        return Timeline(
            (Layer("direct", "replace", tracks),),
            self.length_s,
            fps=self.fps,
            words=tuple(self._cues(self.words)),
            phones=tuple(self._cues(self.phones)),
            title=self.title,
        )

    def _seconds(self, time: float) -> float:
        return time_of(time, exact_rate(self.fps)) if self.unit == "frames" else time

    def _cues(self, marks: Iterable[Mark]) -> Iterator[Cue]:
        return (Cue(self._seconds(mark.begin), self._seconds(mark.end), mark.symbol) for mark in marks)


def parse_specifications(text: str, source: str = "specification list") -> Specifications:
    """The specification list in a text.

    Raises:
        LoadError: a line cannot be understood; names source, line and reason.
    """
    heading: dict[str, str | float] = {}
    marks: dict[str, list[Mark]] = {"word": [], "phone": []}
    rows: list[Specification] = []
    for number, whole_line in enumerate(text.removeprefix("\ufeff").splitlines(), start=1):
        line = _Line(_COMMENT.sub("", whole_line).strip(), source, number)
        if not line.text:
            continue
        if line.fields[0] in marks:
            marks[line.fields[0]].append(line.mark())
        elif line.fields[0] in HEADINGS:
            if line.fields[0] in heading:
                raise line.error(f"a second {line.fields[0]!r}", "leave one of them out")
            heading[line.fields[0]] = line.heading()
        else:
            rows.append(line.specification())
    if not rows:
        raise LoadError(source, "there is no specification in it", hint=f"a line is: {WANTED}")
    return Specifications(
        tuple(rows),
        fps=float(heading.get("fps", FILM_FPS)),
        unit=str(heading.get("unit", "frames")),
        length=float(heading["length"]) if "length" in heading else None,
        title=str(heading.get("title", "")),
        words=tuple(marks["word"]),
        phones=tuple(marks["phone"]),
        source=source,
    )


def format_specifications(specifications: Specifications) -> str:
    """The text of a list; parsing it gives the same list.

    Raises:
        MienError: a title or symbol that a line of text cannot hold (empty, a line break, ``#`` after a blank).
    """
    lines = [f"title   {_written(specifications.title)}"] if specifications.title else []
    lines += [f"fps     {_number(specifications.fps)}", f"unit    {specifications.unit}"]
    if specifications.length is not None:
        lines.append(f"length  {_number(specifications.length)}")
    for kind, marks in (("word", specifications.words), ("phone", specifications.phones)):
        lines += [f"{kind:<7} {_number(m.begin)} {_number(m.end)} {_written(m.symbol)}" for m in marks]
    header = ("# parameter", "first", "last", "from", "to", "change")
    table = [header] + [
        (row.parameter, *map(_number, (row.begin, row.end, row.first, row.last)), row.change)
        for row in specifications.rows
    ]
    widths = [max(len(row[column]) for row in table) for column in range(5)]
    lines.append("")
    for name, *numbers, change in table:
        columns = [f"{number:>{width}}" for number, width in zip(numbers, widths[1:], strict=True)]
        lines.append("  ".join([f"{name:<{widths[0]}}", *columns, change]))
    return "\n".join(lines) + "\n"


@dataclass(frozen=True)
class _Line:
    """A line without its comment, that knows its place."""

    text: str
    source: str
    number: int

    @property
    def fields(self) -> list[str]:
        return self.text.split()

    def error(self, message: str, hint: str = "") -> LoadError:
        return LoadError(self.source, message, line=self.number, hint=hint)

    def specification(self) -> Specification:
        if len(self.fields) != 6:
            raise self.error(f"want 6 fields ({WANTED}), got {len(self.fields)}: {self.text!r}", self._guess())
        name, begin_text, end_text, first, last, change = self.fields
        if change not in CHANGE_NAMES:
            raise self.error(str(UnknownNameError("change function", change, CHANGE_NAMES)))
        begin, end = self._span(begin_text, end_text)
        return Specification(
            name, begin, end, self._finite(first, "first value"), self._finite(last, "last value"), change, self.number
        )

    def mark(self) -> Mark:
        parts = self.text.split(maxsplit=3)
        if len(parts) != 4:
            raise self.error(f"want '{parts[0]} START END text', got {self.text!r}")
        return Mark(*self._span(parts[1], parts[2]), parts[3])

    def heading(self) -> str | float:
        name = self.fields[0]
        value = self.text.removeprefix(name).strip()
        if not value:
            raise self.error(f"{name!r} says nothing", f"write '{name} VALUE' or leave the line out")
        if name == "unit" and value not in UNITS:
            raise self.error(str(UnknownNameError("unit", value, UNITS)))
        if name in ("fps", "length"):
            number = self._finite(value, name)
            if number <= 0.0:
                raise self.error(f"{name} {value} is not above 0")
            if name == "fps":
                self._check_rate(number)
            return number
        return value

    def _span(self, begin_text: str, end_text: str) -> tuple[float, float]:
        begin, end = self._finite(begin_text, "start"), self._finite(end_text, "end")
        if begin < 0.0:
            raise self.error(f"start {begin_text} is before 0", "times are counted from 0")
        if end < begin:
            raise self.error(f"the end, {end_text}, is before the start, {begin_text}", "exchange them?")
        return begin, end

    def _finite(self, text: str, what: str) -> float:
        try:
            number = float(text)
        except ValueError:
            raise self.error(f"{what} {text!r} is not a number", f"a line is: {WANTED}") from None
        if not math.isfinite(number) or abs(number) > LIMIT:
            raise self.error(f"{what} {text} is not a finite number within ±{LIMIT:g}")
        return number

    def _check_rate(self, fps: float) -> None:
        try:
            exact_rate(fps)
        except RangeError as error:
            raise self.error(str(error)) from None

    def _guess(self) -> str:
        near = str(UnknownNameError("heading", self.fields[0], HEADINGS)).split(" — ")[-1]
        return near if near.startswith("did you mean") else "a field is missing, or there is one too many"


def _number(value: float) -> str:
    return repr(float(value)).removesuffix(".0")


def _written(text: str) -> str:
    line = f"x {text}"
    if not text or _COMMENT.sub("", line) != line or line.splitlines() != [line] or text != text.strip():
        raise MienError(f"{text!r} cannot be written in a specification list — it must be one line without ' #'")
    return text
