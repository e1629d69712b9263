"""Words and phones that were corrected by hand, or aligned by another program, in the place of ours."""

from __future__ import annotations

import csv
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib import resources
from itertools import pairwise
from types import MappingProxyType

from mien.core import SILENCE, Cue, MienError, UnknownNameError
from mien.formats import CueSheet
from mien.formats.cue_sheet import fill_gaps, place_of
from mien.speech import PHONES, VOWELS, Speech
from mien.speech.phones import read_ipa_table

WORD_TIERS = ("words", "word", "ort-mau", "ort", "kan-mau", "kan")
PHONE_TIERS = ("phones", "phone", "phonemes", "phoneme", "mau", "segments", "segment", "phonetic")
"""Names of tiers in lower case, the one to prefer first: ours and Montreal Forced Aligner's, people's, WebMAUS's."""

ALPHABETS = ("arpabet", "ipa", "sampa")
"""What labels of phones may be written in, the one to prefer where several know them all first."""

SLACK_S = 0.1
"""By which the last phone may end after the sound, seconds: other programs count in frames of theirs."""

MOST_PHONES = 2
"""In one label: more are a misprint, or a word."""

_MARKS = ("Mn", "Lm", "Sk")
"""Unicode's categories of what stands on, below or behind a letter: length, breath, ties, tones."""

_STRESS = {"ˈ": "1", "'": "1", '"': "1", "ˌ": "2", "%": "2"}


def correct(speech: Speech, sheet: CueSheet) -> Speech:
    """The speech with the words and phones of a sheet; its own words stay where the sheet has none.

    Raises:
        UnknownNameError: a label is no phone; names tier, interval and time.
        MienError: there is no tier of phones, or it goes on after the sound.
    """
    words, phones = cues_for_speech(sheet, speech.sound.length_s)
    return replace(speech, words=words or speech.words, phones=phones, text=sheet.text or speech.text)


def cues_for_speech(sheet: CueSheet, length_s: float | None = None) -> tuple[tuple[Cue, ...], tuple[Cue, ...]]:
    """The words of a sheet, and its phones as a face is moved by: ARPABET with stress digits, without holes.

    Tiers are found by their names (``WORD_TIERS``, ``PHONE_TIERS``) in any case, behind the name of a speaker too.
    A vowel without a mark of stress has none. Two phones in one label share its time; gaps and marks of pauses become
    ``SIL``.

    Args:
        sheet: as read from a file.
        length_s: of the sound that it is for, seconds; None is that of the sheet.

    Raises:
        UnknownNameError: a label is no phone; names tier, interval and time.
        MienError: there is no tier of phones, or it goes on after the sound.
    """
    length_s = sheet.length_s if length_s is None else length_s
    tier = _find_tier(sheet, PHONE_TIERS)
    if tier is None:
        there = ", ".join(repr(name) for name in sheet.tiers)
        raise MienError(f"cues: there is no tier of phones, only {there} — name one of them 'phones'")
    if not sheet.tiers[tier]:
        raise MienError(f"cues: tier {tier!r} is empty, want phones")
    end_s = max((cue.end_s for cue in sheet.tiers[tier] if not _is_pause(cue.symbol)), default=0.0)
    if end_s > length_s + SLACK_S:
        raise MienError(
            f"cues: tier {tier!r} ends at {end_s:.3f} s, but the sound at {length_s:.3f} s — is it another's?"
        )
    word_tier = _find_tier(sheet, WORD_TIERS)
    words = () if word_tier is None else sheet.tiers[word_tier]
    return (
        tuple(_cut((word for word in words if not _is_pause(word.symbol)), length_s)),
        _join(fill_gaps(_cut(_spell(sheet, tier), length_s), length_s, SILENCE)),
    )


def _find_tier(sheet: CueSheet, names: Sequence[str]) -> str | None:
    """The tier of the first of the names that one has; None when there is none."""
    for name in names:
        # Montreal Forced Aligner writes "speaker - phones".
        found = [tier for tier in sheet.tiers if tier.lower().rpartition(" - ")[2].strip() == name]
        if len(found) > 1:
            listed = ", ".join(repr(tier) for tier in found)
            raise MienError(f"cues: {len(found)} tiers may be the {names[0]}: {listed} — keep one speaker's")
        if found:
            return found[0]
    return None


def _cut(cues: Iterable[Cue], length_s: float) -> Iterator[Cue]:
    for cue in cues:
        if cue.start_s < length_s:
            yield Cue(cue.start_s, min(cue.end_s, length_s), cue.symbol)


def _join(cues: Iterable[Cue]) -> tuple[Cue, ...]:
    """Pauses in a row as one."""
    joined: list[Cue] = []
    for cue in cues:
        if joined and cue.symbol == joined[-1].symbol == SILENCE:
            joined[-1] = replace(joined[-1], end_s=cue.end_s)
        else:
            joined.append(cue)
    return tuple(joined)


def _spell(sheet: CueSheet, tier: str) -> Iterator[Cue]:
    """Phones of the labels of a tier, each with its share of the label's time."""
    cues = sheet.tiers[tier]
    alphabet = find_alphabet([cue.symbol for cue in cues])
    stress = ""
    for number, cue in enumerate(fill_gaps(cues, sheet.length_s), start=1):
        if not cue.symbol:
            continue
        label = alphabet.read(cue.symbol)
        if label is None:
            place = f"{place_of(tier, number)} ({cue.start_s:.3f} s)"
            raise UnknownNameError(f"phone in {place}, read as {alphabet.name}:", cue.symbol, alphabet.phones)
        stress = label.stress or stress
        count = len(label.phones)
        edges = [cue.start_s + cue.length_s * part / count for part in range(count)] + [cue.end_s]
        for (start_s, end_s), phone in zip(pairwise(edges), label.phones, strict=True):
            vowel = phone in VOWELS
            yield Cue(start_s, end_s, phone + (stress or "0") * vowel)
            stress = "" if vowel else stress


@dataclass(frozen=True)
class Label:
    """Phones without stress, and the mark of stress that stands before them or at their end, if any."""

    phones: tuple[str, ...]
    stress: str = ""


@dataclass(frozen=True)
class Alphabet:
    """How phones are written."""

    name: str
    phones: Mapping[str, tuple[str, ...]]

    def read(self, symbol: str) -> Label | None:
        """What a label says; None when it is not of this alphabet."""
        if _is_pause(symbol):
            return Label((SILENCE,))
        if self.name == "arpabet":
            return self._read_arpabet(symbol.upper()) or self._read_letters(symbol.upper(), "")
        stress = next((digit for mark, digit in _STRESS.items() if symbol.startswith(mark)), "")
        return self._read_letters(symbol.lstrip("".join(_STRESS)), stress)

    def _read_arpabet(self, symbol: str) -> Label | None:
        plain = symbol.rstrip("012")
        phones = self.phones.get(plain)
        digit = symbol[len(plain) :]
        if phones is None or len(digit) > (phones[0] in VOWELS):
            return None
        return Label(phones, digit)

    def _read_letters(self, symbol: str, stress: str) -> Label | None:
        """One or two phones without what tells no more than length and breath; the longest that is known wins."""
        phones: tuple[str, ...] = ()
        letters = self._plain(symbol)
        for _ in range(MOST_PHONES):
            known = next((letters[:width] for width in (3, 2, 1) if letters[:width] in self.phones), "")
            phones += self.phones.get(known, ())
            letters = letters[len(known) :]
        return Label(phones, stress) if phones and not letters else None

    def _plain(self, symbol: str) -> str:
        composed = unicodedata.normalize("NFC", symbol)
        if composed in self.phones:
            return composed
        if self.name == "sampa":
            return composed.translate({ord(mark): None for mark in ":_="})
        # Marks come off letters that the table does not have with them: ç stays, ã becomes a.
        apart = "".join(
            letter if letter in self.phones else unicodedata.normalize("NFD", letter) for letter in composed
        )
        return "".join(
            letter for letter in apart if letter in self.phones or unicodedata.category(letter) not in _MARKS
        )


def _is_pause(symbol: str) -> bool:
    return symbol.lower() in _read_labels()["pause"]


def find_alphabet(symbols: Sequence[str]) -> Alphabet:
    """What labels of phones are written in: the alphabet that knows the most of them."""
    return min(_alphabets(), key=lambda alphabet: sum(alphabet.read(symbol) is None for symbol in set(symbols)))


@cache
def _alphabets() -> tuple[Alphabet, ...]:
    labels = _read_labels()
    # Capital letters among voices' IPA are one voice's own.
    letters = {
        letter: phones
        for letter, phones in read_ipa_table(units=True).items()
        if phones and (not letter.isascii() or letter.islower())
    }
    own = {
        "arpabet": {phone: (phone,) for phone in PHONES} | labels["arpabet"],
        "ipa": letters | labels["ipa"],
        "sampa": labels["sampa"],
    }
    return tuple(Alphabet(name, MappingProxyType(own[name])) for name in ALPHABETS)


@cache
def _read_labels() -> Mapping[str, dict[str, tuple[str, ...]]]:
    """Phones by alphabet and label."""
    text = resources.files(__package__).joinpath("data/phone_labels.csv").read_text(encoding="utf-8")
    tables: dict[str, dict[str, tuple[str, ...]]] = {}
    for row in csv.DictReader(line for line in text.splitlines() if not line.startswith("# ")):
        tables.setdefault(row["alphabet"], {})[row["label"]] = tuple(row["arpabet"].split())
    return MappingProxyType(tables)
