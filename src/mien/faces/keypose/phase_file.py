"""Phase files: number and place of every point.

Source: Parke 1972, "The animation program" (for each point a point number and a three-dimensional position).
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from mien.core import LoadError
from mien.core.mesh import Points

from .lines import read_lines
from .records import UNITS_M

MOST_M = 1.0
"""No point of a head is so far from its middle; a unit that is not the file's shows here."""

NAMED = 8
"""How many missing points an error names."""


def read_phase(path: Path, count: int, unit: str = "mm") -> Points:
    """Places (N, 3) m of one measured phase; lines are ``number x y z``, in any order.

    Args:
        path: the file.
        count: N, how many points the topology has.
        unit: of the numbers, of ``UNITS_M``.

    Raises:
        LoadError: with the line that is wrong; a point is missing, twice there or not in the topology.
    """
    places: list[tuple[float, ...]] = [()] * count
    seen: dict[int, int] = {}
    most = MOST_M / UNITS_M[unit]
    for line, words in read_lines(path):
        point, place = _parse(path, words, line, count)
        if point in seen:
            raise LoadError(path, f"point {point} is in line {seen[point]} already", line=line)
        seen[point] = line
        places[point - 1] = place
        if max(map(abs, place)) >= most:
            raise LoadError(
                path, f"point {point} is a metre or more from the middle", line=line, hint=f"is the unit {unit}?"
            )
    missing = [point for point in range(1, count + 1) if point not in seen]
    if missing:
        named = ", ".join(map(str, missing[:NAMED])) + (" …" if len(missing) > NAMED else "")
        raise LoadError(
            path,
            f"{len(missing)} of {count} points are missing: {named}",
            hint="was this phase measured on another topology?",
        )
    return np.array(places) * UNITS_M[unit]


def _parse(path: Path, words: list[str], line: int, count: int) -> tuple[int, tuple[float, ...]]:
    got = " ".join(words)
    if len(words) != 4 or not (words[0].isascii() and words[0].isdecimal()):
        raise LoadError(path, f"want 'number x y z', got {got!r}", line=line)
    try:
        place = tuple(map(float, words[1:]))
    except ValueError:
        raise LoadError(path, f"want 'number x y z', got {got!r}", line=line) from None
    if not all(map(math.isfinite, place)):
        raise LoadError(path, f"a number is not finite: {got!r}", line=line)
    if len(words[0]) > 9 or not 1 <= int(words[0]) <= count:
        raise LoadError(
            path,
            f"point {words[0]} is in no polygon of the topology, which has 1..{count}",
            line=line,
            hint="was this phase measured on another topology?",
        )
    return int(words[0]), place


def format_phase(places: Points, unit: str) -> str:
    """The text of a phase file: places (N, 3) m in the unit, to a nanometre."""
    decimals = round(math.log10(UNITS_M[unit] * 1e9))
    rows = np.asarray(places) / UNITS_M[unit]
    return "".join(
        f"{number} {' '.join(_shortest(value, decimals) for value in row)}\n"
        for number, row in enumerate(rows.tolist(), start=1)
    )


def _shortest(value: float, decimals: int) -> str:
    return f"{round(value, decimals) + 0.0:.{decimals}f}".rstrip("0").rstrip(".")
