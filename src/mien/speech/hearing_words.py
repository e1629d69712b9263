"""The words of a transcript as they are said: numbers in full, each with a pronunciation and its stresses."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

from mien.core import SILENCE

from .phones import VOWELS, strip_stress
from .text import split_passages, trim_word
from .voice_hibari import load_engine
from .voice_times import Letter, time_phones

OWN_MARK = "~"
"""Ends the spelling of a pronunciation that is not the dictionary's."""

_HYPHENS = re.compile(r"[-‐‑–—/]+")
_APOSTROPHES = str.maketrans("‘’ʼ`´", "'''''")

Lookup = Callable[[str], tuple[str, ...] | None]
"""Phones of a word without stress; None for one that a dictionary does not have."""


@dataclass(frozen=True)
class Token:
    """A word to listen for.

    Attributes:
        spellings: the words of the dictionary that it can be heard as.
        spoken: as the voice takes it.
        owner: place of the written word that it belongs to.
    """

    spellings: tuple[str, ...]
    spoken: str
    owner: int


@dataclass(frozen=True)
class Transcript:
    """A text to listen for.

    Attributes:
        written: its words, without the punctuation around them.
        tokens: what is said for them, in order; a written word can have several or none.
        learned: phones, without stress, of the spellings that the dictionary does not have.
        skipped: what has no pronunciation.
    """

    written: tuple[str, ...]
    tokens: tuple[Token, ...]
    learned: Mapping[str, tuple[str, ...]]
    skipped: tuple[str, ...]


def read_transcript(text: str, lookup: Lookup) -> Transcript:
    """The words of a text, read as the voice reads them: numbers, signs and what no dictionary has too."""
    engine = load_engine()
    written: list[str] = []
    tokens: list[Token] = []
    learned: dict[str, tuple[str, ...]] = {}
    skipped: dict[str, None] = {}
    for passage in split_passages(text):
        wording = engine.word(passage)
        first = len(written)
        written += [trim_word(word.written) for word in wording.written]
        skipped.update(dict.fromkeys(run for word in wording.written for run in word.skipped))
        for spoken, owner in zip(wording.spoken, wording.owners, strict=True):
            for part in _split_spoken(spoken):
                token = _find_token(part, first + owner, lookup, learned)
                tokens += [token] if token else []
    return Transcript(tuple(written), tuple(tokens), learned, tuple(skipped))


def _split_spoken(spoken: str) -> list[str]:
    """Parts of a word at its hyphens; a number or a sign stays whole, because the voice reads it as one."""
    parts = [trim_word(part) for part in _HYPHENS.split(spoken.translate(_APOSTROPHES)) if part]
    return parts if all(part.replace("'", "").isalpha() for part in parts) else [spoken]


def _find_token(part: str, owner: int, lookup: Lookup, learned: dict[str, tuple[str, ...]]) -> Token | None:
    """A part of a word with what it can be heard as; None when it is never heard.

    The voice's own pronunciation is added where it has another number of syllables: an abbreviation, which
    dictionaries spell out in their own way, or a vowel that not everybody says.
    """
    spelling = part.lower()
    known = lookup(spelling)
    ours = tuple(strip_stress(symbol) for symbol in pronounce(part))
    if known is not None and (not ours or _count_vowels(known) == _count_vowels(ours)):
        return Token((spelling,), part, owner)
    if not ours:
        return None
    extra = f"{spelling}{OWN_MARK}"
    learned[extra] = ours
    return Token((extra,) if known is None else (spelling, extra), part, owner)


def _count_vowels(phones: Sequence[str]) -> int:
    return sum(phone in VOWELS for phone in phones)


@cache
def pronounce(word: str) -> tuple[str, ...]:
    """Phones of a word, vowels with their stress digit, as the built-in voice says it; none when it cannot."""
    letters = " ".join(load_engine().pronounce_words([word]))
    phones = time_phones([Letter(letter, place) for place, letter in enumerate(letters)], len(letters))
    return tuple(phone.symbol for phone in phones if phone.symbol != SILENCE)


def add_stress(phones: Sequence[str], word: str) -> list[str]:
    """Phones without stress as they are in a word: its vowels' digits in order, or the first vowel stressed.

    Where no word is known, every vowel is stressed: one that is not is hardly heard.
    """
    if not word:
        return [phone + "1" if phone in VOWELS else phone for phone in phones]
    digits = [symbol[-1] for symbol in pronounce(word) if strip_stress(symbol) in VOWELS]
    count = _count_vowels(phones)
    if len(digits) != count:
        digits = ["1", *"0" * count] if count else []
    left = iter(digits)
    return [phone + next(left) if phone in VOWELS else phone for phone in phones]
