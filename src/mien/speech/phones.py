"""The alphabet of phones: ARPABET, as in the CMU Pronouncing Dictionary, and ``SIL``."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from functools import cache
from importlib import resources
from types import MappingProxyType

from mien.core import SILENCE, MienError

VOWELS = frozenset(["AA", "AE", "AH", "AO", "AW", "AY", "EH", "ER", "EY", "IH", "IY", "OW", "OY", "UH", "UW"])
"""Phones that carry a stress digit in a cue: ``AE1``."""

CONSONANTS = frozenset(
    [
        "B",
        "CH",
        "D",
        "DH",
        "F",
        "G",
        "HH",
        "JH",
        "K",
        "L",
        "M",
        "N",
        "NG",
        "P",
        "R",
        "S",
        "SH",
        "T",
        "TH",
        "V",
        "W",
        "Y",
        "Z",
        "ZH",
    ]
)

STOPS = frozenset(["B", "CH", "D", "G", "JH", "K", "P", "T"])
"""Consonants that begin with a closed mouth and no sound, so that their beginning cannot be heard after a pause."""

PHONES = VOWELS | CONSONANTS | {SILENCE}
"""Every phone, without stress digits."""


def strip_stress(symbol: str) -> str:
    """The phone of a cue's symbol: ``AE`` of ``AE1``."""
    return symbol.rstrip("012")


def stress_of(symbol: str) -> int:
    """1 for main stress, 2 for secondary stress, 0 for an unstressed vowel, a consonant or a pause."""
    return int(symbol[-1]) if symbol[-1:] in {"1", "2"} else 0


def check_symbol(symbol: str, voice: str) -> None:
    """Nothing, when the symbol is a phone: a vowel with its digit, a consonant or ``SIL``.

    Raises:
        MienError: for any other symbol.
    """
    phone = strip_stress(symbol)
    digits = len(symbol) - len(phone)
    if phone not in PHONES or digits != (phone in VOWELS):
        raise MienError(
            f"voice {voice!r}: {symbol!r} is no phone of ours — want ARPABET, vowels with one stress digit: 'AE1', 'P'"
        )


@cache
def read_ipa_table() -> Mapping[str, tuple[str, ...]]:
    """ARPABET phones, without stress, of each IPA letter or pair of letters that voices write."""
    text = resources.files(__package__).joinpath("data/ipa_to_arpabet.csv").read_text(encoding="utf-8")
    lines = (line for line in text.splitlines() if not line.startswith("#"))
    return MappingProxyType({row["ipa"]: tuple(row["arpabet"].split()) for row in csv.DictReader(lines)})


def convert_ipa(letters: str) -> list[tuple[str, int, int]]:
    """Phones of IPA letters without stress marks: phone, first letter and the letter after its last one.

    Pairs win over single letters (``ɜɹ`` is ER). Letters that the table does not have are left out. One letter can
    be two phones, which then share it: both have its first and last place.
    """
    table = read_ipa_table()
    found: list[tuple[str, int, int]] = []
    place = 0
    while place < len(letters):
        width = 2 if letters[place : place + 2] in table and place + 2 <= len(letters) else 1
        found += [(phone, place, place + width) for phone in table.get(letters[place : place + width], ())]
        place += width
    return found
