"""Rows of the tables that ship; a row that names a ``{side}`` stands for two."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from importlib import resources

FOLDER = "data"

Row = dict[str, str]

SIDES = ({"{side}": "left", "{Side}": "Left", "{S}": "L"}, {"{side}": "right", "{Side}": "Right", "{S}": "R"})
"""What stands for a side in a cell: ``eyeBlink{Side}``, ``eyelid.opening.{side}``, ``AU12{S}``."""


def shipped_tables() -> tuple[str, ...]:
    """Names of all tables, without their suffix, sorted."""
    names = (entry.name for entry in resources.files(__package__).joinpath(FOLDER).iterdir())
    return tuple(sorted(name.removesuffix(".csv") for name in names if name.endswith(".csv")))


def shipped_text(name: str) -> str:
    """The text of a table."""
    return resources.files(__package__).joinpath(FOLDER, f"{name}.csv").read_text(encoding="utf-8")


def shipped_rows(name: str) -> tuple[Row, ...]:
    """The rows of a table, those of either side one after the other."""
    return tuple(side for row in csv.DictReader(shipped_text(name).splitlines()) for side in each_side(row))


def each_side(row: Mapping[str, str]) -> tuple[Row, ...]:
    """The row for the left and for the right, when a cell of it names a side; else the row itself."""
    if not any(mark in cell for cell in row.values() for mark in SIDES[0]):
        return (dict(row),)
    return tuple({key: _name_side(cell, side) for key, cell in row.items()} for side in SIDES)


def _name_side(cell: str, side: Mapping[str, str]) -> str:
    for mark, name in side.items():
        cell = cell.replace(mark, name)
    return cell
