"""Which shape of a set each phone shows, read from ``data/shapes_<set>.csv``, and which come between two shapes."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from types import MappingProxyType

from mien.core import UnknownNameError

from .mouth_table import bare

SHAPE_SETS = ("rhubarb", "oculus", "sapi", "preston-blair")
"""Names of the sets of mouth shapes; the shapes are named in the vocabularies of the same names."""

NEXT, FORMER = ">", "<"
"""In place of a shape: that of the next phone, of the phone before."""


@dataclass(frozen=True)
class PhoneShape:
    """One row: what a phone shows.

    Attributes:
        shape: name in the set; or ``NEXT`` or ``FORMER``.
        short_s: length under which the phone has no time for its shape; 0 where it always has.
        short: what it shows then.
        before_round: what its free lips show early, before a phone of that shape; nothing where they are busy.
    """

    shape: str
    short_s: float
    short: str
    before_round: str


@dataclass(frozen=True)
class Between:
    """A shape on the way from one shape to another, and which of the two gives it time: ``first`` or ``second``."""

    shape: str
    within: str


@dataclass(frozen=True, eq=False)
class ShapeTable:
    """One set of shapes.

    Attributes:
        phones: row of each phone; ``+`` marks the second target of a diphthong that the set splits.
        between: shape on the way from one shape to another.
    """

    phones: Mapping[str, PhoneShape]
    between: Mapping[tuple[str, str], Between]

    def shape(self, symbol: str, length_s: float) -> str:
        """What a phone of that length shows by itself.

        Raises:
            UnknownNameError: no such phone.
        """
        row = self.row(symbol)
        return row.short if length_s < row.short_s else row.shape

    def row(self, symbol: str) -> PhoneShape:
        """The row of a symbol with or without its stress digit.

        Raises:
            UnknownNameError: no such phone.
        """
        try:
            return self.phones[bare(symbol)]
        except KeyError:
            raise UnknownNameError("phone", symbol, self.phones) from None

    def splits(self, symbol: str) -> bool:
        """Whether a diphthong shows two shapes."""
        return bare(symbol) + "+" in self.phones


@cache
def shape_table(name: str) -> ShapeTable:
    """The table of a set.

    Raises:
        UnknownNameError: no such set.
    """
    if name not in SHAPE_SETS:
        raise UnknownNameError("set of mouth shapes", name, SHAPE_SETS)
    phones = {
        row["phone"]: PhoneShape(row["shape"], float(row["short_s"] or 0.0), row["short"], row["before_round"])
        for row in _read(f"shapes_{name}.csv")
    }
    between = {
        (row["first"], row["second"]): Between(row["between"], row["within"])
        for row in _read("shapes_between.csv")
        if row["set"] == name
    }
    return ShapeTable(MappingProxyType(phones), MappingProxyType(between))


def _read(name: str) -> list[dict[str, str]]:
    text = resources.files("mien.speech").joinpath("data", name).read_text(encoding="utf-8")
    return list(csv.DictReader(text.splitlines()))
