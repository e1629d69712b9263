"""Marked texts taken apart for being said live: one sentence at a time, the first one soon."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from mien.core import MienError, RangeError, UnknownNameError
from mien.perform.directions import Directions
from mien.perform.marks import Expression, Mark, MarkedText, Units
from mien.perform.marks_reader import LONGEST_BREAK_S, parse_marks
from mien.speech.text import find_clause, split_passages

LEAD_S = 0.08
"""Silence before the first word, seconds: a page needs about so long until its sound is on its way."""

SHORTEST_TAIL_S = 0.1

SOON = 90
"""Characters of a sentence that are made first where somebody waits for it: below 0.2 s of work."""

SHORTEST_CLAUSE = 20
LOOK_AGAIN = "viewer"
NEUTRAL = "neutral"
"""The mark that ends expressions."""


@dataclass(frozen=True)
class Sentence:
    """What is said at once.

    Attributes:
        marked: the words, and marks by their characters; without words the marks act all the same.
        tail_s: silence wanted after it.
        goes_on: the words end within a clause.
    """

    marked: MarkedText
    tail_s: float = SHORTEST_TAIL_S
    goes_on: bool = False

    @property
    def text(self) -> str:
        """Its words."""
        return self.marked.text


def read_marks(text: str, motions: Iterable[str]) -> MarkedText:
    """The text and its marks, all of which a live face can follow.

    Raises:
        MienError: a mark cannot be understood, or is none that can be followed here.
        UnknownNameError: there is no such motion.
        RangeError: an amount is out of range, or breaks are too long.
    """
    marked = parse_marks(text.replace("\r\n", "\n"))
    silence_s = sum(marked.pauses.values())
    if silence_s > LONGEST_BREAK_S:
        raise RangeError(f"breaks of {silence_s:g} s in one text are too much — together up to {LONGEST_BREAK_S:g} s")
    known = [*motions, NEUTRAL]
    for mark in marked.marks:
        if isinstance(mark.act, Units):
            raise MienError(f"{mark.where}: [au …] is not played live — play a motion, or move the parameters")
        if isinstance(mark.act, Expression) and mark.act.name not in known:
            raise UnknownNameError(f"motion in {mark.where}:", mark.act.name, known)
    return marked


def split_sentences(marked: MarkedText, language: str) -> Iterator[Sentence]:
    """The sentences of a text, each with its marks; marks without words are one, too.

    Args:
        marked: the text.
        language: subtag of what it is written in.
    """
    text, start = marked.text, 0
    spans = [(passage.end, passage.pause_s, passage.goes_on) for passage in split_passages(text, language)]
    for number, (end, pause_s, goes_on) in enumerate(spans, 1):
        end = len(text) if number == len(spans) else end
        yield Sentence(_part(marked, start, end), max(SHORTEST_TAIL_S, pause_s - LEAD_S), goes_on)
        start = end
    if marked.marks and not spans:
        yield Sentence(_part(marked, 0, len(text)))


def cut_sentence(sentence: Sentence) -> tuple[Sentence, ...]:
    """The sentence in two where that lets it begin sooner: after a clause of a long one."""
    text = sentence.text
    place = find_clause(text, SOON, SHORTEST_CLAUSE) if len(text) > SOON else 0
    if not place:
        return (sentence,)
    first = Sentence(_part(sentence.marked, 0, place))
    return first, replace(sentence, marked=_part(sentence.marked, place, len(text)))


def _part(marked: MarkedText, start: int, end: int) -> MarkedText:
    """Some characters of a text without the blanks around them, and the marks there."""
    written = marked.text[start:end]
    first = start + len(written) - len(written.lstrip())
    text = written.strip()
    last = end == len(marked.text)
    return MarkedText(
        text, tuple(_moved(mark, first, len(text)) for mark in marked.marks if start <= mark.place < end + last)
    )


def _moved(mark: Mark, by: int, length: int) -> Mark:
    return replace(mark, place=min(max(0, mark.place - by), length))


def time_acts(directions: Directions) -> Iterator[tuple[float, Mapping[str, Any]]]:
    """Messages, JSON, that stand for what marks ask for, and when, seconds."""
    for time_s, act in directions.expressions:
        if isinstance(act, Expression):
            if act.name == NEUTRAL:
                yield time_s, {"kind": "stop", "layer": "expression"}
            else:
                yield time_s, {"kind": "play", "motion": act.name, "strength": act.amount}
    for glance in directions.glances:
        yield glance.start_s, {"kind": "look", "at": glance.direction, "head": glance.amount}
        yield glance.end_s, {"kind": "look", "at": LOOK_AGAIN}
