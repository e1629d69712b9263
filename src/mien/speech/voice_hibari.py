"""The built-in voice: hibari, American English, its model and pronunciation rules inside the ``hibari-tts`` wheel.

hibari is never asked to load a voice itself, because it would download one that is absent.
"""

from __future__ import annotations

import json
import re
import threading
import unicodedata
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec, module_from_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.core import SILENCE, MienError

from .text import Passage, SpokenWord, match_words, must_sound, prepare_word, split_passages, split_words, trim_word
from .voice import Utterance
from .voice_hibari_model import HIBARI_VERSION, check_version, open_model
from .voice_level import PEAK_LEVEL, set_level
from .voice_times import PAUSE_MARKS, Letter, fit_pauses, time_phones, time_words, to_cues

RATE_HZ = 24000
COUNT_SAMPLES = 600
"""Samples (25 ms) that one count of a duration stands for."""

LATE_SAMPLES = 1440
"""Samples (60 ms) by which the durations lag behind the sound.

Measured on 12 sentences, 368 phones: median 60 ms against a forced alignment by pocketsphinx, 62 ms against the
steepest change of energy where a vowel meets a consonant. With it, the cues of 16 sentences, 494 phones, begin 15 ms
from the alignment's (median), 96 % of them within 50 ms; the durations themselves come in steps of 25 ms.
"""

LONGEST_NUMBER = 15
"""Digits of a number; a longer one is read digit by digit."""

LONGEST_GUESS = 20
"""Letters of a word that the pronunciation network reads well; it silently drops what comes after 24."""

MOST_LETTERS = 400
"""Letters of its alphabet that the model was made to say at once."""


def find_hibari() -> HibariVoice | None:
    """The built-in voice; None when hibari or onnxruntime is not installed."""
    return HibariVoice() if find_spec("hibari") and find_spec("onnxruntime") else None


@dataclass(frozen=True)
class HibariVoice:
    """The voice ``heart`` of hibari, a woman."""

    name: str = "hibari"
    language: str = "en-US"
    description: str = "hibari, American English, a woman"
    rate_hz: int = RATE_HZ

    def utterances(self, text: str) -> Iterator[Utterance]:
        """The text said a sentence or line at a time."""
        engine = load_engine()
        for passage in split_passages(text):
            yield from engine.say(passage)


@dataclass(frozen=True)
class Wording:
    """The words of a passage as written, those that are said for them, and for each of these whose it is."""

    written: tuple[SpokenWord, ...]
    spoken: tuple[str, ...]
    owners: tuple[int, ...]


@dataclass(frozen=True)
class _Reading:
    """Letters of the model's alphabet for a passage, which word each belongs to, and what has no letters."""

    letters: str
    owners: tuple[int, ...]
    words: tuple[str, ...]
    skipped: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Engine:
    """hibari's parts, loaded: pronunciation, model and the maker of waves."""

    pronounce: Any
    normalize: Any
    session: Any
    synthesize: Any
    numbers: dict[str, int]
    sayable: frozenset[str]
    knows: Callable[[str], bool]

    def say(self, passage: Passage) -> Iterator[Utterance]:
        """A passage said, in as many utterances as its length asks for; one without sound when nothing can be said."""
        reading = self.read(passage)
        pieces = list(_split_letters(reading.letters, MOST_LETTERS))
        nothing = Utterance(np.zeros(0, np.int16), (), (), reading.skipped, 0.0, passage.end)
        if not pieces:
            yield nothing
        for number, (first, last) in enumerate(pieces, 1):
            letters, owners = reading.letters[first:last], reading.owners[first:last]
            samples, starts, end = self.sing(letters)
            marks = [
                Letter(letter, start, -1 if letter in PAUSE_MARKS else owner)
                for letter, start, owner in zip(letters, starts, owners, strict=True)
            ]
            phones = fit_pauses(time_phones(marks, end), samples, RATE_HZ)
            yield Utterance(
                samples=set_level(samples, [(phone.start, phone.end) for phone in phones if phone.symbol != SILENCE]),
                words=time_words(phones, reading.words, RATE_HZ),
                phones=to_cues(phones, RATE_HZ),
                skipped=reading.skipped if number == 1 else (),
                pause_s=passage.pause_s if number == len(pieces) else 0.0,
                done=passage.end,
            )

    def read(self, passage: Passage) -> _Reading:
        """How a passage is pronounced."""
        wording = self.word(passage)
        prepared, rewritten, places = wording.written, wording.spoken, wording.owners
        skipped = [run for word in prepared for run in word.skipped]
        readings = self.pronounce_words(rewritten)
        letters, letter_owners, heard = "", [], set[int]()
        for owner, reading in zip(places, readings, strict=True):
            kept = "".join(letter for letter in reading if letter in self.numbers)
            if any(letter not in PAUSE_MARKS and letter != " " for letter in kept):
                heard.add(owner)
            letters += kept + " "
            letter_owners += [owner] * (len(kept) + 1)
        for place, word in enumerate(prepared):
            if place not in heard and word.spoken and any(must_sound(part) for part in word.spoken):
                skipped.append(word.written)
        if not heard:
            return _Reading("", (), (), tuple(skipped))
        letters, letter_owners = letters[:-1], letter_owners[:-1]
        if passage.goes_on and letters[-1] not in PAUSE_MARKS:
            letters, letter_owners = letters + ",", [*letter_owners, letter_owners[-1]]
        return _Reading(
            letters, tuple(letter_owners), tuple(trim_word(word.written) for word in prepared), tuple(skipped)
        )

    def word(self, passage: Passage) -> Wording:
        """The words that are said for a passage: numbers, signs and abbreviations in full."""
        prepared = [prepare_word(word, self.sayable) for word in split_words(passage.text)]
        said = [(place, part) for place, word in enumerate(prepared) for part in word.spoken]
        owners = [place for place, _ in said]
        rewritten = self.normalize(_tame(" ".join(part for _, part in said), self.knows)).split()
        places = [owners[place] for place in match_words([part for _, part in said], rewritten)] if said else []
        return Wording(tuple(prepared), tuple(rewritten), tuple(places))

    def pronounce_words(self, words: Sequence[str]) -> list[str]:
        """Letters of each word, read in context; where hibari stumbles over them together, each word alone."""
        # hibari has no error of its own: odd numbers and marks end in whatever its tables raise.
        stumbles = (LookupError, ValueError, TypeError, AttributeError, ArithmeticError, StopIteration, RuntimeError)
        try:
            found = _split_readings(self.pronounce, words)
        except stumbles:
            found = []
        if len(found) == len(words):
            return found
        alone: list[str] = []
        for word in words:
            try:
                alone.append(" ".join(_split_readings(self.pronounce, [word])))
            except stumbles:
                alone.append("")
        return alone

    def sing(self, letters: str) -> tuple[NDArray[np.int16], list[int], int]:
        """Samples, not yet at their level, the sample where each letter begins, and the one where the last ends."""
        numbers = np.array([[0, *(self.numbers[letter] for letter in letters), 0]], dtype=np.int64)
        *spectrum, counts = self.session.run(None, {"ids": numbers, "speed": np.ones(1, np.float32)})
        wave = self.synthesize(*(part[0] for part in spectrum), np.random.default_rng(0))
        edges = np.rint(np.cumsum(counts.ravel().astype(np.float64)) * COUNT_SAMPLES).astype(np.int64) - LATE_SAMPLES
        peak = float(np.abs(wave).max()) or 1.0
        samples = np.rint(wave * (PEAK_LEVEL / peak)).astype(np.int16)
        starts = np.clip(edges, 0, len(samples)).tolist()
        return samples, starts[:-2], starts[-2]


def _split_readings(pronounce: Any, words: Sequence[str]) -> list[str]:
    """Letters of each word of a sentence."""
    readings = [""]
    for token in pronounce.phonemize_tokens(pronounce.tokenize(" ".join(words))):
        readings[-1] += token.phonemes or ""
        if token.whitespace:
            readings.append("")
    return readings


def _tame(text: str, knows: Callable[[str], bool]) -> str:
    """Text without what hibari would misread or drop: links, money behind the number, endless numbers and words."""
    text = text.translate({ord("["): "(", ord("]"): ")"})
    text = re.sub(r"(?<=\d)½", " and a half", text)
    text = re.sub(r"\bno\.(?!\s*\d)", "No.", text)  # of which hibari would make a number
    text = re.sub(r"(?<![$£€¥\d.,])(\d[\d.,]*)\s?([$£€¥])(?!\s?\d)", r"\2\1", text)
    text = re.sub(rf"\d[\d,]{{{LONGEST_NUMBER},}}", lambda match: " ".join(match.group().replace(",", "")), text)
    return re.sub(rf"[^\W\d_]{{{LONGEST_GUESS + 1},}}", lambda match: _split_word(match.group(), knows), text)


def _split_word(word: str, knows: Callable[[str], bool]) -> str:
    """A word that is too long to guess, in parts that are not; cut before a consonant that follows a vowel."""
    if knows(word) or knows(word.removesuffix("s")):
        return word
    parts: list[str] = []
    while len(word) > LONGEST_GUESS:
        cuts = [
            place
            for place in range(LONGEST_GUESS // 2, LONGEST_GUESS + 1)
            if word[place - 1].lower() in "aeiouy" and word[place].lower() not in "aeiouy"
        ]
        cut = cuts[-1] if cuts else LONGEST_GUESS
        parts.append(word[:cut])
        word = word[cut:]
    return " ".join([*parts, word])


def _split_letters(letters: str, most: int) -> Iterator[tuple[int, int]]:
    """Places of pieces of at most ``most`` letters, cut after a pause mark, else after a space."""
    first = 0
    while len(letters) - first > most:
        window = letters[first : first + most]
        marks = [place + 1 for place, letter in enumerate(window) if letter in PAUSE_MARKS and place > most // 3]
        space = window.rfind(" ") + 1
        cut = marks[-1] if marks else space or most
        if any(letter not in PAUSE_MARKS and letter != " " for letter in window[:cut]):
            yield first, first + cut
        first += cut
    if any(letter not in PAUSE_MARKS and letter != " " for letter in letters[first:]):
        yield first, len(letters)


_LOADING = threading.Lock()


def load_engine() -> Engine:
    """hibari, ready to speak; loaded once.

    Raises:
        MienError: when hibari is absent, of another version, or its model has no durations.
    """
    with _LOADING:
        return _load_engine()


@cache
def _load_engine() -> Engine:
    check_version()
    import hibari
    from hibari.g2p import G2P
    from hibari.g2p.normalize import normalize

    assets = Path(hibari.__file__).parent / "assets"
    numbers = json.loads((assets / "vocab.json").read_text(encoding="utf-8"))
    pronounce = G2P()
    golds, silvers = pronounce.lexicon.golds, pronounce.lexicon.silvers
    return Engine(
        pronounce=pronounce,
        normalize=normalize,
        session=open_model((assets / "hibari.onnx").read_bytes()),
        synthesize=_load_synthesis().synth,
        numbers=numbers,
        sayable=_read_sayable(assets),
        knows=lambda word: word.lower() in golds or word.lower() in silvers,
    )


def _load_synthesis() -> Any:
    """Our own copy of the module ``hibari.dsp``, whose Fourier transforms are NumPy's.

    hibari takes SciPy's when it is installed, and then the same text has other samples.
    """
    spec = find_spec("hibari.dsp")
    if spec is None or spec.loader is None:
        raise MienError(f"voice 'hibari': want the module hibari.dsp of hibari-tts {HIBARI_VERSION}, got none")
    module: Any = module_from_spec(spec)
    spec.loader.exec_module(module)
    module.rfft = lambda signal, axis: np.fft.rfft(signal, axis=axis).astype(np.complex64)
    module.irfft = lambda spectrum, n, axis: np.fft.irfft(spectrum, n=n, axis=axis).astype(np.float32)
    return module


def _read_sayable(assets: Path) -> frozenset[str]:
    """Characters hibari has a reading for: the Latin letters its network was trained on, digits, signs it names."""
    network = json.loads((assets / "oov.json").read_text(encoding="utf-8"))["in"]
    tables = json.loads((assets / "normalize.json").read_text(encoding="utf-8"))
    letters = {letter for letter in network if letter.isalpha() and unicodedata.name(letter).startswith("LATIN")}
    signs = {sign for sign, words in tables["symbols"].items() if words.strip()} | {"µ"}
    money = {sign for sign in tables["currency"] if len(sign) == 1}
    ascii_marks = {chr(code) for code in range(33, 127)}
    return frozenset(letters | signs | money | ascii_marks | set("—–…“”‘’"))
