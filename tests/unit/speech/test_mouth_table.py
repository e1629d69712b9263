import pytest

from mien.core import UnknownNameError
from mien.speech.mouth_table import BLENDED, HELD, bare, phone_sources, phone_table, stress

VOWELS = ("AA", "AE", "AH", "AO", "AW", "AY", "EH", "ER", "EY", "IH", "IY", "OW", "OY", "UH", "UW")
VOICED = ("B", "D", "DH", "G", "JH", "L", "M", "N", "NG", "R", "V", "W", "Y", "Z", "ZH")
VOICELESS = ("CH", "F", "HH", "K", "P", "S", "SH", "T", "TH")
ARPABET = (*VOWELS, *VOICED, *VOICELESS, "SIL")


def target(phone: str, channel: str) -> float:
    return phone_table()[phone].targets[BLENDED.index(channel)]


def test_every_phone_of_arpabet_has_a_row_with_sources() -> None:
    for phone in ARPABET:
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


@pytest.mark.parametrize("tongue", ["T", "D", "N", "K", "G", "NG", "L", "HH"])
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
