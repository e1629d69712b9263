"""Speech that is not understood: its phones in the place of words that are hardly right, and of words not found."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .align import FoundPhone, FoundWord
from .hearing_follow import find_unexplained_s
from .hearing_sound import Loudness

LIKELY_SCORE = 38.0
"""Score of a recognised word up to which its phones are nearer to what is said than those heard without words.

Measured by the mouth shapes of nine seconds of four speakers, without noise and with noise 10 dB below them, and of a
minute of three synthetic voices: from 28 to 38 they get better for the first and stay the same for the others.
"""

UNCLEAR_SHARE = 0.25
"""Of the time of a piece: with less of it unclear, phones without words are not worth the work of hearing them."""

LEAST_PHONE_S = 0.015
"""What is left of a phone beside a word must last so long, seconds: more than a frame."""


def is_understood(words: Sequence[FoundWord], piece: tuple[float, float], loudness: Loudness) -> bool:
    """Whether most of a piece is words that are likely right, and little is heard beside them."""
    guessed_s = sum(word.end_s - word.start_s for word in words if word.score > LIKELY_SCORE)
    unclear_s = guessed_s + sum(find_unexplained_s(words, piece, loudness))
    return unclear_s <= UNCLEAR_SHARE * (piece[1] - piece[0])


def put_phones(words: Sequence[FoundWord], phones: Sequence[FoundPhone]) -> list[FoundWord]:
    """The likely words, and between them phones as words without a spelling, in order of time."""
    likely = [word for word in words if word.score <= LIKELY_SCORE]
    ends = [0.0, *(word.end_s for word in likely)]
    starts = [*(word.start_s for word in likely), float("inf")]
    runs = [run for gap in zip(ends, starts, strict=True) for run in _find_runs(phones, *gap)]
    return sorted([*likely, *runs], key=lambda word: word.start_s)


def _find_runs(phones: Sequence[FoundPhone], start_s: float, end_s: float) -> Iterator[FoundWord]:
    """Phones between two times, as a word from each pause to the next."""
    run: list[FoundPhone] = []
    for phone in phones:
        first_s, last_s = max(phone.start_s, start_s), min(phone.end_s, end_s)
        if last_s - first_s < LEAST_PHONE_S:
            continue
        if run and first_s > run[-1].end_s + LEAST_PHONE_S:
            yield FoundWord("", tuple(run), LIKELY_SCORE)
            run = []
        run.append(FoundPhone(phone.symbol, first_s, last_s))
    if run:
        yield FoundWord("", tuple(run), LIKELY_SCORE)
