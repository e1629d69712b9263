"""Subtitles from the words of a timeline: where one ends, where its lines break, and how long it stays."""

from __future__ import annotations

import math
import re
import unicodedata
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, pairwise, takewhile

from mien.core import Cue
from mien.timeline import Timeline


@dataclass(frozen=True)
class Guide:
    """What a subtitle may be.

    Source: Netflix, Timed Text Style Guide (General Requirements, Subtitle Timing Guidelines, English), unless said.

    Attributes:
        line_length: characters of a line, at most.
        characters_per_s: that an adult reads; a subtitle stays longer than its words for it where there is room.
        least_s: how long a subtitle stays at least.
        most_s: how long it stays at most.
        gap_s: between two subtitles, so that the eye sees the change: two frames of film.
        close_s: a gap shorter than this is closed to ``gap_s``, because a flicker disturbs.
        hang_s: how long it stays after its words at most. Source: BBC, Subtitle Guidelines, section 5.2.
        pause_s: silence between two words that is heard as an end.
    """

    line_length: int = 42
    characters_per_s: float = 17.0
    least_s: float = 5.0 / 6.0
    most_s: float = 7.0
    gap_s: float = 2.0 / 24.0
    close_s: float = 0.5
    hang_s: float = 1.5
    pause_s: float = 0.3


GUIDE = Guide()


@dataclass(frozen=True)
class Costs:
    """How much is amiss with a subtitle; of all ways to divide the words, the one with the least sum is taken.

    Breaks are good after punctuation and before conjunctions and prepositions, bad after a word that leads to the next.
    Source: the order is that of both guides; the amounts are ours.

    Attributes:
        sentence: of a break at the end of a sentence; the others are of breaks elsewhere.
        clause: after a comma, semicolon, colon or dash, or at a pause.
        joint: before a word that begins a phrase.
        anywhere: between any other two words.
        leading: after a word that leads to the next, such as an article.
        each: of a subtitle, so that there are few.
        run_on: of an end of a sentence, or a pause, inside a subtitle.
        hurried: of a subtitle that is shown for no time, less for one that is shown nearly long enough.
        endless: of a subtitle that is shown too long.
        crowded: of a subtitle of two full lines; it falls with the square, so that neighbours share their words evenly.
        uneven: of two lines of which one is empty, less for lines of nearly one length.
    """

    sentence: float = 0.0
    clause: float = 1.0
    joint: float = 2.0
    anywhere: float = 4.0
    leading: float = 8.0
    each: float = 2.0
    run_on: float = 3.0
    hurried: float = 12.0
    endless: float = 10.0
    crowded: float = 1.0
    uneven: float = 4.0


COSTS = Costs()


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


JOINTS = _words(
    "and but or nor so yet because although though while when where if unless until since than that which who whose "
    "about above across after against along among around at before behind below beneath beside between beyond by down "
    "during for from in inside into like near of off on onto out over past through to toward towards under up upon "
    "with within without as"
)
"""Words that begin a phrase. English, as the built-in voice."""

TITLES = _words("mr mrs ms dr prof st mt gen sen rep capt lt col sgt rev")
"""Words whose full stop ends no sentence."""

LEADERS = (
    JOINTS
    | TITLES
    | _words(
        "a an the my your his her its our their this these those no not i you he she it we they "
        "am is are was were be been have has had do does did will would shall should can could may might must don't"
    )
)
"""Words that lead to the next one: articles, pronouns, auxiliaries, titles, and what begins a phrase."""

_SENTENCE_MARKS, _CLAUSE_MARKS, _CLOSERS = ".!?…", ",;:—–-", "\"'”’)]»"
_WINDOW = 400
"""Characters within which the next word of a text is looked for; what lies between was not said."""


@dataclass(frozen=True)
class Subtitle:
    """One or two lines, shown from ``start_s`` until ``end_s``, seconds."""

    start_s: float
    end_s: float
    lines: tuple[str, ...]


@dataclass(frozen=True)
class _Piece:
    """A word with its punctuation, that is never broken, and when it is said."""

    text: str
    start_s: float
    end_s: float

    @property
    def plain(self) -> str:
        return self.text.strip(_SENTENCE_MARKS + _CLAUSE_MARKS + _CLOSERS + "“‘([«").lower()


def make_subtitles(timeline: Timeline, guide: Guide = GUIDE) -> tuple[Subtitle, ...]:
    """Subtitles of what is said, in order, none over another; without a text, the words stand without punctuation."""
    words = sorted(word for word in timeline.words if word.symbol.strip())
    pieces = [part for piece in _find_pieces(words, timeline.text) for part in _split(piece, guide.line_length)]
    runs = [pieces[first:last] for first, last in pairwise(_divide(pieces, guide))]
    return tuple(_time(runs, timeline.length_s, guide))


def _find_pieces(words: Sequence[Cue], text: str) -> list[_Piece]:
    """Words as they stand in the text, with the marks around them; what was not said is left out."""
    spots = [(match.start(), match.end()) for match in re.finditer(r"\S+", text)]
    number, place = 0, 0  # of the spot that is next, and the character behind the last word
    pieces: list[_Piece] = []
    for word in words:
        at = find_word(text, word.symbol, place)
        if at < 0:
            pieces.append(_Piece(word.symbol, word.start_s, word.end_s))
            continue
        place = at + len(word.symbol)
        if pieces and number and at < spots[number - 1][1]:  # of the same piece, as in well-known
            pieces[-1] = replace(pieces[-1], end_s=word.end_s)
            continue
        between = number
        while spots[number][1] <= at:
            number += 1
        _add_marks(pieces, (text[first:last] for first, last in spots[between:number]))
        first = spots[number][0]
        while number + 1 < len(spots) and spots[number][1] < place:  # a word with a blank in it
            number += 1
        pieces.append(_Piece(text[first : spots[number][1]], word.start_s, word.end_s))
        number += 1
    _add_marks(pieces, (text[first:last] for first, last in spots[number:]))
    return pieces


def find_word(text: str, word: str, place: int) -> int:
    """Where the word stands next, as a whole word if it does so anywhere near; -1 if it does not stand there at all."""
    end = place + len(word) + _WINDOW
    first = at = text.find(word, place, end)
    while at >= 0:
        around = text[max(at - 1, place) : at] + text[at + len(word) : at + len(word) + 1]
        if not any(character.isalnum() for character in around):
            return at
        at = text.find(word, at + 1, end)
    return first


def _add_marks(pieces: list[_Piece], spots: Iterable[str]) -> None:
    """Gives a dash, or other marks that stand alone, to the word before; nothing of what follows an unsaid word."""
    for spot in takewhile(lambda spot: all(unicodedata.category(character)[0] == "P" for character in spot), spots):
        if pieces:
            pieces[-1] = replace(pieces[-1], text=f"{pieces[-1].text} {spot}")


def _split(piece: _Piece, line_length: int) -> Iterator[_Piece]:
    """The piece, in several where it has blanks or is longer than a line; each is said for its share of the time."""
    shown = "".join(character for character in piece.text if unicodedata.category(character) not in ("Cc", "Cs", "Co"))
    words = [shown] if len(shown) <= line_length else shown.split()
    parts = [word[at : at + line_length] for word in words for at in range(0, len(word), line_length)]
    if len(parts) == 1:
        yield replace(piece, text=shown)
        return
    step = (piece.end_s - piece.start_s) / max(sum(map(len, parts)), 1)
    start = piece.start_s
    for part in parts:
        yield _Piece(part, start, start + step * len(part))
        start += step * len(part)


def _divide(pieces: Sequence[_Piece], guide: Guide) -> list[int]:
    """Where subtitles begin, and the end: the way through the pieces of least cost.

    Source: Knuth and Plass 1981, "Breaking paragraphs into lines": all breaks of a paragraph are chosen together.
    """
    measured = _Measured(pieces, guide)
    best, before = [0.0], [0]
    for last in range(1, len(pieces) + 1):
        ways: list[tuple[float, int]] = []
        for first in range(last - 1, -1, -1):
            if first < last - 1 and not measured.fits(first, last):
                break
            ways.append((best[first] + measured.cost(first, last), -first))
        cost, place = min(ways)
        best.append(cost)
        before.append(-place)
    ends = [len(pieces)]
    while ends[-1]:
        ends.append(before[ends[-1]])
    return ends[::-1]


class _Measured:
    """Pieces with sums that make the cost of each run of them quick to tell."""

    def __init__(self, pieces: Sequence[_Piece], guide: Guide) -> None:
        self._pieces, self._guide = pieces, guide
        self._places = _places(pieces)
        self._breaks = [_break_cost(one, two, guide) for one, two in pairwise(pieces)] + [COSTS.sentence]
        self._sentences = [0, *accumulate(cost <= COSTS.sentence for cost in self._breaks)]

    def length(self, first: int, last: int) -> int:
        """Characters of a run on one line."""
        return self._places[last] - self._places[first] - 1

    def fits(self, first: int, last: int) -> bool:
        """Whether a run fits into two lines: with as much as possible on the first, no more than a line is left."""
        most = self._guide.line_length
        second = bisect_right(self._places, self._places[first] + most + 1) - 1
        return second >= last or (second > first and self.length(second, last) <= most)

    def cost(self, first: int, last: int) -> float:
        """Of a run as one subtitle, and of the break at its end."""
        guide, start_s = self._guide, self._pieces[first].start_s
        room_s = self._pieces[last].start_s - guide.gap_s - start_s if last < len(self._pieces) else math.inf
        spoken_s = self._pieces[last - 1].end_s - start_s
        return (
            COSTS.each
            + self._breaks[last - 1]
            + COSTS.run_on * (self._sentences[last - 1] - self._sentences[first])
            + COSTS.hurried * max(0.0, 1.0 - room_s / guide.least_s)
            + COSTS.crowded * (self.length(first, last) / (2.0 * guide.line_length)) ** 2
            + (COSTS.endless if spoken_s > guide.most_s else 0.0)
        )


def _places(pieces: Sequence[_Piece]) -> list[int]:
    """Where each piece begins in a line of all of them, and where one more would."""
    return [0, *accumulate(len(piece.text) + 1 for piece in pieces)]


def _break_cost(one: _Piece, two: _Piece, guide: Guide) -> float:
    """Of a break between two pieces."""
    paused = two.start_s - one.end_s >= guide.pause_s
    last = (one.text.rstrip(_CLOSERS) or " ")[-1]
    titled = last == "." and one.plain in TITLES
    if last in _SENTENCE_MARKS and not titled and (paused or last != "."):
        return COSTS.sentence
    if titled or (one.plain in LEADERS and not paused and last not in _SENTENCE_MARKS + _CLAUSE_MARKS):
        return COSTS.leading
    if paused or last in _SENTENCE_MARKS + _CLAUSE_MARKS:
        return COSTS.clause
    return COSTS.joint if two.plain in JOINTS else COSTS.anywhere


def _lines(pieces: Sequence[_Piece], guide: Guide) -> tuple[str, ...]:
    """One line if it is short enough, else two, broken where it disturbs least, and rather the second one longer."""
    whole, places = " ".join(piece.text for piece in pieces), _places(pieces)
    if len(whole) <= guide.line_length or len(pieces) == 1:
        return (whole,)

    def cost(second: int) -> tuple[float, int]:
        uneven = abs(2 * places[second] - places[-1]) / places[-1]
        return _break_cost(pieces[second - 1], pieces[second], guide) + COSTS.uneven * uneven, second

    fitting = (
        second
        for second in range(1, len(pieces))
        if max(places[second], places[-1] - places[second]) <= guide.line_length + 1
    )
    middle = places[min(fitting, key=cost)]
    return whole[: middle - 1], whole[middle:]


def _time(runs: Sequence[Sequence[_Piece]], length_s: float, guide: Guide) -> Iterator[Subtitle]:
    """The subtitles with their times: from the first word, for as long as they need and the next one lets them."""
    free_s = 0.0
    for number, pieces in enumerate(runs):
        lines = _lines(pieces, guide)
        start = max(pieces[0].start_s, free_s)
        spoken = pieces[-1].end_s
        reading = sum(map(len, lines)) / guide.characters_per_s
        wanted = max(spoken, min(start + max(reading, guide.least_s), spoken + guide.hang_s))
        if number + 1 < len(runs):
            following = runs[number + 1][0].start_s
            end = following - guide.gap_s if following - wanted < guide.close_s else wanted
        else:
            end = max(spoken, min(wanted, length_s))
        # Where words follow without any room, a gap would leave nothing to see.
        free_s = end if end > start else max(start + guide.gap_s, spoken)
        yield Subtitle(start, free_s, lines)
