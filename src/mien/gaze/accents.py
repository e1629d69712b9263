"""Which words a speaker leans on."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib import resources
from types import MappingProxyType

from mien.core import SILENCE, Cue
from mien.core.chance import stream

PAUSE_S = 0.09
PHRASE_S = 2.4
"""A phrase ends at a pause, and is taken as two where it goes on longer than this: our choice."""

LEAST_APART_S = 0.55
SECOND = 0.45
"""Chance of an accent on a content word that is not the strongest of its phrase: our choice."""

OUTSTANDING = 0.85
"""Prominence of a word such as *the* that is leant on: our choice."""

NOTHING: Mapping[Cue, float] = MappingProxyType({})

MARKS = ".,;:!?\"'()[]«»“”‘’…—-"


@dataclass(frozen=True)
class Accent:
    """The moment of a word's stressed vowel.

    Attributes:
        time_s: middle of the vowel.
        strength: 0..1; 1 for the strongest word of its phrase.
        word: as written.
        wanted: somebody asked for it, and chance has no say.
    """

    time_s: float
    strength: float
    word: str
    wanted: bool = False


@dataclass(frozen=True)
class _Candidate:
    accent: Accent
    phrase: int
    weight: float
    word: Cue


def find_accents(
    words: Sequence[Cue],
    phones: Sequence[Cue],
    seed: int,
    stressed: Mapping[Cue, float] = NOTHING,
    prominence: Mapping[Cue, float] = NOTHING,
    ends_s: Sequence[float] = (),
) -> tuple[Accent, ...]:
    """Accented words: the chief content word of each phrase, some of the others by chance, and those asked for.

    The chief word is the most prominent one, or the longest where nobody has listened. Words such as *the* and *of* are
    accented only when asked for, or when they stand out as few words do.

    Args:
        words: cues of the words.
        phones: cues of the phones.
        seed: of the choice among words.
        stressed: words asked for, with their strength.
        prominence: how much words stand out by their sound, 0..1; it is the chance of those that are not chief.
        ends_s: where phrases end besides pauses, in order.

    Source: content words carry the accents of English (Ladefoged 2006, chapter 5); the choice among them is ours.
    """
    chance = stream(seed, "accents")
    candidates = _candidates(words, phones, stressed, prominence, ends_s)
    strongest: dict[int, _Candidate] = {}
    for candidate in candidates:
        best = strongest.get(candidate.phrase)
        if best is None or candidate.weight > best.weight:
            strongest[candidate.phrase] = candidate
    out: list[Accent] = []
    for candidate in candidates:
        heard = prominence.get(candidate.word)
        lucky, share = chance.random() < (SECOND if heard is None else heard), chance.random()
        strength = 0.35 + 0.4 * (share if heard is None else heard)
        chief = strongest[candidate.phrase] is candidate
        accent = candidate.accent
        if not (chief or lucky or accent.wanted):
            continue
        if not accent.wanted:
            accent = replace(accent, strength=1.0 if chief else strength)
        if out and accent.time_s - out[-1].time_s < LEAST_APART_S:
            if (accent.wanted, accent.strength) <= (out[-1].wanted, out[-1].strength):
                continue
            out.pop()
        out.append(accent)
    return tuple(out)


@lru_cache(maxsize=1)
def function_words() -> frozenset[str]:
    """English words that carry grammar rather than content."""
    text = resources.files("mien.gaze").joinpath("data", "function_words.txt").read_text(encoding="utf-8")
    return frozenset(word for line in text.splitlines() if not line.startswith("#") for word in line.split())


def _candidates(
    words: Sequence[Cue],
    phones: Sequence[Cue],
    stressed: Mapping[Cue, float],
    prominence: Mapping[Cue, float],
    ends_s: Sequence[float],
) -> list[_Candidate]:
    out: list[_Candidate] = []
    coming = deque(ends_s)
    place = phrase = 0
    begun_s = 0.0
    for word in sorted(words):
        pause = False
        while place < len(phones) and phones[place].centre_s < word.start_s:
            pause |= phones[place].symbol == SILENCE and phones[place].length_s >= PAUSE_S
            place += 1
        while coming and coming[0] <= word.start_s:
            pause = coming.popleft() >= begun_s or pause
        if pause or word.end_s - begun_s > PHRASE_S:
            phrase, begun_s = phrase + 1, word.start_s
        inside = []
        while place < len(phones) and phones[place].centre_s < word.end_s:
            inside.append(phones[place])
            place += 1
        vowel, weight = _stressed_vowel(inside), prominence.get(word, word.length_s)
        empty = word.symbol.strip(MARKS).lower() in function_words() and prominence.get(word, 0.0) < OUTSTANDING
        if word in stressed:
            accent = Accent((vowel or word).centre_s, stressed[word], word.symbol, wanted=True)
            out.append(_Candidate(accent, phrase, weight, word))
        elif vowel is not None and not empty:
            out.append(_Candidate(Accent(vowel.centre_s, 0.0, word.symbol), phrase, weight, word))
    return out


def _stressed_vowel(phones: Sequence[Cue]) -> Cue | None:
    for level in "12":
        for cue in phones:
            if cue.symbol.endswith(level):
                return cue
    return None
