"""The phases that the tables of names know, from ``data/phases.csv``."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources


@dataclass(frozen=True)
class StandardPhase:
    """A phase that means the same on every face that has it.

    Attributes:
        name: of the phase.
        sided: either side of the face can show it for itself.
        group: of the parameter that weighs it, as are role, closed, doc and source.
        shown: what the whole face shows.
    """

    name: str
    sided: bool
    group: str
    role: str
    closed: float | None
    doc: str
    shown: str
    source: str


@cache
def standard_phases() -> Mapping[str, StandardPhase]:
    """All of them by name, the face at rest first."""
    text = resources.files(__package__).joinpath("data", "phases.csv").read_text(encoding="utf-8")
    return {
        row["name"]: StandardPhase(
            row["name"],
            row["sides"] == "both",
            row["group"],
            row["role"],
            float(row["closed"]) if row["closed"] else None,
            row["doc"],
            row["shown"],
            row["source"],
        )
        for row in csv.DictReader(text.splitlines())
    }
