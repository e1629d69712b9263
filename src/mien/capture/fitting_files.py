"""Points of a head from files: the solution of a capture project, or a table of places."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mien.core import LoadError, MienError, UnknownNameError

from .fitting_places import find_place, known_places
from .project_records import METRES
from .project_tables import Row, read_table

if TYPE_CHECKING:
    from mien.core.mesh import Points
    from mien.faces.head.measured import Floats

    from .records import Solution, SolvedPoint

COLUMNS = ("point", "x", "y", "z")
NEUTRAL, REST = "neutral", "rest"
"""Moments that are taken for the neutral face, if there are several."""

SHOWN = 5


@dataclass(frozen=True, eq=False)
class MeasuredFace:
    """Points of one face by names that a head knows.

    Attributes:
        points: name -> (3,) m.
        covariances: name -> (3, 3) m².
        remarks: what was left out.
    """

    points: Mapping[str, Points]
    covariances: Mapping[str, Floats]
    remarks: tuple[str, ...] = ()


def read_names(path: Path) -> dict[str, str]:
    """Own name of a point -> name that a head knows, from a table ``point,landmark``.

    Raises:
        LoadError: all that is wrong with the file.
    """

    def read(row: Row) -> tuple[str, str]:
        find_place(row.text("landmark"))
        return row.text("point"), row.text("landmark")

    rows = read_table(path, ("point", "landmark"), (), read)
    out: dict[str, str] = {}
    for line, (own, name) in rows:
        if own in out:
            raise LoadError(path, f"point {own!r} is there twice", line=line)
        if name in out.values():
            raise LoadError(path, f"landmark {name!r} is there twice", line=line)
        out[own] = name
    if not out:
        raise LoadError(path, "names no point", hint="want rows such as 12,pronasale")
    return out


def read_face(
    path: Path, *, unit: str = "m", sigma_m: float, names: Mapping[str, str] | None = None, moment: str = ""
) -> MeasuredFace:
    """The points of a face.

    Args:
        path: folder of a solved capture project, or a table ``point,x,y,z`` that may have a column ``sigma``.
        unit: of the table.
        sigma_m: standard deviation of points that have none.
        names: own name -> name that a head knows; then only these are used.
        moment: of a project that has several; empty for the neutral one.

    Raises:
        LoadError, UnknownNameError: the files cannot be understood.
        MienError: there is no such moment, or none of the points is one of a head.
    """
    if path.is_dir():
        from .project import read_solution

        return _from_solution(path, read_solution(path), names, moment)
    if moment:
        raise MienError(f"{path}: a table has no moments — they belong to the folder of a capture project")
    return _from_table(path, unit, sigma_m, names)


def _from_table(path: Path, unit: str, sigma_m: float, names: Mapping[str, str] | None) -> MeasuredFace:
    if unit not in METRES:
        raise UnknownNameError("unit", unit, METRES)
    metres = METRES[unit]

    def read(row: Row) -> tuple[str, Points, float]:
        name = _known(row.text("point"), names)
        sigma = row.number("sigma", sigma_m / metres) * metres
        if sigma <= 0.0:
            raise MienError(f"column 'sigma': want more than 0, got {row.cells['sigma']}")
        return name, metres * np.array([row.number(axis) for axis in "xyz"]), sigma

    points: dict[str, Points] = {}
    covariances: dict[str, Floats] = {}
    for line, (name, place, sigma) in read_table(path, COLUMNS, ("sigma",), read):
        if name in points:
            raise LoadError(path, f"point {name!r} is there twice", line=line)
        if name:
            points[name], covariances[name] = place, sigma**2 * np.eye(3)
    return MeasuredFace(points, covariances)


def _known(own: str, names: Mapping[str, str] | None) -> str:
    """The name that a head knows; empty for a point that is not to be used."""
    if names is not None:
        return names.get(own, "")
    find_place(own)
    return own


def _from_solution(folder: Path, solution: Solution, names: Mapping[str, str] | None, moment: str) -> MeasuredFace:
    chosen = _moment(folder, solution, moment)
    measured = {
        name: point for (when, name), point in solution.points.items() if when == chosen and point.kind != "reference"
    }
    wanted = names or {name: name for name in measured if name in known_places()}
    used: dict[str, SolvedPoint] = {known: measured[own] for own, known in wanted.items() if own in measured}
    if not used:
        raise MienError(
            f"{folder}: none of the {len(measured)} points of moment {chosen!r} has the name of a place on a head — "
            "say which is which in a table point,landmark: --landmarks FILE"
        )
    others = [name for name in measured if name not in wanted]
    remarks = []
    if others:
        shown = ", ".join(others[:SHOWN]) + (" …" if len(others) > SHOWN else "")
        remarks.append(f"{len(others)} points that are no places of a head took no part: {shown}")
    return MeasuredFace(
        {name: point.place for name, point in used.items()},
        {name: point.covariance for name, point in used.items()},
        tuple(remarks),
    )


def _moment(folder: Path, solution: Solution, moment: str) -> str:
    there = list(dict.fromkeys(when for when, _ in solution.points))
    if moment:
        if moment not in there:
            raise UnknownNameError("moment", moment, there)
        return moment
    for name in (NEUTRAL, REST):
        if name in there:
            return name
    if len(there) != 1:
        raise MienError(
            f"{folder}: which of the moments {', '.join(there)} is the neutral face? Say --moment {there[0]}"
            if there
            else f"{folder}: the solution has no points"
        )
    return there[0]
