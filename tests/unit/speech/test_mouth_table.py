import pytest

from mien.core import UnknownNameError
from mien.speech import PHONES
from mien.speech.mouth_table import BLENDED, HELD, bare, phone_sources, phone_table, stress

VOWELS = ("AA", "AE", "AH", "AO", "AW", "AY", "EH", "ER", "EY", "IH", "IY", "OW", "OY", "UH", "UW")
VOICED = ("B", "D", "DH", "G", "JH", "L", "M", "N", "NG", "R", "V", "W", "Y", "Z", "ZH")
VOICELESS = ("CH", "F", "HH", "K", "P", "S", "SH", "T", "TH")
ARPABET = (*VOWELS, *VOICED, *VOICELESS, "SIL")


def target(phone: str, channel: str) -> float:
    return phone_table()[phone].targets[BLENDED.index(channel)]


def test_every_phone_has_a_row_with_sources() -> None:
    assert set(ARPABET) < PHONES
    for phone in PHONES:
        row = phone_table()[phone]
        assert row.sources
        assert set(row.sources) <= set(phone_sources())


def test_amounts_are_shares_and_dominance_is_not_negative() -> None:
    for row in phone_table().rows:
        assert all(0.0 <= value <= 1.0 for value in row.targets)
        assert all(value >= 0.0 for value in row.dominance)
        assert row.hold in ("", *HELD)
        assert 0.0 <= row.hold_from <= row.hold_to <= 1.0


def test_bilabials_close_and_labiodentals_tuck_and_nothing_else_does() -> None:
    holds = {row.phone: row.hold for row in phone_table().rows if row.hold}
    assert holds == {"P": "closure", "B": "closure", "M": "closure", "F": "tuck", "V": "tuck"}


@pytest.mark.parametrize(
    ("wider", "narrower"), [("AA", "AO"), ("AO", "OW"), ("OW", "UW"), ("AE", "EH"), ("EH", "IH"), ("IH", "IY")]
)
def test_vowels_open_in_the_order_of_lindblom_and_sundberg(wider: str, narrower: str) -> None:
    assert target(wider, "jaw") > target(narrower, "jaw")


@pytest.mark.parametrize(("front", "back"), [("UE", "UW"), ("UEH", "UH"), ("OE", "OC")])
def test_front_rounded_vowels_are_round_and_protruded_beyond_back_ones(front: str, back: str) -> None:
    assert target(front, "round") >= 0.6
    assert target(front, "protrude") > target(back, "protrude")


def test_closed_vowels_have_no_glide_and_lie_between_their_neighbours() -> None:
    assert target("IY", "jaw") < target("EC", "jaw") < target("EH", "jaw")
    assert target("UW", "jaw") < target("OC", "jaw") < target("AO", "jaw")
    assert not {"EC+", "OC+"} & set(phone_table().index)


def test_a_bilabial_that_does_not_shut_leaves_a_gap() -> None:
    row = phone_table()["BH"]
    assert row.hold == ""
    assert 0.0 < target("BH", "lower_lip") <= 0.05
    assert row.dominance[1] > phone_table()["AA"].dominance[1]


@pytest.mark.parametrize("tongue", ["T", "D", "N", "K", "G", "NG", "L", "HH", "KH", "GH", "RR", "NY", "LY"])
def test_lips_obey_any_vowel_rather_than_a_tongue_sound(tongue: str) -> None:
    lips = 1
    assert phone_table()[tongue].dominance[lips] <= 0.1 < 0.6 <= phone_table()["AH"].dominance[lips]


def test_sibilants_have_the_highest_jaw_of_all_sounds() -> None:
    sibilants = {row.phone for row in phone_table().rows if row.kind == "sibilant"}
    assert sibilants == {"S", "Z", "SH", "ZH", "CH", "JH"}
    others = [row for row in phone_table().rows if row.kind not in ("sibilant", "pause")]
    assert max(target(phone, "jaw") for phone in sibilants) < min(row.targets[0] for row in others)


def test_stress_digit_is_read_and_dropped() -> None:
    assert (bare("AE1"), bare("AY2+"), bare("SIL")) == ("AE", "AY+", "SIL")
    assert (stress("AE1"), stress("AY0+"), stress("T")) == (1, 0, None)


def test_unknown_phone_is_refused() -> None:
    with pytest.raises(UnknownNameError, match="QQ"):
        phone_table()["QQ"]
