"""Expressions that no reference has as a whole: mixtures of measured ones, and bells around named points.

``data/mixtures.csv`` says which share of which expression goes in; ``data/bells.csv`` where a bell stands on the left
half, how far it reaches and where it moves its middle, in millimetres; the right half mirrors it.

Source: the muscles are those of Ekman, Friesen and Hager 2002, Facial Action Coding System; the amounts are our own.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mien.core import UnknownNameError, exact
from mien.core.mesh import Points

from .falloff import own_side
from .shipped import shipped_rows
from .units import MM

BELL_END = 0.01
"""A bell ends, without a step, where it has faded to this."""

SIDE_RAMP_M, MIDDLE_RAMP_M = 0.006, 0.016
"""Over which width a bell fades towards the midline, and an expression of both halves is divided between them."""


def derived_morphs(morphs: Mapping[str, Points], points: Points, vertex: Mapping[str, int]) -> dict[str, Points]:
    """Name -> (V, 3) m of every expression that the tables make.

    Args:
        morphs: measured expressions.
        points: (V, 3) m, at rest.
        vertex: number of each named vertex of the left half.

    Raises:
        UnknownNameError: a table names an expression that is not measured.
    """
    out: dict[str, Points] = {}

    def add(row: Mapping[str, str], left: Points, right: Points) -> None:
        if row["sides"]:
            parts = {f"{row['morph']}_L": left, f"{row['morph']}_R": right}
        else:
            parts = {row["morph"]: left + right}
        for name, part in parts.items():
            out[name] = out[name] + part if name in out else part

    for row in shipped_rows("mixtures"):
        share = float(row["share"])
        left, right = halves(morphs, points, row["part"])
        add(row, share * left, share * right)
    for row in shipped_rows("bells"):
        place = points[vertex[row["vertex"]]]
        add(row, _bell(points, place, 1, row), _bell(points, place, -1, row))
    return out


def halves(morphs: Mapping[str, Points], points: Points, name: str) -> tuple[Points, Points]:
    """(V, 3) m of an expression on the left and on the right; one that was measured whole is divided softly."""
    if f"{name}_L" in morphs:
        return morphs[f"{name}_L"], morphs[f"{name}_R"]
    if name not in morphs:
        raise UnknownNameError("expression", name, morphs)
    left = exact.smoothstep(0.5 + 0.5 * points[:, 0] / MIDDLE_RAMP_M)[:, None]
    return left * morphs[name], (1.0 - left) * morphs[name]


def _bell(points: Points, place: Points, side: int, row: Mapping[str, str]) -> Points:
    """(V, 3) m of a Gaussian bell in space on the left (1) or right (-1); 1/e of its height is left at its reach."""
    reach = np.array([float(row[f"reach_{axis}"]) for axis in "xyz"]) * MM
    move = np.array([side * float(row["out"]), float(row["up"]), float(row["forward"])]) * MM
    away = (points - place * (side, 1, 1)) / reach
    faded = exact.exp(-(away[:, 0] * away[:, 0] + away[:, 1] * away[:, 1] + away[:, 2] * away[:, 2]))
    weight = np.maximum((faded - BELL_END) / (1.0 - BELL_END), 0.0) * own_side(points, side, SIDE_RAMP_M)
    return weight[:, None] * move
