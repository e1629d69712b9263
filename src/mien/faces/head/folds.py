"""Folds of the skin: where moves press it together it lies in its own shadow.

``data/folds.csv`` says how much darker the vertices of the left half become, or lighter where skin bulges beside a
fold, and ``data/fold_drivers.csv`` which parameters make each fold and how much of it a unit of them makes.

Source: the folds of each action unit as Ekman, Friesen and Hager 2002 describe them; the amounts are our own.
"""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mien.compiling import kernel
from mien.core import ParameterTable
from mien.core.mesh import Ints, Points

from .measured import Archive, Floats, Kind
from .moves import Move
from .shipped import shipped_rows
from .table import head_table

TINT = (0.80, 1.00, 1.08)
"""How fast red, green and blue go dark in a fold: light that gets there has met skin before."""


SHARPER: Mapping[Kind, float] = {"cage": 1.0, "surface": 0.55}
"""Share of the dark that is painted: subdivision spreads that of a cage's vertex over what is around it."""


@dataclass(frozen=True, eq=False)
class Folds:
    """The folds of both halves as arrays.

    Attributes:
        drivers: (D, 2) column of a parameter, and the fold that it makes.
        rules: (D, 2) resting value, and how much of the fold a unit makes.
        places: (K, 2) vertex, and the fold that darkens it.
        dark: (K,) share of its light that a full fold takes.
        count: of folds.
    """

    drivers: Ints
    rules: Floats
    places: Ints
    dark: Floats
    count: int


@dataclass(frozen=True)
class Driver:
    """A parameter that makes a fold.

    Attributes:
        fold: its name.
        side: 0 left, 1 right.
        parameter: its name, with its side.
        rest: value that makes none of it.
        gain: how much of it a unit makes.
    """

    fold: str
    side: int
    parameter: str
    rest: float
    gain: float


def drivers() -> list[Driver]:
    """The rows of ``data/fold_drivers.csv``, left ones first."""
    table, out = head_table(), []
    for side, end in enumerate((".left", ".right")):
        for row in shipped_rows("fold_drivers"):
            name = row["parameter"] if row["parameter"] in table.index else row["parameter"] + end
            out.append(Driver(row["fold"], side, name, table[name].default, float(row["gain"])))
    return out


def fold_moves(morphs: Mapping[str, Points]) -> list[Move]:
    """The grooves of folds that have some in ``data/bells.csv``, as deep as their shade is dark."""
    out = []
    for driver in drivers():
        groove = morphs.get(f"{driver.fold}Fold_{'LR'[driver.side]}")
        if groove is not None:
            way = 1.0 if driver.gain > 0.0 else -1.0
            out.append(Move(driver.parameter, groove, abs(driver.gain), driver.rest, way, one_way=True))
    return out


def folds_of(archive: Archive, table: ParameterTable, skin: Ints, kind: Kind) -> Folds:
    """The folds of a head whose vertices are copies of the measured vertices ``skin`` (K,)."""
    names = list(dict.fromkeys(row["fold"] for row in shipped_rows("folds")))
    made = [(table.index[each.parameter], 2 * names.index(each.fold) + each.side) for each in drivers()]
    rules = [(each.rest, each.gain) for each in drivers()]
    places, dark = [], []
    for row in shipped_rows("folds"):
        left = archive.vertex[row["vertex"]]
        right = int(archive.mirror[left])
        # The midline belongs to both halves.
        share = 0.5 if left == right else 1.0
        for side, vertex in enumerate((left, right)):
            for copy in np.flatnonzero(skin == vertex):
                places.append((int(copy), 2 * names.index(row["fold"]) + side))
                dark.append(share * SHARPER[kind] * float(row["dark"]))
    return Folds(np.array(made), np.array(rules), np.array(places), np.array(dark), 2 * len(names))


@kernel()
def fold_skin(values, drivers, rules, places, dark, amounts, colors):
    """Darken the colours (V, 3) of a head in a pose (P,) where its skin folds; ``amounts`` (G,) is overwritten."""
    for fold in range(len(amounts)):
        amounts[fold] = 0.0
    for n in range(len(drivers)):
        amounts[drivers[n, 1]] += max((values[drivers[n, 0]] - rules[n, 0]) * rules[n, 1], 0.0)
    for k in range(len(places)):
        depth = dark[k] * min(amounts[places[k, 1]], 1.0)
        for channel in range(3):
            lit = colors[places[k, 0], channel] * (1.0 - depth * TINT[channel])
            colors[places[k, 0], channel] = min(lit, 1.0)
