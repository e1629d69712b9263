import pytest
from mouth_cases import cues

from mien.core import Cue, RangeError, UnknownNameError
from mien.speech.mouth_passes import RELEASE_S, soften_pauses, split_diphthongs, tidy


def symbols(phones: tuple[Cue, ...]) -> list[str]:
    return [cue.symbol for cue in phones]


def test_gaps_become_silence_and_the_end_is_silent() -> None:
    tidied = tidy([Cue(0.5, 0.6, "T"), Cue(0.2, 0.3, "AA1")])
    assert symbols(tidied) == ["SIL", "AA1", "SIL", "T", "SIL"]
    assert [cue.start_s for cue in tidied] == pytest.approx([0.0, 0.2, 0.3, 0.5, 0.6])
    assert tidied[-1].length_s >= RELEASE_S


def test_overlaps_are_cut_and_empty_phones_dropped() -> None:
    tidied = tidy([Cue(0.0, 0.2, "AA1"), Cue(0.1, 0.3, "T"), Cue(0.25, 0.25, "S")])
    assert [(cue.start_s, cue.end_s, cue.symbol) for cue in tidied[:2]] == [(0.0, 0.2, "AA1"), (0.2, 0.3, "T")]
    assert symbols(tidied) == ["AA1", "T", "SIL"]


def test_short_silence_at_the_end_grows_into_one() -> None:
    assert symbols(tidy(cues("AA1:100 SIL:50"))) == ["AA1", "SIL"]


def test_no_phones_are_a_moment_of_rest() -> None:
    assert symbols(tidy([])) == ["SIL"]


@pytest.mark.parametrize("wrong", [Cue(0.2, 0.1, "T"), Cue(float("nan"), 1.0, "T"), Cue(0.0, float("inf"), "T")])
def test_impossible_times_are_refused(wrong: Cue) -> None:
    with pytest.raises(RangeError, match="T"):
        tidy([wrong])


def test_unknown_symbol_is_refused() -> None:
    with pytest.raises(UnknownNameError, match="XX"):
        tidy([Cue(0.0, 0.1, "XX")])


def test_pauses_hold_relax_or_rest_by_length() -> None:
    softened = soften_pauses(cues("T:50 SIL:119 T:50 SIL:121 T:50 SIL:350 T:50 SIL:351 T:50"))
    assert symbols(softened)[1::2] == ["SIL-hold", "SIL-relax", "SIL-relax", "SIL"]


def test_the_mouth_rests_before_and_after_all_phones() -> None:
    assert symbols(soften_pauses(cues("SIL:200 T:50 SIL:100"))) == ["SIL", "T", "SIL"]


def test_diphthongs_split_sixty_to_forty() -> None:
    first, second, after = split_diphthongs(cues("AY1:100 T:50"))
    assert (first.symbol, second.symbol, after.symbol) == ("AY1", "AY1+", "T")
    assert (first.length_s, second.length_s) == pytest.approx((0.06, 0.04))
    assert second.end_s == after.start_s
