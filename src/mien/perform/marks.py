r"""Marks in a text: what a face does at a place, written between the words, and the words without them.

``[smile]``, ``[smile 0.6]``, ``[neutral]``: an expression from there on. ``[wave]``: what a hand does, of a face that
has one. ``[au 1=0.5,2=0.5]``: action units from there on. ``[look left]``: a look. ``<break time="500ms"/>``: silence.
``<emphasis>so happy</emphasis>``, ``*happy*``: stress. ``\[``, ``\<``, ``\*`` and ``\\`` stand for the signs
themselves; so do a bracket that no letter follows (``[1]``), a ``<`` that no letter or ``/`` follows, and a star that
has no partner in its line.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Expression:
    """A preset of the face or its hand, 0..1 of it, from here on; ``neutral`` ends the expression before."""

    name: str
    amount: float = 1.0


@dataclass(frozen=True)
class Units:
    """Action units, 0..1 by name, from here on."""

    values: Mapping[str, float]


@dataclass(frozen=True)
class Look:
    """A look in a direction of ``look_directions``, 0..1 of the way."""

    direction: str
    amount: float = 1.0


@dataclass(frozen=True)
class Emphasis:
    """Stress on the words up to character ``end`` of the plain text."""

    end: int
    strength: float = 1.0


@dataclass(frozen=True)
class Break:
    """Silence, seconds."""

    length_s: float


Act = Expression | Units | Look | Emphasis | Break


@dataclass(frozen=True)
class Mark:
    """Something that happens at a place of a text.

    Attributes:
        act: what happens.
        place: character of the plain text that it stands before.
        line: where it was written, from 1.
        column: where it was written, from 1.
    """

    act: Act
    place: int
    line: int = 1
    column: int = 1

    @property
    def where(self) -> str:
        """Its place in words, for messages."""
        return f"line {self.line}, column {self.column}"


@dataclass(frozen=True)
class MarkedText:
    """A text without its marks, and the marks in the order in which they were written."""

    text: str
    marks: tuple[Mark, ...] = ()

    @property
    def pauses(self) -> dict[int, float]:
        """Seconds of silence by the character that they stand before; neighbours are added up."""
        found: dict[int, float] = {}
        for mark in self.marks:
            if isinstance(mark.act, Break):
                found[mark.place] = found.get(mark.place, 0.0) + mark.act.length_s
        return found
