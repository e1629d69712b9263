"""Voices in other languages by espeak-ng, an extra: ``pip install 'mien[espeak]'``."""

from __future__ import annotations

import csv
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib import resources

import numpy as np
from numpy.typing import NDArray

from mien.core import SILENCE, MienError

from .phones import STOPS, VOWELS, convert_ipa, read_ipa_table
from .text import Passage, must_sound, prepare_word, read_abbreviations, split_passages, split_words, trim_word
from .voice import Utterance, language_tags
from .voice_espeak_engine import INSTALL, Engine, Event, Said, find_installation
from .voice_level import set_level
from .voice_times import SHORTEST_PAUSE_S, STRESS_MARKS, TimedPhone, fit_pauses, time_words, to_cues

RATE_HZ = 22050

WORDS_A_MINUTE = 155
"""A little slower than the engine by default, whose 175 sound hurried on a face."""

SILENT = 12
"""Largest sample of a closure, of 32767."""

LONGEST_CLOSURE_S = 0.08
"""The engine tells a stop at its burst; so much silence before it at most is its closure, seconds."""


@dataclass(frozen=True)
class EspeakVoice:
    """A voice of espeak-ng.

    Attributes:
        engine: what the engine calls it; a variant follows a ``+``: ``de+f4``; f2 and f3 vary by chance.
        words_a_minute: how fast it speaks.
    """

    name: str
    engine: str
    language: str
    description: str
    words_a_minute: int = WORDS_A_MINUTE
    rate_hz: int = RATE_HZ

    def utterances(self, text: str) -> Iterator[Utterance]:
        """The text said a sentence or line at a time.

        Raises:
            MienError: the extra is not installed, or the engine has no such voice.
        """
        language = self.language.split("-")[0]
        with Engine() as engine:
            for passage in split_passages(text, language):
                yield self._say(passage, engine, language)

    def _say(self, passage: Passage, engine: Engine, language: str) -> Utterance:
        words = [prepare_word(word, _sayable()) for word in split_words(passage.text)]
        said = _expand([" ".join(word.spoken) for word in words], language)
        starts = np.cumsum([0, *(len(spoken) + 1 for spoken in said)])[:-1]
        skipped = [run for word in words for run in word.skipped]
        line = " ".join(said) + "," * passage.goes_on
        answer = engine.say(line, self.engine, self.words_a_minute)
        owners = [
            int(np.searchsorted(starts, event.place, side="right")) - 1 for event in answer.events if event.is_word
        ]
        timed = share_joined(time_events(answer, owners, language), said)
        phones = fit_pauses(timed, answer.samples, answer.rate_hz)
        spoken = [phone for phone in phones if phone.symbol != SILENCE]
        heard = {phone.word for phone in spoken}
        skipped += [
            word.written
            for place, word in enumerate(words)
            if place not in heard and not word.skipped and any(must_sound(part) for part in word.spoken)
        ]
        if not spoken:
            return Utterance(np.zeros(0, np.int16), (), (), tuple(skipped), 0.0, passage.end)
        return Utterance(
            samples=set_level(answer.samples, [(phone.start, phone.end) for phone in spoken]),
            words=time_words(phones, [trim_word(word.written) for word in words], answer.rate_hz),
            phones=to_cues(phones, answer.rate_hz),
            skipped=tuple(skipped),
            pause_s=passage.pause_s,
            done=passage.end,
        )


def find_espeak() -> tuple[EspeakVoice, ...]:
    """The voices of espeak-ng; none when the extra is not installed."""
    return _read_voices() if find_installation() else ()


def check_installed(wanted: str) -> None:
    """Nothing, unless a voice of espeak-ng is asked for, by name or language, and the extra is not installed.

    Raises:
        MienError: then.
    """
    if find_installation() is not None:
        return
    for voice in _read_voices():
        if wanted.lower() in (voice.name, *language_tags(voice)):
            raise MienError(f"{wanted!r} needs the voice {voice.name!r} of espeak-ng — try: {INSTALL}")


@cache
def _read_voices() -> tuple[EspeakVoice, ...]:
    text = resources.files(__package__).joinpath("data/voices_espeak.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    return tuple(EspeakVoice(row["name"], row["engine"], row["language"], row["description"]) for row in rows)


@cache
def _sayable() -> frozenset[str]:
    """Characters that the engine is given: Latin letters, and signs, which it names in the language that it speaks."""
    given = (chr(code) for block in (range(0x21, 0x3000), range(0x1F000, 0x1FB00)) for code in block)
    return frozenset(
        character
        for character in given
        if unicodedata.category(character)[0] in "SP"
        or (unicodedata.category(character)[0] == "N" and (character.isascii() or not character.isdecimal()))
        or unicodedata.name(character, "").startswith("LATIN")
    )


def _expand(words: Sequence[str], language: str) -> list[str]:
    """The words with abbreviations in full; what follows an ordinal in lower case, by which the engine knows it."""
    known = read_abbreviations(language)
    out: list[str] = []
    for word in words:
        stem = word.removesuffix(".")
        if "#" in known and out and out[-1].removesuffix(".").isdecimal() and out[-1].endswith("."):
            word = word.lower()
        elif stem != word and stem in known and (known[stem] or language != "en"):
            word = known[stem] or stem
        out.append(word)
    return out


def time_events(said: Said, owners: Sequence[int], language: str) -> list[TimedPhone]:
    """Phones and pauses of what the engine tells, without holes.

    Args:
        said: by the engine.
        owners: for each event of a word in it, the number of the word as written.
        language: subtag whose letters these are.
    """
    table = read_ipa_table(language, units=True)
    phones: list[TimedPhone] = []
    words = iter(owners)
    word = -1
    sounds = [event for event in said.events if not event.is_word]
    ends = iter([event.sample for event in sounds[1:]] + [len(said.samples)])
    for event in said.events:
        if event.is_word:
            word = next(words)
            continue
        end = next(ends)
        if event.letters:
            phones += _read_letters(event, end, word, table)
        elif end - event.sample >= SHORTEST_PAUSE_S * said.rate_hz:
            phones.append(TimedPhone(event.sample, end, SILENCE))
    return _add_closures(_join(phones, len(said.samples)), said.samples, said.rate_hz)


def share_joined(phones: Sequence[TimedPhone], words: Sequence[str]) -> list[TimedPhone]:
    """The phones with those that the engine tells of one word, though it says the next with it, given to both.

    It joins little words, ``of the``; each gets phones by the number of its letters, the last one at least.
    """
    heard = {phone.word for phone in phones}
    shared = list(phones)
    for first in sorted(heard - {-1}):
        joined = [first]
        for word in range(first + 1, len(words)):
            if word in heard or not words[word][:1].isalpha():
                break
            joined.append(word)
        places = [place for place, phone in enumerate(phones) if phone.word == first and phone.symbol != SILENCE]
        letters = np.cumsum([len(words[word]) for word in joined])
        for number, place in enumerate(places):
            owner = joined[int(np.searchsorted(letters, (number + 0.5) / len(places) * letters[-1]))]
            shared[place] = replace(phones[place], word=owner)
    return shared


def _read_letters(event: Event, end: int, word: int, table: Mapping[str, tuple[str, ...]]) -> Iterator[TimedPhone]:
    """Phones of what the engine takes for one, sharing its time; the first vowel carries its stress."""
    stress = next((str(digit) for mark, digit in STRESS_MARKS.items() if mark in event.letters), "0")
    phones = [phone for phone, _, _ in convert_ipa(unicodedata.normalize("NFC", event.letters), table)]
    for number, phone in enumerate(phones):
        start = event.sample + (end - event.sample) * number // len(phones)
        digit = ""
        if phone in VOWELS:
            digit, stress = stress, "0"
        yield TimedPhone(start, end, phone + digit, word)


def _join(phones: Sequence[TimedPhone], end: int) -> list[TimedPhone]:
    """The phones, each lasting until the next one begins."""
    stops = [*(phone.start for phone in phones[1:]), end]
    return [replace(phone, end=stop) for phone, stop in zip(phones, stops, strict=False)]


def _add_closures(phones: Sequence[TimedPhone], samples: NDArray[np.int16], rate_hz: int) -> list[TimedPhone]:
    """The phones with stops that begin where the sound before them falls silent."""
    moved: list[TimedPhone] = []
    for before, phone in zip([None, *phones], phones, strict=False):
        start = phone.start
        if before is not None and before.symbol != SILENCE and phone.symbol in STOPS:
            earliest = max((before.start + before.end) // 2, start - round(LONGEST_CLOSURE_S * rate_hz))
            loud = np.flatnonzero(np.abs(samples[earliest:start].astype(np.int32)) > SILENT)
            start = earliest + int(loud[-1]) + 1 if len(loud) else earliest
        moved.append(replace(phone, start=start))
    return _join(moved, len(samples))
