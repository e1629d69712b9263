"""A marked text taken apart."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType

from mien.core import MienError, RangeError, UnknownNameError
from mien.gaze import look_directions
from mien.vocab.facs import parse_units

from .marks import Act, Break, Emphasis, Expression, Look, Mark, MarkedText, Units

LEVELS: Mapping[str, float] = MappingProxyType({"strong": 1.0, "moderate": 0.7})
"""How much an emphasis is worth. Source: names of SSML 1.1, section 3.2.2; the amounts are ours."""

ATTRIBUTES: Mapping[str, tuple[str, ...]] = MappingProxyType({"break": ("time",), "emphasis": ("level",)})
"""What may stand in a tag. Source: SSML 1.1, sections 3.2.2 and 3.2.3."""

USUAL_BREAK_S = 0.5
LONGEST_BREAK_S = 60.0

_TOKEN = re.compile(
    r"\\(?P<escaped>[\[\]<>*\\])"
    r"|\[\s*(?P<mark>[^\W\d_][^\[\]\n]*)\]"
    r"|<(?P<closing>/?)\s*(?P<tag>[^\W\d_][\w:-]*)(?P<rest>(?:[^<>\n\"']|\"[^\"\n]*\"|'[^'\n]*')*)>"
    r"|(?P<unclosed>\[(?=\s*[^\W\d_])|<(?=/?[^\W\d_]))"
    r"|(?P<stars>\*+)"
)
_STARRED = re.compile(r"(?<!\w)(\*{1,3})(?=[\w\[<])(?:\\.|[^*\n\\])*(?<=\S)\1(?![\w*])")
_ATTRIBUTE = re.compile(r"\s*(?P<name>[\w:-]+)\s*=\s*(?P<quote>[\"'])(?P<value>[^\"']*)(?P=quote)")
_TIME = re.compile(r"\+?(?P<number>\d+\.?\d*|\.\d+)(?P<unit>ms|s)")
_LEANING = tuple(".,;:!?…")


def parse_marks(text: str) -> MarkedText:
    """The plain text and the marks of a marked one.

    Raises:
        MienError: a mark is not closed, was never opened, or cannot be understood; names line and column.
        UnknownNameError: there is no such tag, attribute, level or direction.
        RangeError: an amount is not in 0..1, or a break is longer than ``LONGEST_BREAK_S``.
    """
    reader = _Reader(text)
    last = 0
    for token in _TOKEN.finditer(text):
        reader.add_words(text[last : token.start()])
        reader.take(token)
        last = token.end()
    reader.add_words(text[last:])
    return reader.finish()


@dataclass(frozen=True)
class _Opened:
    """An emphasis that is not closed yet: where it was written, and the place of its first word."""

    sign: str
    offset: int
    place: int
    strength: float


@dataclass
class _Reader:
    """Plain text and marks as far as a text has been read."""

    source: str
    parts: list[str] = field(default_factory=list)  # of the plain text, none empty
    length: int = 0
    marks: list[tuple[int, Mark]] = field(default_factory=list)  # with the place in ``source``
    opened: list[_Opened] = field(default_factory=list)
    behind_mark: bool = False

    def add_words(self, text: str) -> None:
        """Adds what is no mark; of the blanks before and behind a mark one side is left."""
        if not text:
            return
        if self.behind_mark:
            last = self.parts[-1][-1] if self.parts else "\n"
            if last == "\n":
                text = text.lstrip()
            elif last.isspace():
                text = text.lstrip(" \t")
            if text.startswith(_LEANING) and self.parts:
                self._append(self._pop().rstrip(" \t"))
            self.behind_mark = not text
        self._append(text)

    def _append(self, text: str) -> None:
        if text:
            self.parts.append(text)
            self.length += len(text)

    def _pop(self) -> str:
        last = self.parts.pop()
        self.length -= len(last)
        return last

    def take(self, token: re.Match[str]) -> None:
        """Takes the next escape, mark, tag or star."""
        offset = token.start()
        if token["escaped"]:
            self.add_words(token["escaped"])
        elif token["stars"]:
            self._take_stars(token["stars"], offset)
        elif token["unclosed"]:
            sign, end = token["unclosed"], "]" if token["unclosed"] == "[" else ">"
            raise MienError(
                f"{self._where(offset)}: {sign!r} begins a mark that no {end!r} in its line ends — "
                f"close it, or write \\{sign} for the sign itself"
            )
        elif token["mark"]:
            self._add(_parse_act(token["mark"], self._where(offset)), offset, self.length)
        else:
            self._take_tag(token["closing"] + token["tag"], token["rest"], offset)

    def _take_stars(self, stars: str, offset: int) -> None:
        if any(opened.sign == stars for opened in self.opened):
            self._close(stars, offset)
        elif _STARRED.match(self.source, offset):
            self.opened.append(_Opened(stars, offset, self.length, 1.0))
        else:
            self.add_words(stars)

    def _take_tag(self, tag: str, rest: str, offset: int) -> None:
        where = self._where(offset)
        if tag.lstrip("/") not in ATTRIBUTES:
            raise UnknownNameError(f"tag in {where}:", tag, ATTRIBUTES)
        attributes = _parse_attributes(tag, rest.rstrip().removesuffix("/"), where)
        if tag == "break":
            self._add(Break(_parse_time(attributes.get("time"), where)), offset, self.length)
        elif tag == "emphasis":
            level = attributes.get("level", "strong")
            if level not in LEVELS:
                raise UnknownNameError(f"level of <emphasis> in {where}:", level, LEVELS)
            self.opened.append(_Opened(tag, offset, self.length, LEVELS[level]))
            self.behind_mark = True
        else:
            self._close(tag[1:], offset)

    def _close(self, sign: str, offset: int) -> None:
        opened = next((opened for opened in reversed(self.opened) if opened.sign == sign), None)
        if opened is None:
            raise MienError(f"{self._where(offset)}: </{sign}> ends what was not begun — leave it out")
        self.opened.remove(opened)
        self._add(Emphasis(self.length, opened.strength), opened.offset, opened.place)

    def _add(self, act: Act, offset: int, place: int) -> None:
        self.marks.append((offset, Mark(act, place, *self._line_and_column(offset))))
        self.behind_mark = True

    def _where(self, offset: int) -> str:
        line, column = self._line_and_column(offset)
        return f"line {line}, column {column}"

    def _line_and_column(self, offset: int) -> tuple[int, int]:
        line = bisect_right(self.lines, offset)
        return line, offset - self.lines[line - 1] + 1

    @cached_property
    def lines(self) -> list[int]:
        """Where each line begins."""
        return [0, *(match.end() for match in re.finditer("\n", self.source))]

    def finish(self) -> MarkedText:
        """What was read."""
        if self.opened:
            place = self._where(self.opened[-1].offset)
            raise MienError(f"{place}: the emphasis is not ended — add </emphasis>")
        return MarkedText("".join(self.parts), tuple(mark for _, mark in sorted(self.marks, key=lambda pair: pair[0])))


def _parse_act(text: str, where: str) -> Act:
    """What stands in square brackets: a word, and how much of it."""
    name, *rest = re.split(r"[\s=]+", text.strip(), maxsplit=1)
    if name == "au":
        if not rest:
            raise MienError(f"{where}: [{text}] names no action unit — want for example [au 1=0.5,2=0.5]")
        try:
            units = parse_units(rest[0], f"{where}, [{text}]")
        except UnknownNameError as error:
            raise MienError(f"{where}, [{text}]: {error}") from None
        for unit, amount in units.items():
            _check_amount(amount, f"{where}, [{text}]: {unit}")
        return Units(units)
    if name != "look":
        return Expression(name, _parse_amount(rest, text, where))
    direction, *share = rest[0].split(maxsplit=1) if rest else [""]
    if direction not in look_directions():
        raise UnknownNameError(f"direction in {where}, [{text}]:", direction, look_directions())
    return Look(direction, _parse_amount(share, text, where))


def _parse_amount(rest: list[str], text: str, where: str) -> float:
    try:
        return _check_amount(float(rest[0]) if rest else 1.0, f"{where}, [{text}]")
    except ValueError:
        raise MienError(
            f"{where}: [{text}] is no mark — want a name and 0..1 of it, as in [smile 0.6]; "
            "a bracket of the text itself is written \\["
        ) from None


def _check_amount(amount: float, place: str) -> float:
    if not 0.0 <= amount <= 1.0:
        raise RangeError(f"{place}: {amount:g} is out of range — it goes from 0 to 1")
    return amount


def _parse_attributes(tag: str, rest: str, where: str) -> dict[str, str]:
    found: dict[str, str] = {}
    while match := _ATTRIBUTE.match(rest):
        if match["name"] not in ATTRIBUTES.get(tag, ()):
            raise UnknownNameError(f"attribute of <{tag}> in {where}:", match["name"], ATTRIBUTES.get(tag, ()))
        found[match["name"]] = match["value"]
        rest = rest[match.end() :]
    if rest.strip():
        raise MienError(f'{where}: {rest.strip()!r} in <{tag}> is no attribute — want one like time="500ms"')
    return found


def _parse_time(text: str | None, where: str) -> float:
    """Seconds, from ``500ms`` or ``0.5s``. Source: CSS2, section 4.3.5, as SSML 1.1 asks for."""
    if text is None:
        return USUAL_BREAK_S
    match = _TIME.fullmatch(text.strip())
    if match is None:
        raise MienError(f'{where}: {text!r} is no time — want time="500ms" or time="0.5s"')
    length_s = float(match["number"]) / (1000.0 if match["unit"] == "ms" else 1.0)
    if length_s > LONGEST_BREAK_S:
        raise RangeError(f"{where}: a break of {length_s:g} s is too long — it goes up to {LONGEST_BREAK_S:g} s")
    return length_s
