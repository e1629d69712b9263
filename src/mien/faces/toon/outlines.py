"""Outlines: path data as pieces, pieces as vertices, lines as brush strokes.

Source: Scalable Vector Graphics (SVG) 1.1, W3C Recommendation 2011, section 8.3 (path data).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache
from math import ceil

import numpy as np

from mien.core import MienError, exact

from .records import Command, Floats, Knots, Outline

TOKEN = re.compile(r"[A-Za-z]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[^\s,]")
NUMBERS = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "Z": 0}

LEAST_STEPS, MOST_STEPS = 4, 40
STEPS_OF_LENGTH = 1.5
"""A curve gets this times the square root of its length in pieces: on a circle they miss it by 0.05 units."""

LINE_STEP = 12.0
"""Straight lines are cut into pieces of this length, so that they can bend with what they are attached to."""

CAP_STEPS = 8
"""Pieces of the round end of a stroke."""


def parse_path(text: str) -> Outline:
    """The pieces of path data; every contour is closed.

    Raises:
        MienError: it cannot be understood; arcs are not allowed.
    """
    tokens = TOKEN.findall(text)
    outline: list[Command] = []
    place = start = np.zeros(2)
    handle: np.ndarray | None = None  # the last control point, which S and T reflect
    command, index, after = "", 0, ""
    while index < len(tokens):
        if tokens[index].isalpha():
            command, index = tokens[index], index + 1
        elif not command or command in "Zz":
            raise MienError(f"path data: want a command, got {tokens[index]!r}")
        kind = command.upper()
        if kind not in NUMBERS:
            hint = " — an arc can be written as cubic curves" if kind == "A" else ""
            raise MienError(f"path data: {command!r} is not one of M L H V C S Q T Z{hint}")
        if not outline and kind != "M":
            raise MienError(f"path data: want M first, got {command!r}")
        if kind == "Z":
            place, handle, after = start, None, "Z"
            continue
        given = _numbers(tokens, index, NUMBERS[kind], command)
        index += NUMBERS[kind]
        if after == "Z" and kind != "M":
            outline.append(Command("M", place[None]))
        base = place if command.islower() else np.zeros(2)
        if kind in "HV":
            target = place.copy()
            target["HV".index(kind)] = given[0] + base["HV".index(kind)]
            points = target[None]
        else:
            points = np.reshape(given, (-1, 2)) + base
        if kind == "M":
            outline.append(Command("M", points))
            start, handle = points[0], None
            command = "l" if command.islower() else "L"
        elif kind in "LHV":
            outline.append(Command("L", points))
            handle = None
        else:
            cubic, handle = _cubic(kind, points, place, handle if after in _SMOOTH_AFTER[kind] else None)
            outline.append(Command("C", cubic))
        place, after = points[-1], kind
    if not outline:
        raise MienError("path data: it is empty")
    return tuple(outline)


_SMOOTH_AFTER = {"C": "", "Q": "", "S": "CS", "T": "QT"}


def _numbers(tokens: Sequence[str], index: int, count: int, command: str) -> list[float]:
    try:
        given = [float(token) for token in tokens[index : index + count]]
    except ValueError:
        given = []
    if len(given) < count or not all(abs(number) < 1e9 for number in given):
        got = " ".join(tokens[index : index + count]) or "the end"
        raise MienError(f"path data: {command!r} wants {count} numbers, got {got}")
    return given


def _cubic(kind: str, points: Floats, place: Floats, handle: Floats | None) -> tuple[Floats, Floats]:
    """(3, 2) points of a cubic curve from ``place``, and the control point that a following S or T reflects."""
    mirrored = place if handle is None else 2.0 * place - handle
    if kind in "CS":
        cubic = points if kind == "C" else np.concatenate([mirrored[None], points])
        return cubic, cubic[1]
    middle, end = (points[0], points[1]) if kind == "Q" else (mirrored, points[0])
    return np.stack([place + (middle - place) * (2.0 / 3.0), end + (middle - end) * (2.0 / 3.0), end]), middle


def polygon_outline(points: Sequence[Sequence[float]]) -> Outline:
    """The outline of a closed polygon (N, 2)."""
    array = np.asarray(points, dtype=np.float64)
    return (Command("M", array[:1]), *(Command("L", point[None]) for point in array[1:]))


def same_pieces(one: Outline, other: Outline) -> bool:
    """Whether two outlines have the same commands, so that one can become the other."""
    return [command.kind for command in one] == [command.kind for command in other]


def piece_steps(outlines: Sequence[Outline], *, bend: bool = True) -> tuple[int, ...]:
    """In how many steps each piece is drawn, enough for all of the outlines, which have the same pieces.

    Args:
        outlines: states of one outline.
        bend: its straight lines may become curves.
    """
    steps = [1] * len(outlines[0])
    for outline in outlines:
        place = np.zeros(2)
        for number, command in enumerate(outline):
            length = _length(np.concatenate([place[None], command.points]))
            if command.kind == "C":
                wanted = min(max(ceil(STEPS_OF_LENGTH * length**0.5), LEAST_STEPS), MOST_STEPS)
            else:
                wanted = ceil(min(length / LINE_STEP, MOST_STEPS)) if command.kind == "L" and bend else 1
            steps[number] = max(steps[number], wanted)
            place = command.points[-1]
    return tuple(steps)


def flatten(outline: Outline, steps: Sequence[int]) -> tuple[Floats, ...]:
    """Contours (N, 2) of an outline, each piece in as many steps as told."""
    contours: list[list[Floats]] = []
    for command, count in zip(outline, steps, strict=True):
        if command.kind == "M":
            contours.append([command.points])
            continue
        last = contours[-1][-1][-1]
        share = (np.arange(1.0, count + 1.0) / count)[:, None]
        rest = 1.0 - share
        if command.kind == "L":
            contours[-1].append(last * rest + command.points[0] * share)
        else:
            one, two, end = command.points
            contours[-1].append(
                last * rest * rest * rest
                + one * 3.0 * rest * rest * share
                + two * 3.0 * rest * share * share
                + end * share * share * share
            )
    return tuple(np.concatenate(parts) for parts in contours)


def look_up(knots: Knots, places: Floats) -> Floats:
    """(N,) values at places (N,) of a smooth curve through knots (Catmull-Rom); constant beyond the outer ones."""
    if len(knots) == 1:
        return np.full(len(places), knots[0][1])
    at, values = (np.array(column) for column in zip(*knots, strict=True))
    slopes = np.zeros(len(at))
    slopes[1:-1] = (values[2:] - values[:-2]) / (at[2:] - at[:-2])
    piece = np.clip(np.searchsorted(at, places, side="right") - 1, 0, len(at) - 2)
    length = at[piece + 1] - at[piece]
    s = np.clip((places - at[piece]) / length, 0.0, 1.0)
    square, cube = s * s, s * s * s
    return (
        (2.0 * cube - 3.0 * square + 1.0) * values[piece]
        + (cube - 2.0 * square + s) * length * slopes[piece]
        + (3.0 * square - 2.0 * cube) * values[piece + 1]
        + (cube - square) * length * slopes[piece + 1]
    )


def half_widths(line: Floats, width: Knots) -> Floats:
    """(N,) half the width of a brush along a line (N, 2), from its start (0) to its end (1) by length."""
    pieces = np.diff(line, axis=0)
    way = np.concatenate([[0.0], np.cumsum(np.sqrt((pieces * pieces).sum(axis=1)))])
    return 0.5 * np.maximum(look_up(width, way / (way[-1] or 1.0)), 0.0)


def ribbon(line: Floats, half: Floats, *, closed: bool = False) -> tuple[Floats, ...]:
    """Contours of a brush stroke along a line (N, 2).

    Args:
        line: what the brush follows.
        half: (N,) half its width, in the units of the line.
        closed: the line ends where it starts, and the stroke is a ring.
    """
    before, after = (np.roll(line, 1, axis=0), np.roll(line, -1, axis=0)) if closed else _neighbours(line)
    along = after - before
    length = np.sqrt(along[:, 0] * along[:, 0] + along[:, 1] * along[:, 1])
    along /= np.where(length > 0.0, length, 1.0)[:, None]
    aside = np.empty_like(along)
    aside[:, 0], aside[:, 1] = -along[:, 1] * half, along[:, 0] * half
    left, right = line + aside, line - aside
    if closed:
        return left, right[::-1]
    sine, cosine = _half_turn()
    caps = [
        line[end] + sense * (aside[end] * cosine + half[end] * along[end] * sine)
        for end, sense in ((-1, 1.0), (0, -1.0))
    ]
    return (np.concatenate([left, caps[0], right[::-1], caps[1]]),)


@cache
def _half_turn() -> tuple[Floats, Floats]:
    """(CAP_STEPS - 1, 1) sine and cosine of the angles of a round end."""
    sine, cosine = exact.sin_cos(np.arange(1.0, CAP_STEPS) * (np.pi / CAP_STEPS))
    return sine[:, None], cosine[:, None]


def _neighbours(line: Floats) -> tuple[Floats, Floats]:
    return np.concatenate([line[:1], line[:-1]]), np.concatenate([line[1:], line[-1:]])


def _length(points: Floats) -> float:
    steps = np.diff(points, axis=0)
    return float(np.sqrt((steps * steps).sum(axis=1)).sum())
