"""Path data, transforms and lengths of SVG files, read.

Source: Scalable Vector Graphics (SVG) 1.1, W3C Recommendation 2011, sections 7.6, 7.10 and 8.3.
"""

from __future__ import annotations

import math
import re

from .svg_reader_outlines import IDENTITY, Affine, Contour, Outline, Point, arc, then

NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
LONGEST_NUMBER = 100
LARGEST = 1e9

COMMAND = re.compile("([MmZzLlHhVvCcSsQqTtAa])")
BETWEEN = " \t\r\n\f,"
_GAP = rf"[{BETWEEN}]*"
ARC = re.compile(_GAP.join([f"({NUMBER.pattern})"] * 3 + ["([01])"] * 2 + [f"({NUMBER.pattern})"] * 2))

ARGUMENTS = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
LENGTH = re.compile(rf"({NUMBER.pattern})\s*(px|pt|pc|mm|cm|in|q|em|rem|ex|%)?", re.IGNORECASE)

UNITS = {
    "px": 1.0, "pt": 96 / 72, "pc": 16.0, "mm": 96 / 25.4, "cm": 96 / 2.54, "in": 96.0, "q": 96 / 101.6,
    "em": 16.0, "rem": 16.0, "ex": 8.0,
}  # fmt: skip
"""Pixels of 1/96 inch; letters are 16 pixels high, as in browsers."""

TRANSFORM = re.compile(r"\s*,?\s*(matrix|translate|scale|rotate|skewX|skewY)\s*\(([^()]*)\)\s*")


def parse_path(text: str, most_points: int) -> Outline:
    """The contours of path data.

    Raises:
        ValueError: a word where it cannot be understood, or more than ``most_points`` points.
    """
    return _PathReader(text, most_points).read()


def parse_points(text: str, most_points: int) -> list[Point]:
    """The points of a polygon or polyline.

    Raises:
        ValueError: it holds something else than pairs of numbers, or more than ``most_points``.
    """
    numbers = parse_numbers(text)
    if len(numbers) % 2:
        raise ValueError(f"points={text[:40]!r} holds an odd number of coordinates, {len(numbers)}")
    if len(numbers) > 2 * most_points:
        raise TooManyPointsError
    return list(zip(numbers[::2], numbers[1::2], strict=True))


def parse_numbers(text: str) -> list[float]:
    """Numbers with gaps or commas between them.

    Raises:
        ValueError: there is something else among them.
    """
    rest = NUMBER.sub("", text)
    if rest.strip(BETWEEN):
        raise ValueError(f"{text[:40]!r} holds something else than numbers")
    return [_finite(word) for word in NUMBER.findall(text)]


def parse_length(text: str, whole: float) -> float:
    """A length in pixels; per cent are of ``whole``.

    Raises:
        ValueError: it is no length.
    """
    match = LENGTH.fullmatch(text.strip())
    if match is None:
        raise ValueError(f"{text[:40]!r} is no length, want a number and px, mm, cm, in, pt, pc, em or %")
    number, unit = _finite(match[1]), (match[2] or "px").lower()
    return number * whole / 100.0 if unit == "%" else number * UNITS[unit]


def parse_transform(text: str) -> Affine:
    """The map of a list of transforms, the last applied first.

    Raises:
        ValueError: one of them cannot be understood.
    """
    place, result = 0, IDENTITY
    text = text.strip()
    while place < len(text):
        match = TRANSFORM.match(text, place)
        if match is None:
            raise ValueError(f"transform={text[place : place + 40]!r} cannot be understood")
        result = then(_single(match[1], parse_numbers(match[2])), result)
        place = match.end()
    return result


def _single(name: str, numbers: list[float]) -> Affine:
    match name, numbers:
        case "matrix", [a, b, c, d, e, f]:
            return (a, b, c, d, e, f)
        case "translate", [x, *rest] if len(rest) < 2:
            return (1.0, 0.0, 0.0, 1.0, x, rest[0] if rest else 0.0)
        case "scale", [x, *rest] if len(rest) < 2:
            return (x, 0.0, 0.0, rest[0] if rest else x, 0.0, 0.0)
        case "rotate", [turn, *about] if len(about) in (0, 2):
            x, y = about or (0.0, 0.0)
            cosine, sine = math.cos(math.radians(turn)), math.sin(math.radians(turn))
            return (cosine, sine, -sine, cosine, x - cosine * x + sine * y, y - sine * x - cosine * y)
        case "skewX", [turn]:
            return (1.0, 0.0, math.tan(math.radians(turn)), 1.0, 0.0, 0.0)
        case "skewY", [turn]:
            return (1.0, math.tan(math.radians(turn)), 0.0, 1.0, 0.0, 0.0)
    raise ValueError(f"{name} does not take {len(numbers)} numbers")


class TooManyPointsError(ValueError):
    """More points than are read."""


def _finite(word: str) -> float:
    number = float(word) if len(word) < LONGEST_NUMBER else math.inf
    if not abs(number) < LARGEST:
        raise ValueError(f"{word[:40]} is too long or too large a number")
    return number


class _PathReader:
    """Where it is in path data: the point reached, where the contour began, the last handle."""

    def __init__(self, text: str, most_points: int) -> None:
        self._text = text
        self._left = most_points
        self._contours: list[Contour] = []
        self._segments: list[tuple[Point, ...]] = []
        self._start: Point | None = None
        self._at: Point = (0.0, 0.0)
        self._handle: Point | None = None
        self._handle_of = ""

    def read(self) -> Outline:
        pieces = COMMAND.split(self._text)
        if pieces[0].strip():
            raise self._unclear("a command, one of M L H V C S Q T A Z", pieces[0])
        # Every command but Z makes a point at least: most of what is too much is refused before it is looked at.
        if len(pieces) // 2 - pieces.count("Z") - pieces.count("z") > self._left:
            raise TooManyPointsError
        for letter, arguments in zip(pieces[1::2], pieces[2::2], strict=True):
            self._do(letter, arguments)
        self._end(closed=False)
        return tuple(self._contours)

    def _do(self, letter: str, arguments: str) -> None:
        """A command with all sets of numbers that follow it."""
        command, relative = letter.upper(), letter.islower()
        words = _split_arcs(arguments) if command == "A" else NUMBER.findall(arguments)
        count = ARGUMENTS[command]
        odd = len(words) % count if count else len(words)
        rest = (ARC if command == "A" else NUMBER).sub("", arguments)
        if odd or (count and not words) or rest.strip(BETWEEN):
            raise self._unclear(f"{count} numbers for {letter}, or some times as many", letter + arguments)
        if command == "Z":
            if self._start is not None:
                self._at = self._start
                self._end(closed=True)
            return
        if len(words) // count > self._left:
            raise TooManyPointsError
        numbers = [_finite(word) for word in words]
        for place in range(0, len(numbers), count):
            given = numbers[place : place + count]
            if command == "M" and place == 0:
                self._move(given, relative)
            else:
                self._draw("L" if command == "M" else command, given, relative)

    def _move(self, numbers: list[float], relative: bool) -> None:
        self._end(closed=False)
        x, y = self._at if relative else (0.0, 0.0)
        self._at = self._start = (x + numbers[0], y + numbers[1])
        self._left -= 1

    def _draw(self, command: str, numbers: list[float], relative: bool) -> None:
        if self._start is None:
            if not self._contours:
                raise ValueError(f"path data begins with {command}, want M first")
            self._start = self._at
        here = self._at
        x, y = here if relative else (0.0, 0.0)
        points = [(x + a, y + b) for a, b in zip(numbers[::2], numbers[1::2], strict=False)]
        match command:
            case "L":
                self._add((points[0],))
            case "H":
                self._add(((x + numbers[0], here[1]),))
            case "V":
                self._add(((here[0], y + numbers[0]),))
            case "C":
                self._add((points[0], points[1], points[2]), points[1], "C")
            case "S":
                self._add((self._mirrored("C"), points[0], points[1]), points[0], "C")
            case "Q":
                self._add(_raise_degree(here, points[0], points[1]), points[0], "Q")
            case "T":
                handle = self._mirrored("Q")
                self._add(_raise_degree(here, handle, points[0]), handle, "Q")
            case "A":
                end = (x + numbers[5], y + numbers[6])
                along = arc(here, numbers[0], numbers[1], numbers[2], numbers[3] == 1.0, numbers[4] == 1.0, end)
                for number in range(0, len(along), 3):
                    self._add(tuple(along[number : number + 3]))

    def _add(self, segment: tuple[Point, ...], handle: Point | None = None, of: str = "") -> None:
        self._left -= len(segment)
        if self._left < 0:
            raise TooManyPointsError
        self._segments.append(segment)
        self._at = segment[-1]
        self._handle, self._handle_of = handle, of

    def _mirrored(self, of: str) -> Point:
        """The last handle on the other side of the point reached; that point where the last was of another kind."""
        if self._handle is None or self._handle_of != of:
            return self._at
        return (2.0 * self._at[0] - self._handle[0], 2.0 * self._at[1] - self._handle[1])

    def _end(self, closed: bool) -> None:
        if self._start is not None and self._segments:
            self._contours.append(Contour(self._start, tuple(self._segments), closed))
        self._segments, self._start, self._handle = [], None, None

    def _unclear(self, wanted: str, got: str) -> ValueError:
        return ValueError(f"path data {got.strip()[:30]!r}: want {wanted}")


def _split_arcs(text: str) -> list[str]:
    """Words of arcs, seven each, whose two flags may stand without a gap."""
    return [word for match in ARC.finditer(text) for word in match.groups()]


def _raise_degree(start: Point, handle: Point, end: Point) -> tuple[Point, ...]:
    """The cubic curve that is the quadratic one."""
    return (
        (start[0] + 2.0 / 3.0 * (handle[0] - start[0]), start[1] + 2.0 / 3.0 * (handle[1] - start[1])),
        (end[0] + 2.0 / 3.0 * (handle[0] - end[0]), end[1] + 2.0 / 3.0 * (handle[1] - end[1])),
        end,
    )
