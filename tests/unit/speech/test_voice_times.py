from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import Cue
from mien.speech.voice_times import (
    Letter,
    TimedPhone,
    find_quiet,
    fit_pauses,
    time_phones,
    time_words,
    to_cues,
)

RATE = 1000  # a sample a millisecond


def letters(text: str, step: int = 50) -> list[Letter]:
    """Letters ``step`` samples long each, words numbered from 0."""
    return [Letter(symbol, place * step, text[:place].count(" ")) for place, symbol in enumerate(text)]


def noise(*spans: tuple[int, int], length: int) -> np.ndarray:
    samples = np.zeros(length, np.int16)
    for first, last in spans:
        samples[first:last] = np.where(np.arange(last - first) % 2, 3000, -3000)
    return samples


def test_the_time_of_a_stress_mark_belongs_to_its_vowel():
    found = time_phones(letters("hˈæpi"), 250)
    assert [(phone.start, phone.end, phone.symbol) for phone in found] == [
        (0, 50, "HH"), (50, 150, "AE1"), (150, 200, "P"), (200, 250, "IY0"),
    ]  # fmt: skip


def test_the_time_of_a_space_belongs_to_the_phone_before_it():
    found = time_phones(letters("ɪz ə"), 200)
    assert [(phone.start, phone.end, phone.symbol, phone.word) for phone in found] == [
        (0, 50, "IH0", 0), (50, 150, "Z", 0), (150, 200, "AH0", 1),
    ]  # fmt: skip


def test_pairs_keep_the_stress_and_do_not_cross_words():
    assert [phone.symbol for phone in time_phones(letters("wˈɜɹd"), 250)] == ["W", "ER1", "D"]
    assert [phone.symbol for phone in time_phones(letters("ðə ɹˌOd"), 350)] == ["DH", "AH0", "R", "OW2", "D"]


def test_a_letter_of_two_phones_is_shared():
    assert time_phones(letters("ʦ"), 50) == [TimedPhone(0, 25, "T", 0), TimedPhone(25, 50, "S", 0)]


def test_a_mark_is_a_pause_until_the_sound_says_otherwise():
    found = time_phones(letters("ə, ə"), 200)
    assert [phone.symbol for phone in found] == ["AH0", "SIL", "AH0"]


def test_quiet_is_relative_to_the_utterance():
    samples = noise((0, 100), length=200)
    np.testing.assert_array_equal(find_quiet(samples, RATE), [False] * 20 + [True] * 20)
    np.testing.assert_array_equal(find_quiet(samples // 10, RATE), find_quiet(samples, RATE))


def test_pauses_lie_where_the_sound_is_silent():
    marked = [TimedPhone(100, 200, "AH0", 0), TimedPhone(200, 250, "SIL"), TimedPhone(250, 400, "AH0", 1)]
    found = fit_pauses(marked, noise((80, 180), (300, 380), length=500), RATE)
    assert [(phone.start, phone.end, phone.symbol) for phone in found] == [
        (0, 80, "SIL"), (80, 180, "AH0"), (180, 300, "SIL"), (300, 380, "AH0"), (380, 500, "SIL"),
    ]  # fmt: skip


def test_a_comma_that_nobody_hears_is_no_pause():
    marked = [TimedPhone(0, 200, "AH0", 0), TimedPhone(200, 250, "SIL"), TimedPhone(250, 500, "AH0", 1)]
    found = fit_pauses(marked, noise((0, 500), length=500), RATE)
    assert [(phone.start, phone.end, phone.symbol) for phone in found] == [(0, 250, "AH0"), (250, 500, "AH0")]


def test_a_stop_after_a_pause_keeps_its_closure():
    marked = [TimedPhone(0, 200, "AH0", 0), TimedPhone(200, 250, "SIL"), TimedPhone(250, 500, "P", 1)]
    found = fit_pauses(marked, noise((0, 150), (350, 500), length=500), RATE)
    assert [(phone.start, phone.end, phone.symbol) for phone in found] == [
        (0, 150, "AH0"), (150, 290, "SIL"), (290, 500, "P"),
    ]  # fmt: skip


def test_a_voice_that_says_nothing_is_all_pause():
    assert fit_pauses([], np.zeros(100, np.int16), RATE) == [TimedPhone(0, 100, "SIL")]


@settings(deadline=None, max_examples=100)
@given(
    text=st.text("ˈəpmɜɹz ,.", min_size=1, max_size=30),
    steps=st.lists(st.integers(0, 60), min_size=30, max_size=30),
    seed=st.integers(0, 5),
)
def test_phones_cover_the_sound_without_holes(text: str, steps: list[int], seed: int):
    edges = np.cumsum([0, *steps])
    marks = [Letter(symbol, int(edges[place]), 0) for place, symbol in enumerate(text)]
    length = int(edges[len(text)]) + 1000
    samples = np.random.default_rng(seed).integers(-3000, 3000, length).astype(np.int16)
    found = fit_pauses(time_phones(marks, int(edges[len(text)])), samples, RATE)
    assert found[0].start == 0
    assert found[-1].end == length
    assert all(before.end == after.start for before, after in itertools.pairwise(found))
    assert all(phone.end > phone.start for phone in found)


def test_words_last_from_their_first_phone_to_their_last():
    phones = [TimedPhone(0, 100, "SIL"), TimedPhone(100, 200, "AH0", 0), TimedPhone(200, 300, "B", 2)]
    assert time_words(phones, ["a", "🙂", "b"], RATE) == (Cue(0.1, 0.2, "a"), Cue(0.2, 0.3, "b"))
    assert to_cues(phones, RATE)[1] == Cue(0.1, 0.2, "AH0")
    assert to_cues(phones, RATE)[2].length_s == pytest.approx(0.1)
