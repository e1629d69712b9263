"""What each phone asks of the mouth: targets and dominance, read from ``data/phone_targets.csv``.

Sources of the rows are keys of ``data/phone_sources.csv``. The order of the sounds (which opens wider, which
rounds) is published; the amounts between 0 and 1 are ours.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from importlib import resources

import numpy as np
from numpy.typing import NDArray

from mien.core import UnknownNameError

Floats = NDArray[np.float64]

GROUPS: Mapping[str, tuple[str, ...]] = {
    "jaw": ("jaw",),
    "lips": ("round", "protrude", "spread", "upper_lip", "lower_lip"),
    "tongue": ("tongue_up", "tongue_out"),
}
"""Articulators and the channels that each one moves."""

BLENDED: tuple[str, ...] = tuple(channel for channels in GROUPS.values() for channel in channels)
"""Channels that dominance functions blend, in order."""

HELD: tuple[str, ...] = ("closure", "tuck")
"""Channels that are held on whole stretches of time, because a film must see them."""


@dataclass(frozen=True)
class PhoneTarget:
    """One row of the table.

    Attributes:
        phone: ARPABET symbol without stress; a ``+`` marks the second target of a diphthong.
        kind: vowel, glide, tongue, stop, nasal, sibilant, labial, breath or pause.
        targets: value of each blended channel, 0..1.
        dominance: weight of each group of channels, jaw, lips and tongue.
        early: whether the lips begin before the sound.
        hold: closure, tuck or nothing.
        hold_from, hold_to: part of the phone over which the hold lasts, fractions of its length.
        sources: keys of the table of sources.
    """

    phone: str
    kind: str
    targets: tuple[float, ...]
    dominance: tuple[float, ...]
    early: bool
    hold: str
    hold_from: float
    hold_to: float
    sources: tuple[str, ...]

    @property
    def is_vowel(self) -> bool:
        """Whether stress scales its opening."""
        return self.kind == "vowel"


@dataclass(frozen=True, eq=False)
class PhoneTable:
    """All rows, and the same as arrays."""

    rows: tuple[PhoneTarget, ...]

    @cached_property
    def index(self) -> Mapping[str, int]:
        """Row number of each phone."""
        return {row.phone: number for number, row in enumerate(self.rows)}

    @cached_property
    def targets(self) -> Floats:
        """(phones, blended channels) targets."""
        return np.array([row.targets for row in self.rows])

    @cached_property
    def dominance(self) -> Floats:
        """(phones, groups) dominance."""
        return np.array([row.dominance for row in self.rows])

    def __getitem__(self, symbol: str) -> PhoneTarget:
        """The row of a symbol with or without its stress digit.

        Raises:
            UnknownNameError: no such phone.
        """
        phone = bare(symbol)
        if phone not in self.index:
            raise UnknownNameError("phone", symbol, self.index)
        return self.rows[self.index[phone]]


def bare(symbol: str) -> str:
    """The symbol without its stress digit: ``AE1`` is ``AE`` and ``AY1+`` is ``AY+``."""
    return "".join(letter for letter in symbol if not letter.isdigit())


def stress(symbol: str) -> int | None:
    """The stress digit of a symbol: 0 none, 1 primary, 2 secondary; None where the voice gives no stress."""
    digits = [letter for letter in symbol if letter.isdigit()]
    return int(digits[0]) if digits else None


@lru_cache(maxsize=1)
def phone_table() -> PhoneTable:
    """The shipped table."""
    return PhoneTable(tuple(_parse_row(row) for row in _read("phone_targets.csv")))


@lru_cache(maxsize=1)
def phone_sources() -> Mapping[str, tuple[str, str]]:
    """Source key -> (reference, what was taken from it)."""
    return {row["key"]: (row["reference"], row["taken"]) for row in _read("phone_sources.csv")}


def _read(name: str) -> list[dict[str, str]]:
    text = resources.files("mien.speech").joinpath("data", name).read_text(encoding="utf-8")
    return list(csv.DictReader(text.splitlines()))


def _parse_row(row: dict[str, str]) -> PhoneTarget:
    return PhoneTarget(
        phone=row["phone"],
        kind=row["kind"],
        targets=tuple(float(row[channel]) for channel in BLENDED),
        dominance=tuple(float(row[f"{group}_dominance"]) for group in GROUPS),
        early=row["early"] == "1",
        hold=row["hold"],
        hold_from=float(row["hold_from"] or 0.0),
        hold_to=float(row["hold_to"] or 0.0),
        sources=tuple(row["source"].split()),
    )
