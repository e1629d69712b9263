"""The remaps that ship: tables of links, and the way from a vocabulary to a family of faces."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping
from functools import lru_cache

from mien.core import LoadError, MienError, UnknownNameError

from .remap import BLENDS, FITS, Link, Remap
from .tables import each_side, shipped_tables, shipped_text
from .vocabulary import vocabularies

COLUMNS = ("parameter", "gain", "source")


@lru_cache(maxsize=32)
def load_remap(vocabulary: str, target: str) -> Remap:
    """The shipped remap from a vocabulary to a family of faces, or to another vocabulary.

    Raises:
        UnknownNameError: there is no such vocabulary.
        MienError: there is no table for the two.
    """
    if target not in targets(vocabulary):
        raise _no_table(vocabulary, target)
    title = f"{vocabulary}.{target}"
    return parse_remap(shipped_text(title), title=title, place=f"{title}.csv")


def next_step(vocabulary: str, family: str) -> str:
    """What the names of a vocabulary become on their way to a family of faces: the family, or another vocabulary.

    Raises:
        UnknownNameError: there is no such vocabulary.
        MienError: there is no way.
    """
    known = targets(vocabulary)
    if family in known:
        return family
    for other in known:
        if other in vocabularies() and family in families(other):
            return other
    raise _no_table(vocabulary, family)


def targets(vocabulary: str) -> tuple[str, ...]:
    """Families of faces, and other vocabularies, that a vocabulary has a table for.

    Raises:
        UnknownNameError: there is no such vocabulary.
    """
    if vocabulary not in vocabularies():
        raise UnknownNameError("vocabulary", vocabulary, vocabularies())
    parts = (name.split(".") for name in shipped_tables())
    return tuple(part[1] for part in parts if len(part) == 2 and part[0] == vocabulary)


def families(vocabulary: str) -> tuple[str, ...]:
    """Families of faces that a vocabulary can play, some of them by way of another vocabulary.

    Raises:
        UnknownNameError: there is no such vocabulary.
    """
    found = {
        family for each in targets(vocabulary) for family in (families(each) if each in vocabularies() else (each,))
    }
    return tuple(sorted(found))


def _no_table(vocabulary: str, family: str) -> MienError:
    known = families(vocabulary)
    others = "there is a table for " + " and ".join(known) if known else "it can play no family yet"
    return MienError(f"vocabulary {vocabulary!r} cannot play faces of the family {family!r} — {others}")


def parse_remap(text: str, *, title: str, place: str) -> Remap:
    """The remap in a table: lines of name, parameter, gain and source, and where wanted of blend, fit and unless.

    They are those of ``Link``. A line that names a ``{side}`` stands for one of either side.

    Raises:
        LoadError: with the line at which the table goes wrong.
    """
    reader = csv.DictReader(text.splitlines())
    fields = list(reader.fieldnames or [])
    if len(fields) < 4 or not set(COLUMNS) <= set(fields):
        raise LoadError(place, f"want a name and the columns {', '.join(COLUMNS)}, got {', '.join(fields)}", line=1)
    links: list[Link] = []
    for row in reader:
        gain, blend, fit = _parse_row(row, place, reader.line_num)
        links += (
            Link(side[fields[0]], side["parameter"], gain, blend, fit, side["source"], side.get("unless", ""))
            for side in each_side(row)
        )
    return Remap(title, tuple(links))


def _parse_row(row: Mapping[str, str], place: str, line: int) -> tuple[float, str, str]:
    if None in row.values() or None in row:
        raise LoadError(place, f"want {len(row)} fields", line=line)
    try:
        gain = float(row["gain"])
    except ValueError:
        gain = math.nan
    if not math.isfinite(gain):
        raise LoadError(place, f"gain {row['gain']!r} is not a finite number", line=line)
    blend, fit = (_choose(row, key, choices, place, line) for key, choices in (("blend", BLENDS), ("fit", FITS)))
    return gain, blend, fit


def _choose(row: Mapping[str, str], key: str, choices: tuple[str, ...], place: str, line: int) -> str:
    """What a row says, or the first choice when it says nothing."""
    choice = row.get(key) or choices[0]
    if choice not in choices:
        raise LoadError(place, f"{key} {choice!r} is not {' or '.join(choices)}", line=line)
    return choice
