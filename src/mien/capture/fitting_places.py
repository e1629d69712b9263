"""Places on the head by name: landmarks, the 68 points of 300-W, and vertices of its cage."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from mien.core import UnknownNameError

if TYPE_CHECKING:
    from mien.core.sparse import SparseMatrix
    from mien.faces.head.measured import Floats

EYES = ("eye_centre_L", "eye_centre_R")
"""Rows after those of the cage."""

LEFT, RIGHT = ".left", ".right"
HIDDEN = ("mi", "mj", "mk", "ei", "ej", "u", "v")
"""Rings inside the mouth, behind the lids and in the nostrils."""

MM_PER_M = 1000.0


@dataclass(frozen=True, eq=False)
class Place:
    """What a name stands for.

    Attributes:
        rows: numbers of vertices of the cage, or of the eyes after them.
        weights: of each; their sum is 1.
        apart_m: how far it may lie from what others mean by the name.
    """

    rows: tuple[int, ...]
    weights: tuple[float, ...]
    apart_m: float = 0.0


@cache
def known_places() -> Mapping[str, Place]:
    """All places by name. A vertex of the cage without a side lies on the left or on the midline."""
    from mien.faces.head.measured import archive
    from mien.faces.head.residual import refine_cage
    from mien.faces.head.shipped import shipped_rows

    head, matrix = archive(), refine_cage(archive())
    out = {name: Place((len(head.mirror) + number,), (1.0,)) for number, name in enumerate(EYES)}
    for row in shipped_rows("landmarks"):
        second, third = float(row["second"]), float(row["third"])
        corners = zip((int(row[key]) for key in "abc"), (1.0 - second - third, second, third), strict=True)
        out[row["name"]] = _through(matrix, corners, float(row["apart_mm"]) / MM_PER_M)
    for name, number in head.vertex.items():
        if (name[0] if name[0] in "uv" else name.partition("_")[0]) in HIDDEN:
            continue
        out[name] = out[name + LEFT] = _through(matrix, [(number, 1.0)], 0.0)
        out[name + RIGHT] = _through(matrix, [(int(head.mirror[number]), 1.0)], 0.0)
    return out


def _through(matrix: SparseMatrix, corners: Iterable[tuple[int, float]], apart_m: float) -> Place:
    """A place of refined vertices and weights, told by vertices of the cage."""
    total: dict[int, float] = {}
    for vertex, weight in corners:
        entries = slice(matrix.starts[vertex], matrix.starts[vertex + 1])
        for column, share in zip(matrix.columns[entries].tolist(), matrix.weights[entries].tolist(), strict=True):
            total[column] = total.get(column, 0.0) + weight * share
    return Place(tuple(total), tuple(total.values()), apart_m)


def find_place(name: str) -> Place:
    """The place of a name.

    Raises:
        UnknownNameError: there is none, with names like it.
    """
    places = known_places()
    if name not in places:
        raise UnknownNameError("point of the head", name, places)
    return places[name]


def weights_of(places: Iterable[Place], row_count: int) -> Floats:
    """(N, R) weights of places over the rows of cage and eyes."""
    some = list(places)
    out = np.zeros((len(some), row_count))
    for number, place in enumerate(some):
        out[number, list(place.rows)] = place.weights
    return out
