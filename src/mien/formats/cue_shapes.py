"""What the names of mouth shapes mean: four sets of them, as a table, and the mouth of each."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from types import MappingProxyType

REST, SEALED = "rest", ("shut", "tuck")
"""Mouths of a pause, and those that an eye misses: shut for p b m, the lower lip tucked for f v."""


@dataclass(frozen=True)
class ShapeSet:
    """A set of shapes.

    Attributes:
        name: what users call it.
        mouths: the mouth of each shape, of the table ``data/mouths.csv``.
    """

    name: str
    mouths: Mapping[str, str]

    @property
    def rest(self) -> str:
        """The shape of a pause."""
        return self.name_of(REST)

    def is_sealed(self, shape: str) -> bool:
        """Whether lips must not miss it."""
        return self.mouths.get(shape) in SEALED

    def name_of(self, mouth: str) -> str:
        """The first shape with a mouth."""
        return next(shape for shape, each in self.mouths.items() if each == mouth)


def find_set(shapes: Iterable[str]) -> ShapeSet:
    """The set that has most of the shapes; Rhubarb's where several do."""
    there = set(shapes)
    return max(shape_sets().values(), key=lambda each: len(there & each.mouths.keys()))


@cache
def shape_sets() -> Mapping[str, ShapeSet]:
    """All sets by name: of Rhubarb, Preston Blair, Oculus and SAPI."""
    mouths: dict[str, dict[str, str]] = {}
    for row in read_table("shapes"):
        mouths.setdefault(row["set"], {})[row["shape"]] = row["mouth"]
    return MappingProxyType({name: ShapeSet(name, MappingProxyType(each)) for name, each in mouths.items()})


def read_table(name: str) -> tuple[dict[str, str], ...]:
    """The rows of a table of this folder."""
    text = resources.files(__package__).joinpath(f"data/{name}.csv").read_text(encoding="utf-8")
    return tuple(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
