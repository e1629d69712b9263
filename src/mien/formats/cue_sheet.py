"""Words, phones and mouth shapes of one recording, as files of cues hold them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from mien.core import Cue, MienError, UnknownNameError
from mien.timeline import Timeline

WORDS, PHONES, SHAPES = "words", "phones", "shapes"
"""Names of the usual tiers."""

LINES = "lines"
"""Name of the tier of subtitles that hold more than a word."""

LONGEST_S = 1e6
"""Eleven days, seconds: nothing that is spoken lasts longer, but a time in milliseconds or samples does."""

ROUNDING_S = 1e-6
"""By which a cue may begin before the one before it ends, seconds: other programs round each time for itself."""


_NO_TEXT = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
"""Source: W3C, Extensible Markup Language 1.0, section 2.2."""


@dataclass(frozen=True)
class CueSheet:
    """What is heard in a recording, and when.

    Attributes:
        length_s: duration of the recording, seconds.
        tiers: cues by the name of what they are: usually ``words``, ``phones`` and ``shapes``. Those of a tier are in
            order and do not overlap; between them may be gaps.
        sound: name of the recording's file, if known.
        text: what is said, as it was written, if known.
    """

    length_s: float
    tiers: Mapping[str, tuple[Cue, ...]]
    sound: str = ""
    text: str = ""

    def __post_init__(self) -> None:
        if not 0.0 < self.length_s <= LONGEST_S:
            raise MienError(f"cues: a length of {self.length_s} s is not a number above 0 and up to {LONGEST_S:g}")
        if not self.tiers:
            raise MienError(f"cues: there is no tier, want one at least, such as {PHONES!r}")
        tiers = {
            name: tuple(Cue(float(cue.start_s), float(cue.end_s), cue.symbol) for cue in cues)
            for name, cues in self.tiers.items()
        }
        object.__setattr__(self, "length_s", float(self.length_s))
        object.__setattr__(self, "tiers", MappingProxyType(tiers))
        for name, cues in tiers.items():
            end_s = 0.0
            for number, cue in enumerate(cues, start=1):
                if wrong := find_fault(cue, end_s, self.length_s) or _find_misprint(cue.symbol):
                    raise MienError(f"{place_of(name, number)}: {wrong}")
                end_s = cue.end_s

    def tier(self, name: str) -> tuple[Cue, ...]:
        """The cues of a tier.

        Raises:
            UnknownNameError: there is none of that name.
        """
        if name not in self.tiers:
            raise UnknownNameError("tier", name, self.tiers)
        return self.tiers[name]


def sheet_of(timeline: Timeline) -> CueSheet:
    """The words and phones of a timeline.

    Raises:
        MienError: nothing is said in it.
    """
    words = tuple(word for word in timeline.words if word.symbol.strip())
    if not words and not timeline.phones:
        raise MienError("no word is said in this timeline, so there are no times of words and phones to write")
    return CueSheet(timeline.length_s, {WORDS: words, PHONES: timeline.phones}, text=timeline.text)


def find_fault(cue: Cue, end_s: float, length_s: float) -> str:
    """What is wrong with the times of a cue; nothing, an empty text, where all is well.

    Args:
        cue: to be looked at.
        end_s: where the cue before it ends, seconds; 0 for the first.
        length_s: of the recording, seconds.
    """
    if 0.0 <= cue.start_s < cue.end_s <= length_s and cue.start_s >= end_s:
        return ""
    span = f"{cue.symbol!r} from {cue.start_s:.10g} to {cue.end_s:.10g} s"
    if not (math.isfinite(cue.start_s) and math.isfinite(cue.end_s)):
        return f"{span} has a time that is no finite number"
    if cue.start_s < 0.0:
        return f"{span} begins before 0"
    if cue.end_s <= cue.start_s:
        return f"{span} does not end after it begins"
    if cue.start_s < end_s - ROUNDING_S or cue.end_s <= end_s:
        return f"{span} begins before the one before it ends, at {end_s:.10g} s"
    if cue.end_s > length_s + ROUNDING_S:
        return f"{span} ends after everything does, at {length_s:.10g} s"
    return ""


def _find_misprint(symbol: str) -> str:
    """What is wrong with a symbol; nothing, an empty text, where all is well."""
    if not symbol.strip():
        return "has no symbol"
    return f"{symbol!r} holds a character that no text can have" if _NO_TEXT.search(symbol) else ""


def place_of(tier: str, number: int) -> str:
    """How messages name an interval of a tier; the first is number 1."""
    return f"tier {tier!r}, interval {number}"


def fill_gaps(cues: Iterable[Cue], length_s: float, symbol: str = "") -> Iterator[Cue]:
    """The cues of a tier with a cue of ``symbol`` in each gap, from 0 to the end without holes."""
    end_s = 0.0
    for cue in cues:
        if cue.start_s - end_s > ROUNDING_S:
            yield Cue(end_s, cue.start_s, symbol)
            end_s = cue.start_s
        yield Cue(end_s, cue.end_s, cue.symbol)
        end_s = cue.end_s
    if length_s - end_s > ROUNDING_S:
        yield Cue(end_s, length_s, symbol)
