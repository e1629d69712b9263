"""Each pass over gestures by itself: off it changes nothing, and on what is worked out by hand."""

from dataclasses import fields

import numpy as np
import pytest
from mouth_cases import cues

from mien.speech import mouth_gestures as passes
from mien.speech.articulation import USUAL, Articulation, amounts
from mien.speech.mouth_gestures import PASSES, Gestures, from_table, gestures
from mien.speech.mouth_table import BLENDED, phone_table

JAW, LIPS = 0, 1
ROUND = BLENDED.index("round")
PHONES = "SIL:200 AY1:60 AY1+:40 T:60 AE0:90 W:50 UW1:90 S:80 AA1:200 N:120 SIL:300"


def same(one: Gestures, other: Gestures) -> bool:
    return all(
        np.allclose(getattr(one, each.name), getattr(other, each.name), rtol=0.0, atol=1e-15)
        for each in fields(Gestures)
        if each.name != "rows"
    )


@pytest.fixture
def sounds() -> Gestures:
    return from_table(cues(PHONES))


@pytest.mark.parametrize("name", ["stress", "brief", "anticipation", "lag", "rounding"])
def test_a_pass_that_is_off_changes_nothing(name: str, sounds: Gestures) -> None:
    assert same(PASSES[name](sounds, 0.0), sounds)


@pytest.mark.parametrize("name", ["targets", "diphthongs", "dominance"])
def test_a_usual_amount_leaves_what_the_table_says(name: str, sounds: Gestures) -> None:
    assert same(PASSES[name](sounds, 1.0), sounds)


@pytest.mark.parametrize("name", PASSES)
def test_every_pass_keeps_targets_shares_and_the_rest_positive(name: str, sounds: Gestures) -> None:
    for amount in (0.0, 0.5, 1.0, amounts()[name].high):
        shaped = PASSES[name](sounds, amount)
        assert shaped.rows == sounds.rows
        assert np.all((shaped.targets >= 0.0) & (shaped.targets <= 1.0))
        assert np.all(shaped.dominance >= 0.0)
        assert np.all(shaped.rates > 0.0)
        assert np.all(shaped.half_core_s >= 0.0)


def test_all_passes_are_amounts_of_the_table() -> None:
    assert set(PASSES) <= set(amounts())


def test_without_targets_vowels_have_one_shape_and_consonants_another(sounds: Gestures) -> None:
    shaped = passes.tell_apart(sounds, 0.0)
    vowel = [row.is_vowel for row in sounds.rows]
    consonant = [not row.is_vowel and row.kind != "pause" for row in sounds.rows]
    assert np.ptp(shaped.targets[vowel], axis=0).max() < 1e-12
    assert np.ptp(shaped.targets[consonant], axis=0).max() < 1e-12
    rows = [row for row in phone_table().rows if row.is_vowel]
    assert shaped.targets[1, 0] == pytest.approx(sum(row.targets[0] for row in rows) / len(rows))


def test_the_second_part_of_a_diphthong_goes_as_far_as_asked(sounds: Gestures) -> None:
    first, second = (phone_table()[name].targets[0] for name in ("AY", "AY+"))
    for amount in (0.0, 0.5, 1.0, 1.5):
        glided = passes.glide(sounds, amount).targets
        assert glided[2, 0] == pytest.approx(first + amount * (second - first))
        assert glided[1, 0] == first


def test_stress_scales_the_opening_of_weak_vowels_alone(sounds: Gestures) -> None:
    usual, twice = (passes.weaken_unstressed(sounds, amount).targets for amount in (1.0, 2.0))
    assert usual[4, 0] == pytest.approx(0.62 * sounds.targets[4, 0])
    assert twice[4, 0] == pytest.approx(0.24 * sounds.targets[4, 0])
    assert usual[4, BLENDED.index("spread")] == sounds.targets[4, BLENDED.index("spread")]
    for number in (1, 3, 5, 8, 9):
        assert np.array_equal(usual[number], sounds.targets[number])


def test_brief_consonants_lose_the_jaw_and_nothing_else(sounds: Gestures) -> None:
    shaped = passes.spare_jaw(sounds, 1.0).dominance
    assert shaped[3, JAW] == pytest.approx(0.15 * sounds.dominance[3, JAW])
    assert shaped[7, JAW] == sounds.dominance[7, JAW], "a sibilant keeps its narrow jaw"
    assert shaped[9, JAW] == sounds.dominance[9, JAW], "an n of 120 ms is not brief"
    assert np.array_equal(shaped[:, 1:], sounds.dominance[:, 1:])


def test_lip_heavy_sounds_begin_earlier_in_proportion(sounds: Gestures) -> None:
    reach = [1.0 / passes.anticipate(sounds, amount).rates[6, LIPS, 0] for amount in (0.0, 1.0, 2.0)]
    assert reach[1] == pytest.approx(1.0 / 12.0)
    assert reach[2] - reach[1] == pytest.approx(reach[1] - reach[0])
    shaped = passes.anticipate(sounds, 1.0).rates
    assert np.array_equal(shaped[:, LIPS, 1], sounds.rates[:, LIPS, 1]), "they end as before"
    assert shaped[1, LIPS, 0] == sounds.rates[1, LIPS, 0], "ay is not lip-heavy"


def test_the_jaw_lags() -> None:
    assert passes.follow(from_table(cues("AA1:100")), 2.0).lag_s == pytest.approx(0.03)


def test_without_dominance_nothing_is_left_beyond_a_phone(sounds: Gestures) -> None:
    off = passes.spread_dominance(sounds, 0.0)
    assert np.exp(-off.rates.min() * 0.04) < 1e-30
    assert passes.spread_dominance(sounds, 2.0).rates == pytest.approx(0.5 * sounds.rates)


def test_rounded_sounds_stay_for_a_frame(sounds: Gestures) -> None:
    shaped = passes.keep_round(sounds, 1.0)
    for number in (5, 6):
        assert shaped.half_core_s[number, LIPS] == pytest.approx(0.5 / 12.0, abs=1e-4)
        assert shaped.dominance[number, LIPS] >= 2.0
    assert np.array_equal(shaped.half_core_s[:, JAW], sounds.half_core_s[:, JAW])
    assert np.array_equal(np.delete(shaped.dominance, (5, 6), axis=0), np.delete(sounds.dominance, (5, 6), axis=0))


def test_no_phones_pass_through_all() -> None:
    assert gestures((), USUAL).rows == ()


def test_passes_are_taken_with_their_amounts() -> None:
    found = gestures(cues(PHONES), Articulation(lag=0.0, brief=0.0, stress=0.0))
    assert found.lag_s == 0.0
    assert found.dominance[3, JAW] == phone_table()["T"].dominance[JAW]
    assert found.targets[4, 0] == pytest.approx(phone_table()["AE"].targets[0])
