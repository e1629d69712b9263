"""The neutral channels in which speech and gaze speak to every kind of face."""

from __future__ import annotations

import csv
from functools import lru_cache
from importlib import resources

from mien.core import Parameter, ParameterTable


@lru_cache(maxsize=1)
def channel_table() -> ParameterTable:
    """The channels as a table of parameters: names, ranges, units and what they mean. All rest at 0."""
    text = resources.files("mien.vocab").joinpath("data", "channels.csv").read_text(encoding="utf-8")
    return ParameterTable(
        tuple(
            Parameter(
                row["name"],
                float(row["low"]),
                float(row["high"]),
                unit=row["unit"],
                group=row["group"],
                odd=row["odd"] == "1",
                doc=row["doc"],
                source=row["source"],
            )
            for row in csv.DictReader(text.splitlines())
        )
    )
