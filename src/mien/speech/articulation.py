"""How a mouth speaks: one amount for each pass that turns phones into motion.

The fields are the table of passes, in the order in which they work. What can be asked for, what the help and the docs
say and what the ablation measures are derived from it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from types import MappingProxyType
from typing import Any

from mien.core import RangeError


@dataclass(frozen=True)
class Amount:
    """A row of the table.

    Attributes:
        name: of the field.
        doc: what it does.
        high: the greatest amount; the least is always 0, off.
        measure: what it changes that can be counted; empty for what is no pass.
        source: who says so.
    """

    name: str
    doc: str
    high: float
    measure: str
    source: str

    def check(self, value: float) -> float:
        """The value, when it is in the range.

        Raises:
            RangeError: it is not.
        """
        if not (math.isfinite(value) and 0.0 <= value <= self.high):
            raise RangeError(f"style {self.name}={value:g} is out of range — it goes from 0 (off) to {self.high:g}")
        return value


def amount(doc: str, *, measure: str = "", source: str = "own", high: float = 2.0) -> Any:
    """A field of the table, 1 unless said."""
    return field(default=1.0, metadata={"doc": doc, "high": high, "measure": measure, "source": source})


@dataclass(frozen=True, kw_only=True)
class Articulation:
    """Amounts of the passes from 0 (off) over 1 (usual) to 2 or less.

    Only ``closures`` and ``rounding`` decide what a film is sure to see; whatever the others are, p b m close and f v
    tuck.
    """

    targets: float = amount(
        "each phone has its own shape; off, all vowels have one and all consonants another",
        measure="how far vowels differ",
        source="Parke 1974, section 4.2",
    )
    stress: float = amount(
        "unstressed vowels open less",
        measure="opening of stressed vowels over that of unstressed ones",
        source="Macchi 1985",
    )
    diphthongs: float = amount(
        "diphthongs end in another shape than they begin with",
        measure="movement within diphthongs",
        source="Ladefoged 2006",
    )
    brief: float = amount(
        "stops, nasals and labials under 100 ms leave the jaw to the vowels beside them",
        measure="how far t, d, n, k, g under 100 ms leave the jaw open between vowels",
        source="Edwards et al. 2016, section 4",
        high=1.0,
    )
    pauses: float = amount(
        "the mouth stays open in pauses up to 120 ms and shuts partly in those up to 350 ms",
        measure="how far the jaw is open in the middle of pauses up to 350 ms",
        source="Edwards et al. 2016, section 4",
    )
    anticipation: float = amount(
        "lips begin lip-heavy sounds (oo oh w s z sh ch j) early",
        measure="how long before oo, oh and w the lips are half round",
        source="Daniloff and Moll 1968",
    )
    lag: float = amount(
        "the jaw comes 15 ms after the lips",
        measure="how much later than the lower lip the jaw is fastest",
        source="Gracco 1988",
    )
    dominance: float = amount(
        "phones blend into one another as far as they dominate; off, the mouth jumps from shape to shape",
        measure="greatest speed of the jaw",
        source="Cohen and Massaro 1993",
    )
    rounding: float = amount(
        "lips stay round for a frame at 12 frames a second",
        measure="least roundness in the frame nearest to the middle of oo, oh and w, at 12 frames a second",
        source="Parke 1974, section 4.3",
        high=1.0,
    )
    jaw: float = amount("how far the jaw moves", measure="travel of the jaw", source="Edwards et al. 2016, section 3")
    lips: float = amount("how far the lips move", measure="travel of the lips", source="Edwards et al. 2016, section 3")
    tongue: float = amount(
        "how far the tongue moves", measure="height of the tongue in l t d n th", source="Parke 1974, section 5.1"
    )
    strength: float = amount("how far jaw, lips and tongue move together")
    closures: float = amount(
        "lips are shut for p b m, and tucked for f v, for a frame at 12 frames a second",
        measure="closures and tucks that a film at 12 frames a second misses",
        source="Parke 1974, section 4.3",
        high=1.0,
    )

    def __post_init__(self) -> None:
        for name, row in amounts(type(self)).items():
            object.__setattr__(self, name, row.check(float(getattr(self, name))))


def amounts(record: type[Articulation] = Articulation) -> Mapping[str, Amount]:
    """The table: a row for each field of a record, by name, in order."""
    return MappingProxyType({each.name: Amount(each.name, **each.metadata) for each in fields(record)})


USUAL = Articulation()
