"""``points.csv``, ``boards.csv`` and ``references.csv``: what was seen where, and what is known beforehand."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from mien.core import MienError, UnknownNameError

from .project_records import METRES
from .project_tables import Faults, Row, format_table, read_table
from .records import WORLD, Observation, Photograph, Reference

SIGMA_PX = 1.0
"""How exact a click is where nothing is told."""


def read_points(path: Path, photographs: Sequence[Photograph]) -> tuple[Observation, ...]:
    """Points seen in photographs: columns ``photo``, ``point``, ``u``, ``v``, and ``sigma`` if you like.

    Raises:
        LoadError: all that is wrong with the file.
    """
    known = {photograph.name: photograph for photograph in photographs}
    seen: dict[tuple[str, str], int] = {}

    def read(row: Row) -> Observation:
        photo, point = row.text("photo"), row.text("point")
        if photo not in known:
            raise UnknownNameError("photograph", photo, known)
        observation = Observation(
            photo, point, row.number("u"), row.number("v"), row.number("sigma", SIGMA_PX), row.line
        )
        if observation.sigma_px <= 0.0:
            raise MienError(f"column 'sigma': want a number above 0, got {row.cells['sigma']}")
        check_inside(observation, known[photo])
        first = seen.setdefault((photo, point), row.line)
        if first != row.line:
            raise MienError(f"point {point!r} of {photo} was told in line {first} already — leave one of them out")
        return observation

    return tuple(observation for _, observation in read_table(path, ("photo", "point", "u", "v"), ("sigma",), read))


def check_inside(observation: Observation, photograph: Photograph) -> None:
    """Nothing, where a point lies in its photograph.

    Raises:
        MienError: it does not.
    """
    (width, height), u, v = photograph.size_px, observation.u, observation.v
    if 0.0 <= u <= width and 0.0 <= v <= height:
        return
    turned = 0.0 <= v <= width and 0.0 <= u <= height
    hint = "are u and v exchanged?" if turned else "was it clicked in another size of the picture?"
    raise MienError(
        f"point {observation.point!r} at {u:g}, {v:g} lies outside of {photograph.name}, "
        f"which is {width}x{height} pixels upright — {hint}"
    )


def format_points(observations: Iterable[Observation]) -> str:
    """Points as CSV, in the order of photographs and names; a sigma of 1 is left out."""
    rows = sorted(observations, key=lambda seen: (seen.photo, _natural(seen.point)))
    return format_table(
        ("photo", "point", "u", "v", "sigma"),
        [(seen.photo, seen.point, seen.u, seen.v, "" if seen.sigma_px == SIGMA_PX else seen.sigma_px) for seen in rows],
    )


def _natural(name: str) -> tuple[object, ...]:
    """Order in which board:2:10 comes after board:2:9."""
    return tuple((part.zfill(9) if part.isdecimal() else part) for part in name.split(":"))


def read_references(path: Path, unit: str) -> tuple[Reference, ...]:
    """Points of known place: columns ``point``, ``x``, ``y``, ``z``, and ``sigma`` and ``target`` if you like.

    Args:
        path: of the file.
        unit: of its lengths.

    Raises:
        LoadError: all that is wrong with the file.
    """
    metres, seen = METRES[unit], dict[str, int]()

    def read(row: Row) -> Reference:
        name = row.text("point")
        x, y, z = (row.number(axis) * metres for axis in "xyz")
        sigma = row.number("sigma", 0.0)
        if sigma < 0.0:
            raise MienError(f"column 'sigma': want 0 or more, got {sigma:g}")
        first = seen.setdefault(name, row.line)
        if first != row.line:
            raise MienError(f"reference {name!r} was told in line {first} already — leave one of them out")
        return Reference(name, x, y, z, sigma * metres, row.cells["target"] or WORLD)

    rows = read_table(path, ("point", "x", "y", "z"), ("sigma", "target"), read)
    _check_apart(path, rows)
    return tuple(reference for _, reference in rows)


def _check_apart(path: Path, rows: Sequence[tuple[int, Reference]]) -> None:
    """No two references at one place: one of them has the numbers of the other."""
    faults, places = Faults(path), dict[tuple[object, ...], tuple[int, Reference]]()
    for line, reference in rows:
        place = (reference.target, reference.x, reference.y, reference.z)
        first_line, first = places.setdefault(place, (line, reference))
        if first_line != line:
            faults.add(line, f"reference {reference.name!r} is where {first.name!r} of line {first_line} is")
    faults.check()


def format_references(references: Iterable[Reference], unit: str) -> str:
    """References as CSV, in their order; what is the rule (exact, lying still) is left out."""
    metres = METRES[unit]
    rows = []
    for each in references:
        sigma: str | float = each.sigma_m / metres if each.sigma_m else ""
        target = "" if each.target == WORLD else each.target
        rows.append((each.name, *(shorten(x, metres) for x in (each.x, each.y, each.z)), sigma, target))
    return format_table(("point", "x", "y", "z", "sigma", "target"), rows)


def shorten(value_m: float, metres: float) -> float:
    """A length in a unit, told so shortly that it still is read as the same number of metres, if it can be."""
    exact = value_m / metres
    short = float(f"{exact:.12g}") + 0.0
    return short if short * metres == value_m else exact


def merge_points(parts: Mapping[Path, Sequence[Observation]]) -> tuple[Observation, ...]:
    """Points of several files.

    Raises:
        LoadError: two files tell of the same point in the same photograph.
    """
    seen: dict[tuple[str, str], tuple[Path, int]] = {}
    for path, observations in parts.items():
        faults = Faults(path)
        for each in observations:
            other, line = seen.setdefault((each.photo, each.point), (path, each.line))
            if other != path:
                faults.add(each.line, f"point {each.point!r} of {each.photo} stands in {other.name}:{line} too")
        faults.check()
    return tuple(each for observations in parts.values() for each in observations)
