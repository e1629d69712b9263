"""A transcript that is not quite what was said, made so by what a recogniser heard."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher

FEW = 3
"""Up to so many words in a row that differ are mistakes of the recogniser; more are not the text's."""


@dataclass(frozen=True)
class Difference:
    """Words of the text and words that are heard in their place: places (first, one after the last) in both."""

    text: tuple[int, int]
    heard: tuple[int, int]


@dataclass(frozen=True)
class Merge:
    """What to listen for.

    Attributes:
        words: (place in the text, -1) or (-1, place in what is heard), in order.
        agreed: how many words are in both.
        differences: where what is heard was taken for more than a mistake.
    """

    words: tuple[tuple[int, int], ...]
    agreed: int
    differences: tuple[Difference, ...]


def merge_words(text: Sequence[str], heard: Sequence[str]) -> Merge:
    """The text as far as it is heard: short differences as the text has them, long ones as they are heard.

    The text may go on after what is heard.
    """
    words: list[tuple[int, int]] = []
    differences: list[Difference] = []
    agreed = 0
    steps = SequenceMatcher(None, text, heard, autojunk=False).get_opcodes()
    for number, (kind, first, last, start, stop) in enumerate(steps):
        if number == len(steps) - 1 and kind != "equal":
            last = min(last, first + stop - start)
        if kind == "equal" or max(last - first, stop - start) <= FEW:
            words += [(place, -1) for place in range(first, last)]
            agreed += (last - first) * (kind == "equal")
        else:
            words += [(-1, place) for place in range(start, stop)]
            differences.append(Difference((first, last), (start, stop)))
    return Merge(tuple(words), agreed, tuple(differences))
