"""What can be wrong with a file of a drawn face, and how it is told."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import Literal

Severity = Literal["error", "warning"]
SHOWN = 48
"""Characters of a value or key that a message shows."""

Place = tuple[str | int, ...]
"""The keys and numbers that lead to a value."""


@dataclass(frozen=True)
class Rule:
    """One row of ``data/faults.csv``: a kind of fault, what it means and what to try."""

    name: str
    severity: Severity
    meaning: str
    hint: str


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong.

    Attributes:
        rule: which kind, a name of ``rules()``.
        place: where in the document; empty for the document itself.
        what: what is wrong there.
        wanted: what would be right; may be empty.
        got: what is there instead; may be empty.
        hint: what to try; empty for what the rule says.
        severity: None for that of the rule.
        line: in the file, from 1, where it is known.
        who: id of the polygon that it is in, if in one.
    """

    rule: str
    place: Place
    what: str
    wanted: str = ""
    got: str = ""
    hint: str = ""
    severity: Severity | None = None
    line: int | None = None
    who: str = ""

    @property
    def grave(self) -> bool:
        """Whether the face cannot be used as it is."""
        return (self.severity or rules()[self.rule].severity) == "error"

    @property
    def advice(self) -> str:
        """What to try."""
        return self.hint or rules()[self.rule].hint

    def text(self) -> str:
        """All of it in a line, without the file and the line in it."""
        wanted = ": " * bool(self.wanted or self.got) + ", ".join(
            f"{word} {value}" for word, value in (("want", self.wanted), ("got", self.got)) if value
        )
        kind = "error" if self.grave else "warning"
        who = f" ({self.who[:SHOWN]})" if self.who else ""
        return f"{kind}: {format_place(self.place) or 'document'}{who}: {self.what}{wanted} — {self.advice}"


@cache
def rules() -> Mapping[str, Rule]:
    """All kinds of faults by name."""
    text = files(__package__).joinpath("data", "faults.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(text.splitlines())
    return MappingProxyType(
        {
            row["rule"]: Rule(
                row["rule"], "error" if row["severity"] == "error" else "warning", row["meaning"], row["hint"]
            )
            for row in rows
        }
    )


def format_place(place: Place) -> str:
    """``polygons[3].path`` for the keys and numbers that lead there."""
    parts = (f"[{key}]" if isinstance(key, int) else f".{key[:SHOWN]}" for key in place)
    return "".join(parts).removeprefix(".")
