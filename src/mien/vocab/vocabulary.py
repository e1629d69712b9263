"""Other people's names for what a face can do, as tables of parameters."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from mien.core import Parameter, ParameterTable, UnknownNameError

from .tables import Row, shipped_rows


@cache
def vocabularies() -> Mapping[str, str]:
    """What each vocabulary is, by its name."""
    return {row["name"]: row["doc"] for row in shipped_rows("vocabularies")}


@cache
def vocabulary(name: str) -> ParameterTable:
    """The names of a vocabulary with their ranges, units and meanings.

    Nearly all rest at 0, where nothing moves; motors of ToonFace rest where they lie in a face of middling features.

    Spellings that other programs use (``eyeBlink_L``, ``EyeBlinkLeft``) are aliases.

    Raises:
        UnknownNameError: there is no such vocabulary.
    """
    if name not in vocabularies():
        raise UnknownNameError("vocabulary", name, vocabularies())
    rows = shipped_rows(name)
    aliases = {alias: row["name"] for row in rows for alias in row.get("aliases", "").split()}
    return ParameterTable(tuple(_parameter(row) for row in rows), aliases)


def _parameter(row: Row) -> Parameter:
    return Parameter(
        row["name"],
        float(row.get("low", "0")),
        float(row.get("high", "1")),
        float(row.get("default", "0")),
        unit=row.get("unit", "share"),
        group=row["group"],
        odd=row.get("odd") == "1",
        doc=row["doc"],
        source=row["source"],
    )
