"""``marks.csv``: names of the points of a topology, and by what those are guessed that no two photographs show."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mien.core import LoadError
from mien.core.mesh import Points
from mien.faces.keypose.records import UNITS_M

MARKS = "marks.csv"
COLUMNS = ("number", "name", "body", "follows", "touches", "x", "y", "z")


@dataclass(frozen=True, eq=False)
class Marks:
    """What is known of the points besides photographs.

    Attributes:
        names: (N,) as they are clicked by, in the order of their numbers.
        bodies: (N,) what keeps its shape and the point belongs to, such as ``eye``; empty for what bends.
        follows: (N,) names of points that it goes along with as long as too little of its own part is seen.
        model: (N, 3) m, where it lies on another head; None if there is none.
        touches: (N,) moments and the points that it lies on then, unless it is seen: ``blink`` and a point of the
            other lid.
    """

    names: tuple[str, ...]
    bodies: tuple[str, ...]
    follows: tuple[tuple[str, ...], ...]
    model: Points | None = None
    touches: tuple[tuple[tuple[str, str], ...], ...] = ()


def plain_marks(count: int) -> Marks:
    """Marks of points that are called by their numbers."""
    return Marks(tuple(str(number + 1) for number in range(count)), ("",) * count, ((),) * count)


def read_marks(path: Path, count: int, unit: str) -> Marks:
    """The marks of ``count`` points.

    Raises:
        LoadError: a row cannot be understood, a point is missing or named twice; with its line.
    """
    rows: dict[int, tuple[int, dict[str, str]]] = {}
    try:
        with path.open(encoding="utf-8", newline="") as lines:
            reader = csv.DictReader(lines, strict=True)
            if tuple(reader.fieldnames or ()) != COLUMNS:
                raise LoadError(path, f"want the columns {','.join(COLUMNS)}, got {reader.fieldnames}", line=1)
            for row in reader:
                _put(path, rows, row, count, reader.line_num)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise LoadError(path, f"cannot be read: {error}") from None
    missing = [number for number in range(1, count + 1) if number not in rows]
    if missing:
        raise LoadError(path, f"point {missing[0]} is missing", hint=f"want a row for each of 1 to {count}")
    ordered = [rows[number] for number in range(1, count + 1)]
    names = tuple(row["name"] for _, row in ordered)
    for line, row in ordered:
        if names.count(row["name"]) > 1:
            raise LoadError(path, f"name {row['name']!r} is there twice", line=line)
        for verb, named in (("follows", row["follows"].split()), ("touches", [name for _, name in _touched(row)])):
            for name in named:
                if name not in names:
                    raise LoadError(path, f"{verb} {name!r}, which is no point", line=line)
    model = np.array([_place(path, line, row, UNITS_M[unit]) for line, row in ordered])
    return Marks(
        names,
        tuple(row["body"] for _, row in ordered),
        tuple(tuple(row["follows"].split()) for _, row in ordered),
        model if np.isfinite(model).all() else None,
        tuple(_touched(row) for _, row in ordered),
    )


def format_marks(marks: Marks, unit: str) -> str:
    """The text of the file; places to three decimals."""
    lines = [",".join(COLUMNS)]
    for number, name in enumerate(marks.names):
        place = ("", "", "") if marks.model is None else (f"{x / UNITS_M[unit]:.3f}" for x in marks.model[number])
        touched = " ".join(f"{moment}:{other}" for moment, other in marks.touches[number]) if marks.touches else ""
        row = (str(number + 1), name, marks.bodies[number], " ".join(marks.follows[number]), touched, *place)
        lines.append(",".join(row))
    return "\n".join([*lines, ""])


def _touched(row: dict[str, str]) -> tuple[tuple[str, str], ...]:
    """Moments and points, of words such as ``blink:e0_9``."""
    split = (word.partition(":") for word in row["touches"].split())
    return tuple((moment, name) for moment, _, name in split)


def _put(path: Path, rows: dict[int, tuple[int, dict[str, str]]], row: dict[str, str], count: int, line: int) -> None:
    if None in row or None in row.values():
        raise LoadError(path, f"want {len(COLUMNS)} fields", line=line)
    number = row["number"]
    if not (number.isascii() and number.isdecimal() and 1 <= int(number) <= count):
        raise LoadError(
            path, f"point {number!r} is not in 1..{count}", line=line, hint="does topology.txt belong to it?"
        )
    if int(number) in rows:
        raise LoadError(path, f"point {number} is there twice", line=line)
    if not row["name"]:
        raise LoadError(path, f"point {number} has no name", line=line)
    rows[int(number)] = line, row


def _place(path: Path, line: int, row: dict[str, str], unit_m: float) -> list[float]:
    texts = [row[axis] for axis in "xyz"]
    if texts == ["", "", ""]:
        return [np.nan] * 3
    try:
        place = [float(text) * unit_m for text in texts]
    except ValueError:
        place = [np.inf]
    if not np.isfinite(place).all():
        raise LoadError(path, f"want x, y and z as numbers, or none of them, got {','.join(texts)}", line=line)
    return place
