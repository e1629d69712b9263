from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import Cue
from mien.core.chance import around, between, stream
from mien.gaze import Glance, blinks, brow_raises, find_accents, head_sway, looks, nods, saccades
from mien.gaze.accents import LEAST_APART_S, Accent, function_words
from mien.gaze.blinks import CLOSE_S, OPEN_S, SHUT_S, blink_times
from mien.gaze.curves import pulses, way
from mien.gaze.eyes import saccade_length_s
from mien.timeline import Track

LENGTHS = st.floats(0.0, 60.0)
SEEDS = st.integers(0, 2**40)


def talk(length_s: float, pause_every_s: float = 3.0) -> list[Cue]:
    """Phones of 100 ms with a pause of 400 ms now and then."""
    phones, time = [], 0.0
    while time < length_s:
        phones.append(Cue(time, time + pause_every_s, "AA1"))
        phones.append(Cue(time + pause_every_s, time + pause_every_s + 0.4, "SIL"))
        time += pause_every_s + 0.4
    return phones


def values(track: Track) -> np.ndarray:
    return track.given()[1]


# Chance


def test_streams_are_the_same_every_time_and_differ_by_name_and_seed() -> None:
    draws = {name: [stream(seed, name).random() for _ in range(2)] for name, seed in (("a", 1), ("b", 1))}
    assert draws["a"][0] == draws["a"][1] != draws["b"][0]
    assert stream(2, "a").random() != draws["a"][0]


def test_stream_is_the_promised_one() -> None:
    # A change of this number would change every film.
    assert stream(0, "blinks").random() == 0.8300412080321


def test_bounds_are_kept() -> None:
    chance = stream(3, "bounds")
    assert all(2.0 <= between(chance, 2.0, 3.0) <= 3.0 for _ in range(200))
    drawn = [around(chance, 1.0, 0.5) for _ in range(500)]
    assert 0.5 <= min(drawn) < 0.85 < 1.15 < max(drawn) <= 1.5
    assert np.mean(drawn) == pytest.approx(1.0, abs=0.03)


# Curves


def test_way_is_slow_at_both_ends_and_reaches_its_places() -> None:
    track = way([0.0, 1.0, 2.0], [0.0, 4.0, 4.0], steps=4)
    assert list(track.evaluate([0.0, 0.25, 0.5, 1.0, 1.5])[0]) == pytest.approx([0.0, 0.625, 2.0, 4.0, 4.0])


def test_pulses_that_would_overlap_wait() -> None:
    track = pulses([([0.0, 0.5, 1.0], [0.0, 1.0, 0.0]), ([0.8, 1.3, 1.8], [0.0, 1.0, 0.0])], 3.0)
    assert list(track.evaluate([0.5, 1.0, 1.5, 2.0, 3.0])[0]) == pytest.approx([1.0, 0.0, 1.0, 0.0, 0.0])


# Blinks


@settings(deadline=None, max_examples=30)
@given(LENGTHS, SEEDS)
def test_blinks_are_over_before_the_end_and_do_not_overlap(length_s: float, seed: int) -> None:
    times = blink_times(length_s, seed, talk(length_s))
    assert all(second - first >= CLOSE_S + SHUT_S + OPEN_S for first, second in pairwise(times))
    assert all(0.0 < time <= length_s - CLOSE_S - SHUT_S - OPEN_S for time in times)
    for track in blinks(length_s, seed).values():
        assert np.all((values(track) >= 0.0) & (values(track) <= 1.0))
        assert values(track)[0] == values(track)[-1] == 0.0


def test_blinks_come_as_often_as_people_blink() -> None:
    rest = np.mean([len(blink_times(120.0, seed)) for seed in range(20)]) / 2.0
    speaking = np.mean([len(blink_times(120.0, seed, talk(120.0))) for seed in range(20)]) / 2.0
    assert 15.0 < rest < 20.0
    assert rest < speaking < 26.0


def test_blinks_gather_at_pauses() -> None:
    phones = talk(120.0)
    pauses = {round(cue.start_s, 6) for cue in phones if cue.symbol == "SIL"}
    times = [time for seed in range(10) for time in blink_times(120.0, seed, phones)]
    assert np.mean([round(time, 6) in pauses for time in times]) > 0.4


def test_blinks_gather_where_phrases_end() -> None:
    phones = [Cue(0.0, 120.0, "AA1")]
    ends = [3.0 * k for k in range(1, 40)]
    times = [time for seed in range(10) for time in blink_times(120.0, seed, phones, ends_s=ends)]
    assert np.mean([time in ends for time in times]) > 0.4


def test_a_blink_shuts_fast_and_opens_slowly_and_every_film_sees_it_shut() -> None:
    track = blinks(30.0, 5)["blink.left"]
    start = blink_times(30.0, 5)[0]
    assert list(track.evaluate([start, start + CLOSE_S, start + CLOSE_S + SHUT_S])[0]) == [0.0, 1.0, 1.0]
    assert track.evaluate([start + CLOSE_S + SHUT_S + OPEN_S])[0][0] == pytest.approx(0.0, abs=1e-12)
    assert OPEN_S > 2.0 * CLOSE_S
    assert SHUT_S > 1.0 / 24.0


def test_blinks_can_be_made_rare() -> None:
    usual, rare = (sum(len(blink_times(120.0, seed, often=often)) for seed in range(5)) for often in (1.0, 0.25))
    assert rare == pytest.approx(0.25 * usual, rel=0.3)


def test_both_eyes_blink_together() -> None:
    left, right = blinks(20.0, 1).values()
    assert left == right


# Head


@settings(deadline=None, max_examples=20)
@given(LENGTHS, SEEDS)
def test_sway_is_small_and_starts_and_ends_at_rest(length_s: float, seed: int) -> None:
    for track in head_sway(length_s, seed).values():
        assert np.max(np.abs(values(track))) <= 3.0
        assert values(track)[0] == values(track)[-1] == 0.0


def test_sway_never_stops_for_long_nor_hurries() -> None:
    times = np.arange(0.0, 60.0, 0.02)
    turn = head_sway(60.0, 4)["head_turn"].evaluate(times)[0]
    assert np.ptp(turn) > 1.0
    assert np.max(np.abs(np.diff(turn))) / 0.02 < 6.0


def test_nods_dip_after_the_accent() -> None:
    accents = [Accent(2.0 * i + 1.0, 1.0, "stone") for i in range(20)]
    track = nods(accents, 42.0, 3)
    times = np.arange(0.0, 42.0, 0.01)
    nod = track.evaluate(times)[0]
    lowest = times[np.flatnonzero((nod[1:-1] < nod[:-2]) & (nod[1:-1] <= nod[2:]) & (nod[1:-1] < -0.5)) + 1]
    assert 8 <= len(lowest) <= 20
    assert all(abs(time % 2.0 - 1.05) < 0.02 for time in lowest)
    assert np.min(nod) >= -3.0
    assert np.max(nod) == 0.0


# Brows


def test_brows_rise_before_the_accent_and_not_on_every_one() -> None:
    accents = [Accent(2.0 * i + 1.0, 1.0, "stone") for i in range(40)]
    track = brow_raises(accents, 82.0, 3)
    raised = [float(track.evaluate([accent.time_s])[0][0]) for accent in accents]
    assert 10 < sum(height > 0.25 for height in raised) < 38
    assert max(raised) <= 0.75
    first = next(accent for accent, height in zip(accents, raised, strict=True) if height > 0.0)
    assert 0.0 < track.evaluate([first.time_s - 0.1])[0][0] < track.evaluate([first.time_s])[0][0]


# Accents

WORDS = [Cue(0.0, 0.2, "How"), Cue(0.2, 0.6, "happy"), Cue(0.6, 0.7, "the"), Cue(0.7, 1.3, "stone,")]
SOUNDS = [
    Cue(0.0, 0.2, "AW1"),
    Cue(0.2, 0.4, "AE1"),
    Cue(0.4, 0.6, "IY0"),
    Cue(0.6, 0.7, "AH1"),
    Cue(0.7, 0.8, "S"),
    Cue(0.8, 1.2, "OW1"),
    Cue(1.2, 1.3, "N"),
]


@pytest.mark.parametrize("seed", range(8))
def test_longest_content_word_of_a_phrase_is_accented_on_its_stressed_vowel(seed: int) -> None:
    accents = find_accents(WORDS, SOUNDS, seed)
    assert (accents[-1].word, accents[-1].time_s, accents[-1].strength) == ("stone,", 1.0, 1.0)
    assert {accent.word for accent in accents} <= {"happy", "stone,"}


def test_a_pause_makes_two_phrases() -> None:
    later = [Cue(cue.start_s + 2.0, cue.end_s + 2.0, cue.symbol) for cue in WORDS]
    sounds = [*SOUNDS, Cue(1.3, 2.0, "SIL"), *(Cue(c.start_s + 2.0, c.end_s + 2.0, c.symbol) for c in SOUNDS)]
    chief = [accent.time_s for accent in find_accents([*WORDS, *later], sounds, 0) if accent.strength == 1.0]
    assert chief == pytest.approx([1.0, 3.0])


def test_accents_keep_apart_and_chance_decides_some() -> None:
    words = [Cue(0.3 * i, 0.3 * (i + 1), "stone") for i in range(60)]
    sounds = [Cue(cue.start_s, cue.end_s, "OW1") for cue in words]
    several = {find_accents(words, sounds, seed) for seed in range(4)}
    assert len(several) == 4
    for accents in several:
        times = np.array([accent.time_s for accent in accents])
        assert np.all(np.diff(times) >= LEAST_APART_S - 1e-9)
        assert len(times) > 10


def test_function_words_are_lower_case_and_hold_no_content() -> None:
    assert {"the", "of", "is", "don't"} <= function_words()
    assert not {"stone", "happy", "road"} & function_words()


@pytest.mark.parametrize("seed", range(8))
def test_the_most_prominent_word_is_accented_whatever_its_length(seed: int) -> None:
    heard = dict(zip(WORDS, (0.5, 0.9, 0.1, 0.0), strict=True))
    accents = find_accents(WORDS, SOUNDS, seed, prominence=heard)
    assert [(accent.word, accent.strength) for accent in accents] == [("happy", 1.0)]


def test_a_small_word_that_stands_out_is_accented() -> None:
    heard = dict(zip(WORDS, (0.0, 0.1, 0.95, 0.2), strict=True))
    assert [accent.word for accent in find_accents(WORDS, SOUNDS, 0, prominence=heard)] == ["the"]


def test_prominence_is_the_chance_of_other_words() -> None:
    words = [Cue(i, i + 1.0, "stone") for i in range(100)]
    sounds = [Cue(cue.start_s, cue.end_s, "OW1") for cue in words]
    counts = []
    for often in (0.1, 0.8):
        heard = {word: 1.0 if i % 2 else often for i, word in enumerate(words)}
        accents = find_accents(words, sounds, 1, prominence=heard)
        counts.append(sum(int(accent.time_s) % 2 == 0 for accent in accents))
    assert counts[0] < 15
    assert counts[1] > 30


def test_a_phrase_ends_where_somebody_heard_it_end() -> None:
    def chief(*ends_s: float) -> list[float]:
        return [accent.time_s for accent in find_accents(WORDS, SOUNDS, 0, ends_s=ends_s) if accent.strength == 1.0]

    assert chief() == [1.0]
    assert chief(0.6, 1.3) == pytest.approx([0.3, 1.0])


@pytest.mark.parametrize("seed", range(4))
def test_words_asked_for_are_accented_with_their_strength(seed: int) -> None:
    accents = find_accents(WORDS, SOUNDS, seed, {WORDS[2]: 0.7})
    assert [(a.word, a.strength, a.wanted) for a in accents if a.wanted] == [("the", 0.7, True)]
    assert len(nods(accents, 2.0, seed)) > 1
    assert max(values(brow_raises(accents, 2.0, seed))) >= 0.5


def test_nothing_said_has_no_accents() -> None:
    assert find_accents([], [], 0) == ()


# Eyes


def test_saccades_follow_the_main_sequence() -> None:
    assert saccade_length_s(10.0) == pytest.approx(0.043)


@settings(deadline=None, max_examples=30)
@given(LENGTHS, SEEDS)
def test_eyes_stay_near_the_viewer_and_come_back(length_s: float, seed: int) -> None:
    tracks = saccades(length_s, seed, talk(length_s))
    for track, most in zip(tracks.values(), (7.0, 3.5), strict=True):
        assert np.max(np.abs(values(track))) <= most
        assert values(track)[0] == values(track)[-1] == 0.0


def test_eyes_rest_most_of_the_time_and_move_fast() -> None:
    tracks = saccades(120.0, 2, talk(120.0))
    times, turn = tracks["eye_turn"].given()
    moving = np.diff(turn) != 0.0
    assert np.sum(np.diff(times)[moving]) < 0.05 * 120.0
    assert np.max(np.diff(times)[moving]) <= saccade_length_s(15.0)
    assert np.sum(moving) > 40


def test_eyes_leave_the_viewer_only_while_something_is_said() -> None:
    silent = saccades(120.0, 2)
    assert np.max(np.abs(values(silent["eye_turn"]))) <= 1.8
    assert np.max(np.abs(values(saccades(120.0, 2, talk(120.0))["eye_turn"]))) > 3.0


def test_eyes_hold_still_on_the_viewer_while_they_are_to_rest() -> None:
    rests = [(5.0 * k, 5.0 * k + 1.0) for k in range(1, 20)]
    tracks = saccades(120.0, 2, talk(120.0), rests)
    for start_s, end_s in rests:
        moments = np.linspace(start_s + saccade_length_s(12.0), end_s, 9)
        assert not tracks["eye_turn"].evaluate(moments)[0].any()
    assert np.max(np.abs(values(tracks["eye_turn"]))) > 3.0


@settings(deadline=None, max_examples=60)
@given(st.lists(st.tuples(st.floats(0.0, 10.0), st.floats(0.0, 2.0)), max_size=8), SEEDS)
def test_rests_make_no_jumps(rests: list[tuple[float, float]], seed: int) -> None:
    asked = sorted((start_s, start_s + length_s) for start_s, length_s in rests)
    for track in saccades(10.0, seed, talk(10.0), asked).values():
        times, _ = track.given()
        assert np.all(np.diff(times) > 0.0)


# Looks


def test_looks_lead_with_the_eyes_and_the_head_follows() -> None:
    tracks = looks([Glance(1.0, 3.0, "left"), Glance(2.0, 4.0, "up", 0.5)], 6.0, 0)
    moments = [0.99, 1.07, 1.9, 2.9, 3.9, 4.9]
    assert tracks["eye_turn"].evaluate(moments)[0] == pytest.approx([0.0, -17.0, -17.0, 0.0, 0.0, 0.0])
    assert tracks["eye_nod"].evaluate(moments)[0] == pytest.approx([0.0, 0.0, 0.0, 5.5, 5.5, 0.0])
    assert tracks["head_turn"].evaluate([1.07, 1.9, 2.9])[0] == pytest.approx([0.0, -6.0, 0.0], abs=0.1)
    assert looks([], 6.0, 0) == {}


@settings(deadline=None, max_examples=60)
@given(st.lists(st.tuples(st.floats(0.0, 10.0), st.floats(0.0, 2.0)), max_size=8), SEEDS)
def test_looks_make_no_jumps(glances: list[tuple[float, float]], seed: int) -> None:
    asked = [Glance(start_s, start_s + length_s, "away") for start_s, length_s in sorted(glances)]
    for track in looks(asked, 10.0, seed).values():
        times, _ = track.given()
        assert np.all(np.diff(times) > 0.0)


# All


@pytest.mark.parametrize("make", [blinks, head_sway, saccades])
def test_same_seed_same_tracks_and_another_seed_others(make: object) -> None:
    assert callable(make)
    assert make(30.0, 7) == make(30.0, 7)
    assert make(30.0, 7) != make(30.0, 8)
