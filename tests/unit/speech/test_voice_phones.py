from __future__ import annotations

import gzip
import json
from importlib.util import find_spec
from pathlib import Path

import pytest

from mien.core import MienError
from mien.speech import CONSONANTS, PHONES, SILENCE, STOPS, VOWELS, stress_of, strip_stress
from mien.speech.phones import ENGLISH_CONSONANTS, ENGLISH_VOWELS, check_symbol, convert_ipa, read_ipa_table


def test_the_alphabet_is_that_of_the_cmu_dictionary_and_of_other_languages_and_silence():
    assert len(ENGLISH_VOWELS) == 15
    assert len(ENGLISH_CONSONANTS) == 24
    assert ENGLISH_VOWELS < VOWELS
    assert ENGLISH_CONSONANTS < CONSONANTS
    assert VOWELS | CONSONANTS | {SILENCE} == PHONES
    assert STOPS <= CONSONANTS


def test_stress_is_a_digit_of_vowels():
    assert [strip_stress(symbol) for symbol in ("AE1", "P", "SIL", "ER0")] == ["AE", "P", "SIL", "ER"]
    assert [stress_of(symbol) for symbol in ("AE1", "P", "SIL", "ER0", "OW2")] == [1, 0, 0, 0, 2]


@pytest.mark.parametrize("symbol", ["AE", "P1", "SIL0", "AE12", "XX", "", "ae1", "1"])
def test_other_symbols_are_refused(symbol: str):
    with pytest.raises(MienError, match="plug"):
        check_symbol(symbol, "plug")


def test_the_ipa_table_gives_phones_only():
    table = read_ipa_table(units=True)
    assert all(set(phones) <= PHONES - {SILENCE} for phones in table.values())
    assert {phone for phones in table.values() for phone in phones} == PHONES - {SILENCE}


def test_english_has_no_phone_that_its_dictionaries_do_not_know():
    english = ENGLISH_VOWELS | ENGLISH_CONSONANTS
    assert {phone for phones in read_ipa_table("en").values() for phone in phones} == english
    assert (read_ipa_table("en")["y"], read_ipa_table()["y"]) == (("UW",), ("UE",))


def test_the_longest_run_wins():
    table = read_ipa_table("en")
    assert convert_ipa("bɜɹd", table) == [("B", 0, 1), ("ER", 1, 3), ("D", 3, 4)]
    assert convert_ipa("ʦi", table) == [("T", 0, 1), ("S", 0, 1), ("IY", 1, 2)]
    assert convert_ipa("?ə", table) == [("AH", 1, 2)]


def test_some_runs_are_one_sound_only_by_themselves():
    assert [phone for phone, _, _ in convert_ipa("tʃ", read_ipa_table("en"))] == ["T", "SH"]
    assert [phone for phone, _, _ in convert_ipa("tʃ", read_ipa_table("en", units=True))] == ["CH"]


@pytest.mark.parametrize(
    ("letters", "phones"), [("ɔ̃", "OC"), ("ɛ̃", "AE"), ("ɐ̃ʊ̃", "AW"), ("pf", "P F"), ("œy", "OEH UE"), ("ɔø", "OY")]
)
def test_letters_of_other_languages_are_read(letters: str, phones: str):
    assert " ".join(phone for phone, _, _ in convert_ipa(letters, read_ipa_table("de", units=True))) == phones


def test_every_letter_that_the_built_in_voice_writes_is_in_the_table():
    found = find_spec("hibari")
    assert found is not None
    assert found.origin is not None
    assets = Path(found.origin).parent / "assets"
    written = set(json.loads((assets / "oov.json").read_text())["out"])
    for name in ("gold", "silver"):
        lexicon = json.loads(gzip.decompress((assets / f"lexicon_us_{name}.json.gz").read_bytes()))
        for entry in lexicon.values():
            for reading in [entry] if isinstance(entry, str) else entry.values():
                written |= set(reading or "")
    marks = set("ˈˌ ()-1")
    assert written - marks <= set(read_ipa_table("en"))
