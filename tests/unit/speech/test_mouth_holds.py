from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mouth_cases import cues, poem

from mien.core import Cue
from mien.speech.mouth_holds import LEAST_S, Hold, evaluate, find_holds, merge, spread_out, wish

LABIALS = st.lists(
    st.tuples(st.sampled_from(["P", "B", "M", "F", "V", "AA1", "S", "T", "SIL"]), st.integers(20, 200)), max_size=25
)


def test_a_long_m_is_held_on_its_own_time() -> None:
    (hold,) = find_holds(cues("AA1:200 M:200 AA1:200"))
    assert hold.channel == "closure"
    assert (hold.start_s, hold.end_s) == pytest.approx((0.2, 0.39))


def test_a_short_m_grows_about_its_middle() -> None:
    (hold,) = find_holds(cues("AA1:200 M:40 AA1:200"))
    assert (hold.start_s, hold.end_s) == pytest.approx((0.22 - 0.5 * LEAST_S, 0.22 + 0.5 * LEAST_S))


def test_the_lips_stay_shut_for_half_a_frame_after_the_middle_of_a_long_p() -> None:
    (hold,) = find_holds(cues("AA1:200 P:120 AA1:200"))
    assert (hold.start_s, hold.end_s) == pytest.approx((0.2, 0.26 + 0.5 * LEAST_S))


def test_holds_grow_away_from_a_short_vowel_between_them() -> None:
    first, second = find_holds(cues("AA1:200 M:60 AH0:80 M:60 AA1:200"))
    assert first.end_s == pytest.approx(0.26)
    assert second.start_s == pytest.approx(0.34)
    assert first.length_s == pytest.approx(LEAST_S) == second.length_s


def test_without_the_guarantee_holds_are_as_long_as_they_are() -> None:
    (hold,) = find_holds(cues("AA1:200 M:40 AA1:200"), 0.0)
    assert (hold.start_s, hold.end_s) == pytest.approx((0.2, 0.238))


def test_closure_does_not_grow_into_a_hiss() -> None:
    (after_s,) = find_holds(cues("S:80 P:60 AA1:100"))
    (before_s,) = find_holds(cues("AA1:100 P:60 S:80"))
    assert after_s.start_s == pytest.approx(0.08)
    assert before_s.end_s == pytest.approx(0.16)


def test_a_very_short_p_beside_a_hiss_is_held_about_its_middle() -> None:
    (after_s,) = find_holds(cues("S:80 P:20 AA1:100"))
    (before_s,) = find_holds(cues("AA1:100 P:20 S:80"))
    assert after_s.start_s == pytest.approx(0.09 - 0.25 * LEAST_S)
    assert before_s.end_s == pytest.approx(0.11 + 0.25 * LEAST_S)


def test_neighbouring_bilabials_are_one_hold() -> None:
    (hold,) = find_holds(cues("AA1:100 P:80 M:80 AA1:100"))
    assert hold.start_s == pytest.approx(0.1)
    assert hold.end_s == pytest.approx(0.256)


def test_a_vowel_between_bilabials_is_seen_open() -> None:
    first, second = find_holds(cues("SIL:200 B:50 AA1:70 B:50 SIL:200"))
    middle = np.array([0.5 * (first.end_s + first.fall_s + second.start_s - second.rise_s)])
    assert evaluate((first, second), "closure", middle)[0] == 0.0


def test_hold_at_the_start_stays_after_zero() -> None:
    (hold,) = find_holds(cues("M:30 AA1:100"))
    assert hold.start_s == 0.0
    assert hold.length_s >= LEAST_S


def test_crowded_holds_move_apart_by_least_squares() -> None:
    crowded = [Hold(1.0, 1.086, "closure"), Hold(1.05, 1.126, "tuck")]
    first, second = spread_out(crowded)
    assert first.end_s + 0.05 == pytest.approx(second.start_s)
    assert 1.0 - first.start_s == pytest.approx(second.start_s - 1.05)


def test_holds_that_have_room_stay_where_they_are() -> None:
    roomy = [Hold(0.1, 0.2, "closure"), Hold(0.5, 0.6, "tuck"), Hold(0.9, 1.0, "closure")]
    assert spread_out(roomy) == roomy


def test_merging_keeps_kinds_apart() -> None:
    kinds = [hold.channel for hold in merge(wish(cues("M:50 V:50 F:50 M:50")))]
    assert kinds == ["closure", "tuck", "closure"]


@settings(deadline=None, max_examples=60)
@given(LABIALS)
def test_every_hold_is_long_enough_and_none_overlap(words: list[tuple[str, int]]) -> None:
    phones = cues(" ".join(f"{symbol}:{length}" for symbol, length in words))
    holds = find_holds(phones)
    assert {hold.channel for hold in holds} == {
        {"P": "closure", "B": "closure", "M": "closure", "F": "tuck", "V": "tuck"}[cue.symbol]
        for cue in phones
        if cue.symbol in "PBMFV"
    }
    for hold in holds:
        assert hold.start_s >= 0.0
        assert hold.length_s >= LEAST_S - 1e-9
        assert hold.rise_s > 0.01
        assert hold.fall_s > 0.01
    for first, second in pairwise(holds):
        assert first.end_s + first.fall_s <= second.start_s - second.rise_s + 1e-9


def test_plateau_is_exactly_one_and_slopes_are_between() -> None:
    times = np.linspace(0.0, 0.4, 401)
    curve = evaluate((Hold(0.2, 0.3, "tuck"),), "tuck", times)
    assert np.all(curve[200:301] == 1.0)
    assert np.all(curve[(times < 0.13) | (times > 0.345)] == 0.0)
    assert np.all(np.diff(curve[:200]) >= 0.0)
    assert not np.any(evaluate((Hold(0.2, 0.3, "tuck"),), "closure", times))


def test_holds_of_the_poem_lie_on_their_phones() -> None:
    labials = [cue for cue in poem() if cue.symbol in ("P", "B", "M", "F", "V")]
    holds = find_holds(poem())
    for cue in labials:
        assert any(_overlap(cue, hold) >= 0.6 * cue.length_s for hold in holds), cue


def _overlap(cue: Cue, hold: Hold) -> float:
    return min(cue.end_s, hold.end_s) - max(cue.start_s, hold.start_s)
