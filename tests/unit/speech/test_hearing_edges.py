"""Boundaries moved to where the sound changes."""

from __future__ import annotations

import numpy as np
import pytest

from mien.speech.hearing_edges import GLIDE_TO_VOWEL_S, REACH_S, sharpen
from mien.speech.hearing_sound import HEARING_HZ

LENGTH_S = 0.6


def buzz(length_s: float, pitch_hz: float) -> np.ndarray:
    """A sine with a little noise, as loud as speech."""
    time = np.arange(round(length_s * HEARING_HZ)) / HEARING_HZ
    return 4000 * np.sin(2 * np.pi * pitch_hz * time)


def hiss(length_s: float) -> np.ndarray:
    white = np.random.default_rng(2).normal(0, 4000, round(length_s * HEARING_HZ))
    return np.diff(white, prepend=0.0)


def silence(length_s: float) -> np.ndarray:
    return np.random.default_rng(3).normal(0, 3, round(length_s * HEARING_HZ))


def samples(*parts: np.ndarray) -> np.ndarray:
    return np.clip(np.concatenate(parts), -32768, 32767).astype(np.int16)


def edge(before: str, after: str, at_s: float, sound: np.ndarray) -> float:
    spans = sharpen([(before, 0.0, at_s), (after, at_s, LENGTH_S)], sound)
    assert [span[0] for span in spans] == [before, after]
    assert spans[0][2] == spans[1][1]
    return spans[0][2]


@pytest.mark.parametrize("off_s", [-0.012, -0.004, 0.0, 0.007, 0.012])
def test_a_hiss_begins_where_it_is_heard(off_s: float):
    sound = samples(buzz(0.3, 400), hiss(0.3))
    assert edge("AA", "S", 0.3 + off_s, sound) == pytest.approx(0.3, abs=0.0031)


def test_a_closure_begins_where_the_voice_ends():
    sound = samples(buzz(0.25, 300), silence(0.35))
    assert edge("IY", "T", 0.258, sound) == pytest.approx(0.25, abs=0.0045)


def test_a_boundary_moves_no_farther_than_the_search_errs():
    sound = samples(buzz(0.2, 400), hiss(0.4))
    assert abs(edge("AA", "S", 0.3, sound) - 0.3) <= REACH_S


def test_a_pause_begins_when_all_is_quiet():
    sound = samples(buzz(0.2, 400), silence(0.4))
    assert edge("AA", "SIL", 0.26, sound) == pytest.approx(0.2, abs=0.006)


def test_a_phone_after_a_pause_begins_when_it_is_heard():
    sound = samples(silence(0.2), buzz(0.4, 400))
    assert edge("SIL", "M", 0.23, sound) == pytest.approx(0.2, abs=0.006)
    assert edge("SIL", "M", 0.17, sound) == pytest.approx(0.2, abs=0.006)


def test_the_closure_of_a_stop_after_a_pause_cannot_be_heard():
    sound = samples(silence(0.2), buzz(0.4, 400))
    assert edge("SIL", "B", 0.16, sound) == 0.16


def test_glides_move_by_what_people_draw():
    sound = samples(buzz(0.3, 400), hiss(0.3))
    assert edge("L", "AA", 0.31, sound) == pytest.approx(0.31 + GLIDE_TO_VOWEL_S)


def test_every_phone_keeps_its_place():
    sound = samples(buzz(0.3, 400), hiss(0.3))
    spans = [("AA", 0.0, 0.27), ("P", 0.27, 0.30), ("T", 0.30, 0.33), ("S", 0.33, LENGTH_S)]
    found = sharpen(spans, sound)
    assert [span[0] for span in found] == ["AA", "P", "T", "S"]
    assert min(end - start for _, start, end in found) >= 0.0099
    assert (found[0][1], found[-1][2]) == (0.0, LENGTH_S)


def test_nothing_and_one_phone_stay():
    assert sharpen([], samples(silence(0.1))) == []
    assert sharpen([("SIL", 0.0, 0.1)], samples(silence(0.1))) == [("SIL", 0.0, 0.1)]
