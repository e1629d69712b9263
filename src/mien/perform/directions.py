"""When the marks of a text act: each at the word it stands before, once the text has been said."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

from mien.core import Cue
from mien.formats.subtitles import find_word
from mien.gaze import Glance

from .marks import Break, Emphasis, Expression, Look, Mark, MarkedText, Units

LEAD_S = 0.2
"""An expression begins to show this long before its word, so that the word is said with it."""

LOOK_LEAD_S = 0.12
LOOK_S = 1.3
"""The eyes leave this long before the word, and come back after so long unless another look follows: our choice."""


@dataclass(frozen=True)
class Directions:
    """What the marks ask of a face, seconds.

    Attributes:
        expressions: from when on, in order.
        glances: where the eyes go.
        stressed: words to lean on, with how much.
    """

    expressions: tuple[tuple[float, Expression | Units], ...] = ()
    glances: tuple[Glance, ...] = ()
    stressed: Mapping[Cue, float] = field(default_factory=dict)


def follow_marks(marked: MarkedText, words: Sequence[Cue], length_s: float) -> Directions:
    """The directions in a text for those who say it.

    A mark acts at the word behind it; where a break comes before that word, at the break's beginning, and behind the
    last word when that is over.

    Args:
        marked: the text and its marks.
        words: cues of its words, found in it in order.
        length_s: of what is heard.
    """
    if not marked.marks:
        return Directions()
    places = find_places(words, marked.text)
    timed = list(_time_marks(marked.marks, words, places))
    return Directions(
        tuple((max(0.0, time_s - LEAD_S), act) for time_s, act in timed if isinstance(act, Expression | Units)),
        tuple(_end_looks([(time_s, act) for time_s, act in timed if isinstance(act, Look)], length_s)),
        dict(_find_stressed(marked.marks, words, places)),
    )


def find_places(words: Iterable[Cue], text: str) -> list[tuple[int, int]]:
    """First character of each word and the one after its last; a word that is not there is nowhere, behind the last."""
    lowered = _lower(text)
    places: list[tuple[int, int]] = []
    end = 0
    for word in words:
        at = find_word(lowered, _lower(word.symbol), end)
        if at >= 0:
            places.append((at, at + len(word.symbol)))
            end = at + len(word.symbol)
        else:
            places.append((end, end))
    return places


def _lower(text: str) -> str:
    """The text in small letters, but for the few that would become two and shift all that follows."""
    return "".join(small if len(small := letter.lower()) == 1 else letter for letter in text)


def _next_word(place: int, places: Sequence[tuple[int, int]]) -> int:
    """Number of the first word that ends behind a character."""
    return bisect_right(places, place, key=lambda span: span[1])


def _time_marks(
    marks: Sequence[Mark], words: Sequence[Cue], places: Sequence[tuple[int, int]]
) -> Iterator[tuple[float, Expression | Units | Look]]:
    last_break = {
        _next_word(mark.place, places): number for number, mark in enumerate(marks) if isinstance(mark.act, Break)
    }
    for number, mark in enumerate(marks):
        if isinstance(mark.act, Break | Emphasis):
            continue
        word = _next_word(mark.place, places)
        if last_break.get(word, -1) > number or word == len(words):
            yield (words[word - 1].end_s if word else 0.0), mark.act
        else:
            yield words[word].start_s, mark.act


def _end_looks(looks: Sequence[tuple[float, Look]], length_s: float) -> Iterator[Glance]:
    starts = [max(0.0, time_s - LOOK_LEAD_S) for time_s, _ in looks]
    glances = [
        Glance(start_s, min(start_s + LOOK_S, length_s), look.direction, look.amount)
        for start_s, (_, look) in zip(starts, looks, strict=True)
    ]
    for glance, following in pairwise([*glances, Glance(length_s, length_s, "viewer")]):
        yield replace(glance, end_s=min(glance.end_s, following.start_s))


def _find_stressed(
    marks: Iterable[Mark], words: Sequence[Cue], places: Sequence[tuple[int, int]]
) -> Iterator[tuple[Cue, float]]:
    for mark in marks:
        if isinstance(mark.act, Emphasis):
            number = _next_word(mark.place, places)
            while number < len(words) and places[number][0] < mark.act.end:
                yield words[number], mark.act.strength
                number += 1
