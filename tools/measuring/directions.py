"""Directions in which heads differ: one measure each, within one region of our skin."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .people import Population
from .skin import MM, Skin, as_stored

TABLE = Path(__file__).with_name("directions.csv")
SMOOTHING, SMOOTHING_SHARE = 3, 0.3
LEFT, RIGHT = ".left", ".right"


@dataclass(frozen=True, eq=False)
class Direction:
    """What one parameter does at its high end; the low end is the opposite.

    Attributes:
        name: of the parameter.
        field: (S, 3) m.
        region: (S,) 0..1; the field is 0 where it is.
        end_mm: the largest displacement.
        sd_mm: the same for one standard deviation of its measure among people.
    """

    name: str
    field: np.ndarray
    region: np.ndarray
    end_mm: float
    sd_mm: float


def measure_directions(population: Population, skin: Skin) -> list[Direction]:
    """All directions of the table; a left one is followed by its mirror image."""
    out = []
    with TABLE.open(encoding="utf-8", newline="") as lines:
        for row in csv.DictReader(lines):
            direction = _measure(row, population, skin)
            out.append(direction)
            if row["name"].endswith(LEFT):
                out.append(_right(direction, skin))
    return out


def _measure(row: dict[str, str], population: Population, skin: Skin) -> Direction:
    region = skin.region(row["path"], float(row["full_mm"]), float(row["reach_mm"]), row["still"].split())
    field = population.direction(row["landmarks"], row["apart"].split(";") if row["apart"] else (), row["label"])
    field = skin.relative(skin.symmetric(field), _still(row["relative_to"], region, skin))
    field = skin.symmetric(skin.smoothed(field, SMOOTHING, SMOOTHING_SHARE))
    if row["name"].endswith(LEFT):
        region = as_stored(region * skin.left_share)
    field = field * region[:, None]
    sd_mm = float(np.linalg.norm(field, axis=1).max()) / MM
    end_mm = float(row["end_mm"])
    return Direction(row["name"], field * (end_mm / sd_mm), region, end_mm, sd_mm)


def _still(relative_to: str, region: np.ndarray, skin: Skin) -> np.ndarray:
    """(S,) whether a vertex is what a direction is relative to: all beyond its region, or sets of still vertices."""
    if relative_to == "rim":
        return region == 0.0
    return np.isin(np.arange(len(region)), np.concatenate([skin.still[name] for name in relative_to.split()]))


def _right(left: Direction, skin: Skin) -> Direction:
    name = left.name.removesuffix(LEFT) + RIGHT
    return Direction(name, skin.mirrored(left.field), left.region[skin.archive.mirror], left.end_mm, left.sd_mm)
