"""Write a letter H and an aircraft of one topology into ``examples/keypose/aircraft.keypose``.

    python tools/aircraft.py

Half a surface: an upright of the letter is an engine with its fin and the tip of the wing; half of the crossbar is a
wing; its middle is the fuselage, whose nose and tail lie flat on the crossbar while it is a letter.

Source: Parke 1974, figure 2.1 (a block letter H becomes an aircraft); both shapes are our own.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from mien.faces.keypose.files import write_keypose
from mien.faces.keypose.records import Keypose, KeyposeTopology, Polygon, SkinPart

OUT = Path(__file__).parents[1] / "examples/keypose/aircraft.keypose"

BODY, WING, FIN, GLASS, EXHAUST = "#465064", "#566178", "#8c2f2b", "#e2b457", "#c96f3a"

# Engine: stations from back to front, ten points around from outside on top, inwards, and back below.
UPRIGHT = [(85, 22), (75, 22), (65, 22), (55, 22), (45, 22), (45, 0), (45, -22), (65, -22), (85, -22), (85, 0)]
UPRIGHT_Y = [-100, -72, -45, -20, 0, 20, 45, 72, 100]
ENGINE_X, ENGINE_DEG = 56.0, [36, 62, 90, 118, 144, 180, 216, 270, 324, 0]
ENGINE_Y = [-92, -86, -79, -70, -44, -18, -10, -2, 4]
ENGINE_RADIUS = [7.0, 8.2, 8.8, 9.2, 9.4, 9.4, 9.0, 8.0, 6.6]
TIP_X = {2: 84.0, 3: 86.0, 4: 74.0}
FIN_TOP = {0: (-98.0, 25.0), 1: (-94.0, 29.0), 2: (-84.0, 28.0), 3: (-76.0, 16.0)}
RIDGE, TIP = 2, 9
JOINED = (3, 4, 5)
"""Stations of the engine and of the fuselage between which the wing is joined to them."""

# Fuselage: seven points from the middle of the top around its left to the middle of the bottom.
BLOCK = [(0, 22), (7, 22), (15, 22), (15, 0), (15, -22), (7, -22), (0, -22)]
TUBE = [(0.0, 1.0), (0.34, 0.86), (0.66, 0.34), (1.0, 0.0), (0.66, -0.34), (0.34, -0.86), (0.0, -1.0)]
"""Half a section with sharp sides: shares of half its width, and of its height above or below the sides."""
SHRUNK = [0.3, 0.6, 0.85, 1.0, 1.0, 1.0, 0.8, 0.6, 0.4, 0.2]
FUSELAGE_Y = [-98, -88, -80, -70, -30, 12, 40, 66, 88, 106]
FUSELAGE_WIDTH = [2.0, 5.0, 7.0, 9.0, 12.0, 15.0, 14.0, 12.0, 9.5, 5.0]
FUSELAGE_TOP = [2.0, 4.5, 6.0, 7.0, 8.0, 8.5, 9.0, 10.0, 6.0, 3.0]
FUSELAGE_BOTTOM = [1.5, 3.0, 4.0, 5.0, 5.5, 5.5, 5.0, 4.5, 3.5, 2.0]
NOSE_Y, TAIL_Y = 122.0, -106.0
COCKPIT = {(6, 0), (6, 1), (7, 0), (7, 1)}
WING_X, WING_THICK = 30.0, 1.6


class Sheet:
    """Points of both shapes, numbered from 1, and the polygons between them."""

    def __init__(self) -> None:
        self.letter: list[tuple[float, float, float]] = []
        self.aircraft: list[tuple[float, float, float]] = []
        self.polygons: list[tuple[list[int], str]] = []
        self.creases: list[list[int]] = []

    def point(self, letter: tuple[float, float, float], aircraft: tuple[float, float, float]) -> int:
        """Number of a new point."""
        self.letter.append(letter)
        self.aircraft.append(aircraft)
        return len(self.letter)

    def polygon(self, color: str, *points: int) -> None:
        """Add a polygon, clockwise seen from outside."""
        self.polygons.append((list(points), color))


def build() -> Sheet:
    """The half of both shapes."""
    sheet = Sheet()
    engine = _engine(sheet)
    fuselage = _fuselage(sheet)
    _wing(sheet, _rim(engine, 4, 5, 6), _rim(fuselage, 2, 3, 4))
    return sheet


def _engine(sheet: Sheet) -> dict[tuple[int, int], int]:
    count = len(UPRIGHT)
    number = {}
    for i, (y, engine_y, radius) in enumerate(zip(UPRIGHT_Y, ENGINE_Y, ENGINE_RADIUS, strict=True)):
        for k, ((x, z), degrees) in enumerate(zip(UPRIGHT, ENGINE_DEG, strict=True)):
            if i == 4 and k == 5:  # inside, where the wing is joined
                continue
            angle = np.radians(degrees)
            place = (ENGINE_X + radius * np.cos(angle), float(engine_y), radius * np.sin(angle))
            if k == RIDGE and i in FIN_TOP:
                place = (ENGINE_X - 0.25 * FIN_TOP[i][1], *FIN_TOP[i])
            elif k in (RIDGE - 1, RIDGE + 1) and i in FIN_TOP:
                place = (ENGINE_X + (RIDGE - k) * 1.4, float(engine_y), radius * 0.99)
            elif k == TIP and i in TIP_X:
                place = (TIP_X[i], float(engine_y), 0.0)
            number[i, k] = sheet.point((x, y, z), place)
    for i in range(len(UPRIGHT_Y) - 1):
        for k in range(count):
            after = (k + 1) % count
            if k in (4, 5) and i in JOINED[:-1]:
                continue
            fin = k in (RIDGE - 1, RIDGE) and i in FIN_TOP and i + 1 in FIN_TOP
            color = FIN if fin else WING if k in (8, 9) else BODY
            sheet.polygon(color, number[i, k], number[i, after], number[i + 1, after], number[i + 1, k])
    back = sheet.point((65, UPRIGHT_Y[0], 0), (ENGINE_X, -84.0, 0.0))
    front = sheet.point((65, UPRIGHT_Y[-1], 0), (ENGINE_X, 17.0, 0.0))
    last = len(UPRIGHT_Y) - 1
    for k in range(count):
        after = (k + 1) % count
        sheet.polygon(EXHAUST, number[0, after], number[0, k], back)
        sheet.polygon(WING, number[last, k], number[last, after], front)
    for i in (0, last):
        sheet.creases.append([*(number[i, k] for k in range(count)), number[i, 0]])
    sheet.creases += [[number[i, k] for i in range(last + 1)] for k in (0, 4, 6, 8)]
    return number


def _fuselage(sheet: Sheet) -> dict[tuple[int, int], int]:
    number = {}
    for i, shrunk in enumerate(SHRUNK):
        y = min(max(i - JOINED[1], -1), 1) * 20
        for k, ((x, z), (across, up)) in enumerate(zip(BLOCK, TUBE, strict=True)):
            if i == JOINED[1] and k == 3:
                continue
            height = FUSELAGE_TOP[i] if up > 0.0 else FUSELAGE_BOTTOM[i]
            aircraft = (across * FUSELAGE_WIDTH[i], float(FUSELAGE_Y[i]), up * height)
            number[i, k] = sheet.point((x * shrunk, float(y), z * shrunk), aircraft)
    for i in range(len(SHRUNK) - 1):
        for k in range(len(BLOCK) - 1):
            if k in (2, 3) and i in JOINED[:-1]:
                continue
            color = GLASS if (i, k) in COCKPIT else BODY
            sheet.polygon(color, number[i, k + 1], number[i, k], number[i + 1, k], number[i + 1, k + 1])
    tail = sheet.point((0, -20, 0), (0, TAIL_Y, 0))
    nose = sheet.point((0, 20, 0), (0, NOSE_Y, 0))
    last = len(SHRUNK) - 1
    for k in range(len(BLOCK) - 1):
        sheet.polygon(BODY, number[0, k], number[0, k + 1], tail)
        sheet.polygon(BODY, number[last, k + 1], number[last, k], nose)
    sheet.creases += [[number[i, k] for k in range(len(BLOCK))] for i in (JOINED[0], JOINED[-1])]
    return number


def _rim(number: dict[tuple[int, int], int], top: int, middle: int, bottom: int) -> list[int]:
    """Eight points around the end of a wing: its top from back to front, its front, its bottom, its back."""
    back, between, front = JOINED
    places = [(back, top), (between, top), (front, top), (front, middle), (front, bottom)]
    return [number[place] for place in [*places, (between, bottom), (back, bottom), (back, middle)]]


def _wing(sheet: Sheet, outer: list[int], inner: list[int]) -> None:
    middle = [sheet.point(*places) for places in _between(sheet, outer, inner)]
    for near, far in ((outer, middle), (middle, inner)):
        for k in range(len(near)):
            after = (k + 1) % len(near)
            sheet.polygon(WING, near[after], near[k], far[k], far[after])
    sheet.creases += [[rim[k] for rim in (outer, middle, inner)] for k in (0, 2, 4, 6)]


def _between(sheet: Sheet, outer: list[int], inner: list[int]) -> Iterator[tuple[tuple[float, float, float], ...]]:
    for k, (far, near) in enumerate(zip(outer, inner, strict=True)):
        letter = np.add(sheet.letter[far - 1], sheet.letter[near - 1]) / 2.0
        x, y, _ = np.add(sheet.aircraft[far - 1], sheet.aircraft[near - 1]) / 2.0
        thick = 0.0 if k in (3, 7) else WING_THICK if k < 3 else -WING_THICK
        yield (WING_X, float(letter[1]), float(letter[2])), (x, y, thick)


def main(out: Path = OUT) -> None:
    """Write the folder."""
    sheet = build()
    polygons = tuple(Polygon(tuple(points), color) for points, color in sheet.polygons)
    places = np.array([sheet.letter, sheet.aircraft]) * 0.001
    midline = tuple(int(k) + 1 for k in np.flatnonzero((places[:, :, 0] == 0.0).all(axis=0)))
    topology = KeyposeTopology((SkinPart("skin", polygons),), midline, tuple(tuple(line) for line in sheet.creases))
    doc = "A block letter H that becomes an aircraft, after figure 2.1 of Parke 1974"
    write_keypose(out, Keypose("aircraft", topology, ("letter", "aircraft"), places, doc=doc))


if __name__ == "__main__":
    main()
