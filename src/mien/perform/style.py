"""How lively a face speaks: an amount for each pass of the mouth, and for blinks, head, brows and gaze."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib import resources
from types import MappingProxyType

from mien.core import MienError, UnknownNameError
from mien.speech.articulation import Amount, Articulation, amount, amounts

SWITCHES = {"on": 1.0, "yes": 1.0, "true": 1.0, "off": 0.0, "no": 0.0, "false": 0.0}


@dataclass(frozen=True, kw_only=True)
class Style(Articulation):
    """Amounts from 0 (off) over 1 (usual) to 2 or less: those of the mouth and those of the face around it."""

    blinks: float = amount("how often the eyes blink")
    head: float = amount("how far the head sways and nods")
    brows: float = amount("how far the brows rise with accents")
    gaze: float = amount("how far the eyes stray from the viewer")


@dataclass(frozen=True)
class NamedStyle:
    """A row of ``data/styles.csv``: amounts that have a name together, and what they are like."""

    name: str
    amounts: Mapping[str, float]
    doc: str


@dataclass(frozen=True)
class Wish:
    """What parts of a text have asked for so far: amounts of named styles, and those given one by one over them."""

    named: Mapping[str, float] = field(default_factory=dict)
    given: Mapping[str, float] = field(default_factory=dict)

    def add(self, part: str) -> Wish:
        """The wish with one part more: the name of a style, ``name=value`` or nothing.

        Raises:
            MienError: it is neither, a name comes twice, or a value is neither a number, ``on`` nor ``off``.
            UnknownNameError: there is no such amount or style.
            RangeError: an amount is out of range.
        """
        part = part.strip()
        if not part:
            return self
        if part in named_styles():
            return Wish({**self.named, **named_styles()[part].amounts}, self.given)
        if part.isidentifier() and part not in style_table():
            raise UnknownNameError("style", part, [*named_styles(), *style_table()])
        name, value = _parse_part(part)
        if name in self.given:
            raise MienError(f"style {part!r}: {name} is given twice")
        return Wish(self.named, {**self.given, name: value})

    def style(self) -> Style:
        """The style; what is not asked for is as usual."""
        return Style(**{**self.named, **self.given})


def style_table() -> Mapping[str, Amount]:
    """What a style can set, by name."""
    return amounts(Style)


@cache
def named_styles() -> Mapping[str, NamedStyle]:
    """The styles that have a name.

    Source: Edwards et al. 2016 (JALI), section 3: two axes, jaw and lips, from mumbling to over-enunciating; the
    amounts are our choice.
    """
    text = resources.files("mien.perform").joinpath("data", "styles.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(text.splitlines())
    styles = (NamedStyle(row["name"], dict(map(_parse_part, row["amounts"].split())), row["doc"]) for row in rows)
    return MappingProxyType({style.name: style for style in styles})


def parse_style(text: str) -> Style:
    """The style in a text such as ``mumbling,blinks=off,head=0.5``; what it does not name is as usual.

    Raises:
        MienError: as ``Wish.add``.
    """
    wish = Wish()
    for part in text.split(","):
        wish = wish.add(part)
    return wish.style()


def _parse_part(part: str) -> tuple[str, float]:
    name, equals, value = (piece.strip() for piece in part.partition("="))
    if not equals:
        raise MienError(f"style {part!r}: want name=value, for example blinks=off,head=0.5")
    if name not in style_table():
        raise UnknownNameError("style", name, style_table())
    row = style_table()[name]
    if value.lower() in SWITCHES:
        return name, SWITCHES[value.lower()]
    try:
        return name, row.check(float(value))
    except ValueError:
        raise MienError(f"style {name}={value}: want a number from 0 to {row.high:g}, on or off") from None
