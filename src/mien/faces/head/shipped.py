"""Texts and tables of ``data/``, which ship with the head."""

from __future__ import annotations

import csv
from functools import cache
from importlib.resources import files


def shipped_text(name: str) -> str:
    """The text of ``data/NAME``."""
    return files(__package__).joinpath("data", name).read_text(encoding="utf-8")


@cache
def shipped_rows(table: str) -> tuple[dict[str, str], ...]:
    """Rows of ``data/TABLE.csv``, first to last."""
    return tuple(csv.DictReader(shipped_text(f"{table}.csv").splitlines()))
