from collections.abc import Sequence

import numpy as np
import pytest
from numpy.typing import NDArray

from mien.core import MienError, Sound
from mien.speech.align import FoundPhone, FoundWord
from mien.speech.hearing_follow import Follower, find_unexplained_s
from mien.speech.hearing_sound import HEARING_HZ, measure_loudness
from mien.speech.hearing_words import Token

TOKENS = tuple(Token((spelling,), spelling, place) for place, spelling in enumerate(["one", "two", "three"]))


def said(*spans: tuple[float, float]) -> Sound:
    """A second and more of faint hiss with tones."""
    samples = np.random.default_rng(0).normal(0.0, 5.0, 4 * HEARING_HZ)
    for start_s, end_s in spans:
        part = slice(round(start_s * HEARING_HZ), round(end_s * HEARING_HZ))
        samples[part] += 8000.0 * np.sin(np.arange(part.stop - part.start) / 5.0)
    return Sound(np.rint(samples).astype(np.int16), HEARING_HZ)


def words(spellings: str, score: float, start_s: float = 0.5) -> list[FoundWord]:
    """Words that last 300 ms each."""
    return [
        FoundWord(spelling, (FoundPhone("AA", start_s + 0.3 * k, start_s + 0.3 * (k + 1)),), score)
        for k, spelling in enumerate(spellings.split())
    ]


class Finds:
    """An aligner and a recogniser that find what they were told, one answer after the other."""

    def __init__(self, *answers: list[FoundWord] | None) -> None:
        self.answers = list(answers)
        self.asked: list[list[Sequence[str]]] = []

    def align(
        self, samples: NDArray[np.int16], chain: Sequence[Sequence[str]], *, open_end: bool = False
    ) -> list[FoundWord] | None:
        self.asked.append(list(chain))
        return self.answers.pop(0)

    def recognise(self, samples: NDArray[np.int16]) -> list[FoundWord]:
        return self.answers.pop(0) or []


def follow(sound: Sound, aligner: Finds, recogniser: Finds, monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, int]]:
    monkeypatch.setattr("mien.speech.hearing_follow.Recogniser", lambda: recogniser)
    follower = Follower(sound, measure_loudness(sound), aligner, TOKENS)  # type: ignore[arg-type]
    return [(heard.word.spelling, -1 if heard.place is None else heard.place) for heard in follower.follow(print)]


def test_a_strange_voice_is_followed_where_its_text_fits_better_than_any_other(monkeypatch) -> None:
    aligner, recogniser = Finds(words("one two three", 60.0)), Finds(words("won too tree", 61.0))
    assert follow(said((0.5, 1.75)), aligner, recogniser, monkeypatch) == [("one", 0), ("two", 1), ("three", 2)]


def test_another_text_is_refused_where_other_words_fit_better(monkeypatch) -> None:
    aligner, recogniser = Finds(words("one two three", 60.0)), Finds(words("my old hat", 59.0))
    with pytest.raises(MienError, match="my old hat"):
        follow(said((0.5, 1.75)), aligner, recogniser, monkeypatch)


def test_words_after_too_early_an_end_are_looked_for_from_the_last_word_on(monkeypatch) -> None:
    sound = said((0.5, 2.0))
    aligner = Finds(words("one two", 10.0), words("two three", 10.0, 0.2))
    assert follow(sound, aligner, Finds(), monkeypatch) == [("one", 0), ("two", 1), ("three", 2)]
    assert aligner.asked[1][0] == ("two",)


def test_sound_beside_words_is_measured_before_each_and_after_the_last() -> None:
    sound = said((0.4, 1.1), (2.0, 2.5))
    gaps = find_unexplained_s(words("one two", 10.0), (0.0, 4.0), measure_loudness(sound))
    assert gaps == pytest.approx([0.1, 0.0, 0.5], abs=0.025)
