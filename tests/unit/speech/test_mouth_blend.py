import math

import numpy as np
import pytest
from mouth_cases import cues

from mien.speech.articulation import USUAL, Articulation
from mien.speech.mouth_blend import blend
from mien.speech.mouth_gestures import SHORT_SHARE, gestures
from mien.speech.mouth_table import BLENDED

JAW, ROUND, SPREAD = (BLENDED.index(channel) for channel in ("jaw", "round", "spread"))


def at(text: str, time_s: float) -> np.ndarray:
    return blend(gestures(cues(text), Articulation(rounding=0)), np.array([time_s]))[0]


def test_one_phone_alone_has_its_target_everywhere() -> None:
    assert at("AA1:80", 0.04)[JAW] == pytest.approx(0.80)
    assert at("AA1:80", 0.3)[JAW] == pytest.approx(0.80)


def test_two_phones_mix_by_cohen_and_massaros_formula() -> None:
    # Both 80 ms, so without a core: centres 40 and 120 ms. Lips, at 80 ms: AA (24, 20 1/s, dominance 0.8, round 0.05)
    # lies 40 ms behind, UW (early 12 1/s, dominance 1.6, round 0.95) 40 ms ahead; the peaks are rounded by 15 ms.
    distance = math.sqrt(0.04**2 + 0.015**2) - 0.015
    behind, ahead = 0.8 * math.exp(-20.0 * distance), 1.6 * math.exp(-12.0 * distance)
    want = (behind * 0.05 + ahead * 0.95) / (behind + ahead)
    assert at("AA1:80 UW1:80", 0.08)[ROUND] == pytest.approx(want, rel=1e-12)


def test_stress_opens_a_vowel_and_leaves_its_rounding() -> None:
    stressed, unstressed = at("OW1:80", 0.04), at("OW0:80", 0.04)
    assert unstressed[JAW] == pytest.approx(0.62 * stressed[JAW])
    assert unstressed[ROUND] == stressed[ROUND]


def test_short_stops_and_nasals_leave_the_jaw_alone_and_sibilants_do_not() -> None:
    short = gestures(cues("T:99 N:60 S:60 T:100"), USUAL)
    assert short.dominance[0, 0] == pytest.approx(SHORT_SHARE)
    assert short.dominance[1, 0] == pytest.approx(SHORT_SHARE)
    assert short.dominance[2, 0] == 4.0
    assert short.dominance[3, 0] == 1.0


def test_rounding_passes_through_tongue_sounds_to_the_vowel() -> None:
    # Daniloff and Moll: rounding for u begins during the consonants before it.
    assert at("SIL:300 T:60 N:60 UW1:100", 0.36)[ROUND] > 0.5
    assert at("SIL:300 T:60 N:60 IY1:100", 0.36)[ROUND] < 0.02


def test_times_can_be_cut_in_pieces() -> None:
    sounds = gestures(cues("SIL:200 " + "S:90 T:50 OW1:150 N:80 " * 20), USUAL)
    times = np.arange(0.0, 7.0, 0.01)
    whole = blend(sounds, times)
    pieces = np.concatenate([blend(sounds, times[:333]), blend(sounds, times[333:])])
    np.testing.assert_array_equal(whole, pieces)
