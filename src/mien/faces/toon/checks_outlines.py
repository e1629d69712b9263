"""Outlines that cannot be read, enclose nothing, cross themselves or differ from state to state."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice
from typing import Any

import numpy as np

from mien.core import MienError

from .checks_crossing import find_crossings
from .checks_faults import Fault, Place
from .checks_sheet import Sheet
from .outlines import flatten, parse_path, piece_steps, polygon_outline
from .polygon_reader import MOST_POINTS
from .records import Floats, Outline

MOST_VERTICES = 20_000
"""Of one outline; more are not looked through for crossings."""

FLAT = 1e-9
"""Area of an outline, as a share of the square around it, below which there is nothing to fill."""

COUNTED = 20
"""Crossings of one outline that are counted."""

WORDS = {"L": "line", "C": "curve"}


def find_wrong_outlines(sheet: Sheet) -> Iterator[Fault]:
    """All faults of outlines by themselves."""
    outlines: dict[Place, Outline] = {}
    for place, data in sheet.outlines():
        try:
            outlines[place] = parse_path(data) if isinstance(data, str) else polygon_outline(data)
        except MienError as error:
            what, _, hint = str(error).removeprefix("path data: ").partition(" — ")
            yield Fault("path", place, what, hint=hint)
    total = sum(map(len, outlines.values()))
    if total > MOST_POINTS:
        yield Fault("large", ("polygons",), "have too many points", f"{MOST_POINTS} at most", str(total))
        return
    polygons = dict(sheet.polygons)
    for place, outline in outlines.items():
        polygon = polygons[place[1]] if isinstance(place[1], int) else {}
        if any(np.abs(command.points).max() > 1e5 for command in outline):
            yield Fault("range", place, "has a number that is out of range", "positions within 100000 of 0")
        elif "width" in polygon:
            yield from _brush(place, outline)
        else:
            yield from _area(place, outline, _rule(sheet, polygon), str(polygon.get("kind")))
    yield from _states(sheet, outlines)


def _rule(sheet: Sheet, polygon: Mapping[str, Any]) -> str:
    return str(polygon.get("rule", "evenodd" if sheet.strict else "nonzero"))


def _brush(place: Place, outline: Outline) -> Iterator[Fault]:
    points = np.concatenate([command.points for command in outline])
    if not np.ptp(points, axis=0).any():
        yield Fault("empty", place, "is a single point, along which no brush can go", "a line")


def _area(place: Place, outline: Outline, rule: str, kind: str) -> Iterator[Fault]:
    contours = flatten(outline, piece_steps([outline], bend=False))
    areas = [_enclosed(contour) for contour in contours]
    empty = [number for number, area in enumerate(areas) if not area]
    if len(empty) == len(contours):
        yield Fault("empty", place, "encloses nothing", "an area")
        return
    for number in empty:
        x, y = contours[number][0]
        yield Fault("empty", place, f"the contour at ({x:g}, {y:g}) encloses nothing", severity="warning")
    if (count := max(map(len, contours))) > MOST_VERTICES:
        wanted = f"{MOST_VERTICES} at most"
        yield Fault("large", place, "has very many vertices", wanted, str(count), severity="warning")
        return
    for contour, pieces in zip(contours, _pieces(outline), strict=True):
        crossings = list(islice(find_crossings(contour), COUNTED + 1))
        if crossings:
            first = crossings[0]
            one, other = (pieces[min(edge, len(pieces) - 1)] for edge in (first.first, first.second))
            where = f"near ({first.at[0]:.4g}, {first.at[1]:.4g})"
            what = f"{one} crosses itself {where}" if one == other else f"{one} crosses {other} {where}"
            if len(crossings) > 1:
                what += f", and {'more than ' * (len(crossings) > COUNTED)}{min(len(crossings), COUNTED + 1) - 1} more"
            grave = rule == "evenodd" or kind == "hole"
            yield Fault("crossing", place, what, severity="error" if grave else "warning")


def _enclosed(contour: Floats) -> float:
    """Area that a contour (N, 2) encloses in either sense; 0 when it is as good as none."""
    x, y = (contour - contour[0]).T
    extent = float(np.ptp(contour, axis=0).max())
    # A figure of eight may enclose as much one way as the other, but not on all of its pieces.
    pieces = np.abs(x * np.roll(y, -1) - y * np.roll(x, -1))
    return float(pieces.sum()) if float(pieces.sum()) > FLAT * extent * extent else 0.0


def _pieces(outline: Outline) -> list[list[str]]:
    """What each edge of each contour is called: a word for the piece of the outline that it belongs to."""
    named: list[list[str]] = []
    for command, count in zip(outline, piece_steps([outline], bend=False), strict=True):
        x, y = command.points[-1]
        if command.kind == "M":
            named.append([f"the closing line to ({x:g}, {y:g})"])
        else:
            named[-1][-1:-1] = [f"the {WORDS[command.kind]} to ({x:g}, {y:g})"] * count
    return named


def _states(sheet: Sheet, outlines: Mapping[Place, Outline]) -> Iterator[Fault]:
    """States whose outlines cannot become one another."""
    for number, polygon in sheet.polygons:
        low = outlines.get(("polygons", number, "min"))
        high = outlines.get(("polygons", number, "max"))
        if low and high:
            yield from _compare(low, high, "min", ("polygons", number, "max"))
        rest = outlines.get(("polygons", number, "path"))
        driven: list[Place] = [("polygons", number, "drivers", row) for row in range(len(polygon.get("drivers", ())))]
        if part := polygon.get("part"):
            driven += [("parts", part, row) for row in range(len(sheet.sound("parts", part) or ()))]
        for place in driven:
            for key in ("min", "max"):
                state = outlines.get((*place, key))
                if state and rest:
                    yield from _compare(rest, state, "the path", (*place, key))
                elif state and "path" not in polygon:
                    what = f"is an outline, but {polygon['id']!r} has no path that could become it"
                    yield Fault("states", (*place, key), what, "a movement")


def _compare(one: Outline, other: Outline, name: str, place: Place) -> Iterator[Fault]:
    wanted, got = (" ".join(command.kind for command in outline) for outline in (one, other))
    if wanted == got:
        return
    if len(one) != len(other):
        what = f"has {len(other)} pieces, but {name} has {len(one)}"
    else:
        number = next(k for k, (a, b) in enumerate(zip(one, other, strict=True)) if a.kind != b.kind)
        what = f"differs from {name} from piece {number + 1} on"
    short = len(wanted) + len(got) < 80
    yield Fault("states", place, what, f"the commands {wanted}" if short else "", got if short else "")
