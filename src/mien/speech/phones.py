"""The alphabet of phones: ARPABET, as in the CMU Pronouncing Dictionary, what other languages have besides, ``SIL``.

Phones beyond English are named in the same way: EC, OC (closed e and o, without a glide), UE, UEH, OE, OEH (front
rounded, as German ü and ö, long and short), BH (Spanish lobo), HY (German ich), KH (Bach), GH (French rue), RR
(Spanish perro), NY (French agneau), LY (Italian figlio).
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from functools import cache
from importlib import resources
from types import MappingProxyType

from mien.core import SILENCE, MienError

ENGLISH_VOWELS = frozenset(["AA", "AE", "AH", "AO", "AW", "AY", "EH", "ER", "EY", "IH", "IY", "OW", "OY", "UH", "UW"])
VOWELS = ENGLISH_VOWELS | {"EC", "OC", "OE", "OEH", "UE", "UEH"}
"""Phones that carry a stress digit in a cue: ``AE1``."""

ENGLISH_CONSONANTS = frozenset(
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
CONSONANTS = ENGLISH_CONSONANTS | {"BH", "GH", "HY", "KH", "LY", "NY", "RR"}

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
def read_ipa_table(language: str = "", *, units: bool = False) -> Mapping[str, tuple[str, ...]]:
    """Phones, without stress, of each run of IPA letters; none where a letter is no sound of the mouth's own.

    Args:
        language: subtag like ``en`` whose own readings win; English has none but ARPABET's phones.
        units: also with runs that are one sound only where they are written by themselves: ``aɪ``, ``tʃ``.
    """
    text = resources.files(__package__).joinpath("data/ipa_to_arpabet.csv").read_text(encoding="utf-8")
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    chosen = [
        row for wanted in ("", language) for row in rows if row["language"] == wanted and row["unit"] <= "1" * units
    ]
    return MappingProxyType({row["ipa"]: tuple(row["arpabet"].split()) for row in chosen})


def convert_ipa(letters: str, table: Mapping[str, tuple[str, ...]]) -> list[tuple[str, int, int]]:
    """Phones of IPA letters without stress marks: phone, first letter and the letter after its last one.

    The longest run of the table wins (``ɜɹ`` is ER). Letters that the table does not have are left out. One letter
    can be two phones, which then share it: both have its first and last place.
    """
    longest = max(map(len, table))
    found: list[tuple[str, int, int]] = []
    place = 0
    while place < len(letters):
        runs = (letters[place : place + width] for width in range(longest, 0, -1))
        run = next((run for run in runs if run in table), letters[place])
        found += [(phone, place, place + len(run)) for phone in table.get(run, ())]
        place += len(run)
    return found
