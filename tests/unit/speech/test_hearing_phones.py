import numpy as np
import pytest

from mien.speech.align import FoundPhone, FoundWord, PhoneRecogniser
from mien.speech.hearing_phones import LIKELY_SCORE, is_understood, put_phones
from mien.speech.hearing_sound import HEARING_HZ, Loudness
from mien.speech.hearing_words import add_stress


def word(spelling: str, phones: str, start_s: float, score: float = 20.0) -> FoundWord:
    """A word whose phones last 100 ms each."""
    spans = [(symbol, start_s + 0.1 * k) for k, symbol in enumerate(phones.split())]
    return FoundWord(spelling, tuple(FoundPhone(symbol, first, first + 0.1) for symbol, first in spans), score)


def spell(words: list[FoundWord]) -> list[str]:
    return [f"{each.spelling or '?'} {' '.join(phone.symbol for phone in each.phones)}" for each in words]


def loudness(*loud_s: tuple[float, float]) -> Loudness:
    level = np.full(300, -80.0, dtype=np.float32)
    for start_s, end_s in loud_s:
        level[round(100 * start_s) : round(100 * end_s)] = -20.0
    return Loudness(level, -20.0, -80.0, -50.0, 0.0)


HEARD = word("", "B AA T IY M", 1.0).phones


def test_likely_words_stay_and_phones_take_the_place_of_guesses() -> None:
    words = [word("hi", "HH AY", 0.5), word("guess", "G EH S", 1.0, LIKELY_SCORE + 1), word("you", "Y UW", 1.3)]
    assert spell(put_phones(words, HEARD)) == ["hi HH AY", "? B AA T", "you Y UW"]


def test_phones_after_the_last_word_are_kept_and_cut_where_it_ends() -> None:
    found = put_phones([word("to", "T UW", 1.05)], HEARD)
    assert spell(found) == ["? B", "to T UW", "? T IY M"]
    assert (found[0].end_s, found[2].start_s) == pytest.approx((1.05, 1.25))


def test_a_pause_among_phones_parts_them() -> None:
    phones = (*word("", "B AA", 1.0).phones, *word("", "M IY", 1.5).phones)
    assert spell(put_phones([], phones)) == ["? B AA", "? M IY"]


def test_guesses_and_sound_beside_words_are_not_understood() -> None:
    words = [word("hi", "HH AY", 0.5), word("you", "Y UW", 1.0)]
    assert is_understood(words, (0.0, 2.0), loudness((0.5, 0.7), (1.0, 1.2)))
    assert is_understood(words, (0.0, 2.0), loudness((0.5, 0.7), (1.0, 1.6)))
    assert not is_understood(words, (0.0, 2.0), loudness((0.5, 0.7), (1.0, 1.8)))
    assert is_understood([word("hi", "HH AY", 0.5, LIKELY_SCORE + 1)], (0.0, 2.0), loudness((0.5, 0.7)))
    assert not is_understood([word("hi", "HH AY", 0.5, LIKELY_SCORE + 1)], (0.2, 0.9), loudness((0.5, 0.7)))


def test_vowels_of_no_known_word_are_stressed() -> None:
    assert add_stress(["B", "AA", "T", "IY"], "") == ["B", "AA1", "T", "IY1"]


def test_nothing_is_heard_in_silence() -> None:
    noise = np.random.default_rng(0).normal(0.0, 3.0, HEARING_HZ).astype(np.int16)
    assert PhoneRecogniser().recognise(noise) == []
