"""Words and phones found in sound by PocketSphinx, American English: aligned with a text, or recognised without one.

Its model, dictionary and language model lie in its wheel (ADR 0015).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.core import SILENCE, MienError

from .hearing_edges import Span, sharpen
from .hearing_sound import FRAME_S
from .phones import PHONES

FRAME_CENTRE_S = 0.008
"""From the time of a frame's number to the boundary before it.

A frame is the sound of 25.6 ms, so frames 0 and 1 meet at 12.8 - 5 = 7.8 ms. Measured: ADR 0015.
"""

SEARCH: Mapping[str, Any] = {
    "loglevel": "FATAL",
    "bestpath": False,  # with it the pass that finds the phones fails now and then
    "topn": 2,
}
"""Options of every search. Two of the nearest densities are added up, not four: a third less work, same boundaries."""

ALIGNMENT: Mapping[str, Any] = {"lm": None, "beam": 1e-120, "pbeam": 1e-120, "wbeam": 1e-80}
"""Options of the search for given words: nothing is given up, which in a chain of words costs little."""

RECOGNITION: Mapping[str, Any] = {"fwdflat": False, "maxhmmpf": 1500}
"""Options of the search without a text: one pass, and no more than so many models at a time."""

PHONES_ALONE: Mapping[str, Any] = {"lm": None, "lw": 2.0, "pip": 0.3, "beam": 1e-20, "pbeam": 1e-20}
"""Options of the search for phones without words. Source: CMUSphinx, Phoneme Recognition."""

_VARIANT = re.compile(r"\(\d+\)$")
_FILLERS = frozenset(["<s>", "</s>", "<sil>", "[NOISE]", "[SPEECH]", "(NULL)"])


@dataclass(frozen=True)
class FoundPhone:
    """A phone without stress from one time to another, seconds from the beginning of the samples."""

    symbol: str
    start_s: float
    end_s: float

    def later(self, by_s: float) -> FoundPhone:
        """The same phone that many seconds later."""
        return FoundPhone(self.symbol, self.start_s + by_s, self.end_s + by_s)


@dataclass(frozen=True)
class FoundWord:
    """A word that was found.

    Attributes:
        spelling: in the dictionary.
        phones: in order, without holes.
        score: how much worse than the best of all sounds it fits, a hundredth of a second on average; 0 is perfect.
    """

    spelling: str
    phones: tuple[FoundPhone, ...]
    score: float

    @property
    def start_s(self) -> float:
        """Where it begins, seconds."""
        return self.phones[0].start_s

    @property
    def end_s(self) -> float:
        """Where it ends, seconds."""
        return self.phones[-1].end_s

    def later(self, by_s: float) -> FoundWord:
        """The same word that many seconds later."""
        return FoundWord(self.spelling, tuple(phone.later(by_s) for phone in self.phones), self.score)


class Aligner:
    """Finds given words in samples at ``HEARING_HZ``."""

    def __init__(self) -> None:
        self._decoder = _load(ALIGNMENT)

    def lookup(self, spelling: str) -> tuple[str, ...] | None:
        """Phones of a word; None for one that the dictionary does not have."""
        return _lookup(self._decoder, spelling)

    def learn(self, words: Mapping[str, Sequence[str]]) -> None:
        """Words added to the dictionary, with their phones."""
        for spelling, phones in words.items():
            if self.lookup(spelling) is None:
                self._decoder.add_word(spelling, " ".join(phones), False)

    def align(
        self, samples: NDArray[np.int16], words: Sequence[Sequence[str]], *, open_end: bool = False
    ) -> list[FoundWord] | None:
        """The words where they are heard; None when the samples do not hold them.

        Args:
            samples: (N,).
            words: in order, each with the spellings that it may be heard as.
            open_end: whether the samples may end after any of the words.
        """
        self._decoder.add_fsg("words", self._build_grammar(words, open_end))
        self._decoder.activate_search("words")
        return _search(self._decoder, samples)

    def _build_grammar(self, words: Sequence[Sequence[str]], open_end: bool) -> Any:
        """A chain of states, one more than words; the last is the end, to which every word leads where it is open.

        A word leads there itself, because the second pass fails at transitions without one.
        """
        from pocketsphinx import FsgModel

        end = len(words)
        grammar = FsgModel("words", self._decoder.get_logmath(), 1.0, end + 1)
        for place, spellings in enumerate(words):
            for spelling in spellings:
                number = grammar.word_id(spelling)
                number = grammar.word_add(spelling) if number < 0 else number
                for state in {place + 1, end} if open_end else {place + 1}:
                    grammar.trans_add(place, state, 0, number)
        grammar.set_start_state(0)
        grammar.set_final_state(end)
        return grammar


class Recogniser:
    """Finds the words in samples at ``HEARING_HZ`` without being told them."""

    def __init__(self) -> None:
        self._decoder = _load(RECOGNITION)

    def recognise(self, samples: NDArray[np.int16]) -> list[FoundWord]:
        """The words that are heard; none in noise, music or silence."""
        self._decoder.activate_search()
        return _search(self._decoder, samples) or []


class PhoneRecogniser:
    """Finds phones in samples at ``HEARING_HZ`` by the order that phones of English have, without knowing words."""

    def __init__(self) -> None:
        from pocketsphinx import get_model_path

        self._decoder = _load({**PHONES_ALONE, "allphone": get_model_path("en-us/en-us-phone.lm.bin")})

    def recognise(self, samples: NDArray[np.int16]) -> list[FoundPhone]:
        """The phones that are heard, in order of time, with holes where a pause or a noise is."""
        _feed(self._decoder, samples)
        return [
            FoundPhone(each.word, each.start_frame * FRAME_S, (each.end_frame + 1) * FRAME_S).later(FRAME_CENTRE_S)
            for each in self._decoder.seg() or ()
            if each.word in PHONES and each.word != SILENCE
        ]


def _load(options: Mapping[str, Any]) -> Any:
    try:
        from pocketsphinx import Decoder
    except ImportError:
        raise MienError(
            "sound cannot be listened to without pocketsphinx — try: pip install 'pocketsphinx>=5'"
        ) from None
    return Decoder(**{**SEARCH, **options})


def _lookup(decoder: Any, spelling: str) -> tuple[str, ...] | None:
    phones = decoder.lookup_word(spelling)
    return tuple(phones.split()) if phones else None


def _feed(decoder: Any, samples: NDArray[np.int16]) -> None:
    decoder.start_utt()
    decoder.process_raw(samples.astype("<i2").tobytes(), full_utt=True)
    decoder.end_utt()


def _search(decoder: Any, samples: NDArray[np.int16]) -> list[FoundWord] | None:
    """The words that the decoder's search finds, with their phones; None when it finds nothing."""
    _feed(decoder, samples)
    if decoder.hyp() is None:
        return None
    # A second pass, over the words of the first; to ask it for a hypothesis would crash.
    decoder.set_alignment()
    _feed(decoder, samples)
    # The entries are not to be kept: each is gone when the next one is asked for.
    words: list[tuple[str, int, float]] = []
    spans: list[Span] = []
    for entry in decoder.get_alignment().words():
        if entry.duration <= 0:
            continue
        spelling, score = "" if entry.name in _FILLERS else _VARIANT.sub("", entry.name), -entry.score / entry.duration
        parts = [_to_span(phone.name, phone) for phone in entry] if spelling else [_to_span(SILENCE, entry)]
        words.append((spelling, len(parts), score))
        spans += parts
    phones = iter([FoundPhone(*span) for span in sharpen(spans, samples)])
    found = [(spelling, tuple(islice(phones, count)), score) for spelling, count, score in words]
    return [FoundWord(*word) for word in found if word[0]]


def _to_span(symbol: str, entry: Any) -> Span:
    return symbol, _edge_s(entry.start), _edge_s(entry.start + entry.duration)


def _edge_s(frame: int) -> float:
    """Where a frame begins to be more of what is heard than the one before it, seconds."""
    return frame * FRAME_S + FRAME_CENTRE_S if frame else 0.0
