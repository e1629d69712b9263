"""Outlines of straight lines and cubic curves: what every shape of an SVG file becomes.

Source: Scalable Vector Graphics (SVG) 1.1, W3C Recommendation 2011, chapters 7 to 9 and appendix F.6 (arcs).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

Point = tuple[float, float]
Affine = tuple[float, float, float, float, float, float]
"""(a, b, c, d, e, f): x' = a x + c y + e, y' = b x + d y + f."""

IDENTITY: Affine = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)

QUARTER = 4.0 / 3.0 * (math.sqrt(2.0) - 1.0)
"""Length of the handles of a cubic curve that is nearly a quarter of a unit circle."""

PIECES = 64
"""Pieces into which a curve is cut at most when it is measured or flattened."""


@dataclass(frozen=True)
class Contour:
    """One line without a gap.

    Attributes:
        start: where it begins.
        segments: what follows, each the points after the last one: one of a straight line, three of a cubic curve.
        closed: whether a line leads back to the start.
    """

    start: Point
    segments: tuple[tuple[Point, ...], ...]
    closed: bool

    @property
    def point_count(self) -> int:
        """Control points, the start included."""
        return 1 + sum(map(len, self.segments))


Outline = tuple[Contour, ...]


def then(first: Affine, second: Affine) -> Affine:
    """The map that does ``first``, then ``second``."""
    a, b, c, d, e, f = first
    p, q, r, s, t, u = second
    return (p * a + r * b, q * a + s * b, p * c + r * d, q * c + s * d, p * e + r * f + t, q * e + s * f + u)


def apply(affine: Affine, point: Point) -> Point:
    """Where a point comes to lie."""
    a, b, c, d, e, f = affine
    x, y = point
    return (a * x + c * y + e, b * x + d * y + f)


def scale_of(affine: Affine) -> float:
    """The factor by which lengths grow, in the mean of all directions."""
    a, b, c, d, _, _ = affine
    return math.sqrt(abs(a * d - b * c))


def transform(outline: Outline, affine: Affine) -> Outline:
    """The outline, moved."""
    return tuple(
        Contour(
            apply(affine, contour.start),
            tuple(tuple(apply(affine, point) for point in segment) for segment in contour.segments),
            contour.closed,
        )
        for contour in outline
    )


def count_points(outline: Outline) -> int:
    """Control points of all contours."""
    return sum(contour.point_count for contour in outline)


def polygon(points: Sequence[Point], closed: bool) -> Outline:
    """Straight lines from point to point; nothing of fewer than two."""
    return (Contour(points[0], tuple((point,) for point in points[1:]), closed),) if len(points) > 1 else ()


def ellipse(x: float, y: float, rx: float, ry: float) -> Outline:
    """An ellipse from its right end downwards, as four curves."""
    kx, ky = QUARTER * rx, QUARTER * ry
    right, low, left, high = (x + rx, y), (x, y + ry), (x - rx, y), (x, y - ry)
    return (
        Contour(
            right,
            (
                ((x + rx, y + ky), (x + kx, y + ry), low),
                ((x - kx, y + ry), (x - rx, y + ky), left),
                ((x - rx, y - ky), (x - kx, y - ry), high),
                ((x + kx, y - ry), (x + rx, y - ky), right),
            ),
            True,
        ),
    )


def rectangle(x: float, y: float, width: float, height: float, rx: float, ry: float) -> Outline:
    """A rectangle, its corners rounded."""
    rx, ry = min(rx, width / 2.0), min(ry, height / 2.0)
    right, low = x + width, y + height
    if rx <= 0.0 or ry <= 0.0:
        return polygon([(x, y), (right, y), (right, low), (x, low)], True)
    kx, ky = (1.0 - QUARTER) * rx, (1.0 - QUARTER) * ry
    return (
        Contour(
            (x + rx, y),
            (
                ((right - rx, y),),
                ((right - kx, y), (right, y + ky), (right, y + ry)),
                ((right, low - ry),),
                ((right, low - ky), (right - kx, low), (right - rx, low)),
                ((x + rx, low),),
                ((x + kx, low), (x, low - ky), (x, low - ry)),
                ((x, y + ry),),
                ((x, y + ky), (x + kx, y), (x + rx, y)),
            ),
            True,
        ),
    )


def arc(start: Point, rx: float, ry: float, turn_deg: float, large: bool, sweep: bool, end: Point) -> list[Point]:
    """Control points of the cubic curves along an elliptical arc, three each; a straight line where it has no radius.

    Source: SVG 1.1, F.6.5 and F.6.6; handles of 4/3 tan(angle/4), as for any arc of a circle.
    """
    rx, ry = abs(rx), abs(ry)
    if start == end:
        return []
    if rx == 0.0 or ry == 0.0:
        return [start, end, end]
    turn = math.radians(turn_deg)
    cosine, sine = math.cos(turn), math.sin(turn)
    half_x, half_y = (start[0] - end[0]) / 2.0, (start[1] - end[1]) / 2.0
    x, y = cosine * half_x + sine * half_y, cosine * half_y - sine * half_x
    excess = (x / rx) ** 2 + (y / ry) ** 2
    if excess > 1.0:
        rx, ry = rx * math.sqrt(excess), ry * math.sqrt(excess)
        excess = 1.0
    away = math.sqrt(max(0.0, 1.0 / excess - 1.0)) * (-1.0 if large == sweep else 1.0)
    middle_x, middle_y = away * rx * y / ry, -away * ry * x / rx
    first = math.atan2((y - middle_y) / ry, (x - middle_x) / rx)
    swept = math.atan2((-y - middle_y) / ry, (-x - middle_x) / rx) - first
    if sweep and swept < 0.0:
        swept += 2.0 * math.pi
    elif not sweep and swept > 0.0:
        swept -= 2.0 * math.pi
    pieces = max(1, math.ceil(abs(swept) / (math.pi / 2.0) - 1e-9))
    step = swept / pieces
    handle = 4.0 / 3.0 * math.tan(step / 4.0)
    placed: Affine = (
        cosine * rx,
        sine * rx,
        -sine * ry,
        cosine * ry,
        (start[0] + end[0]) / 2.0 + cosine * middle_x - sine * middle_y,
        (start[1] + end[1]) / 2.0 + sine * middle_x + cosine * middle_y,
    )
    points: list[Point] = []
    for piece in range(pieces):
        a, b = first + piece * step, first + (piece + 1) * step
        unit = (
            (math.cos(a) - handle * math.sin(a), math.sin(a) + handle * math.cos(a)),
            (math.cos(b) + handle * math.sin(b), math.sin(b) - handle * math.cos(b)),
            (math.cos(b), math.sin(b)),
        )
        points += [apply(placed, point) for point in unit]
    points[-1] = end
    return points


def flatten(contour: Contour, tolerance: float) -> list[Point]:
    """Points along a contour, no farther than ``tolerance`` from it; the start is not repeated at the end.

    Source: the distance of a curve from n chords is at most the second differences of its control points times
    3/4 / n² (Filip, Magedson and Markot 1986, "Surface algorithms using bounds on derivatives").
    """
    points = [contour.start]
    for segment in contour.segments:
        if len(segment) == 1:
            points.append(segment[0])
            continue
        (ax, ay), (bx, by), (cx, cy), (dx, dy) = points[-1], *segment
        bend = max(math.hypot(ax - 2 * bx + cx, ay - 2 * by + cy), math.hypot(bx - 2 * cx + dx, by - 2 * cy + dy))
        pieces = min(PIECES, max(1, math.ceil(math.sqrt(0.75 * bend / tolerance))))
        for piece in range(1, pieces):
            t = piece / pieces
            u = 1.0 - t
            p, q, r, s = u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t
            points.append((p * ax + q * bx + r * cx + s * dx, p * ay + q * by + r * cy + s * dy))
        points.append((dx, dy))
    return points


def thin(outline: Outline, tolerance: float) -> Outline:
    """The outline with runs of short straight lines replaced by fewer, nowhere farther away than ``tolerance``.

    Source: Douglas and Peucker 1973, "Algorithms for the reduction of the number of points".
    """
    return tuple(_thin_contour(contour, tolerance) for contour in outline)


def _thin_contour(contour: Contour, tolerance: float) -> Contour:
    segments: list[tuple[Point, ...]] = []
    run = [contour.start]
    for segment in contour.segments:
        if len(segment) == 1:
            run.append(segment[0])
            continue
        segments += [(point,) for point in _keep(run, tolerance)[1:]]
        segments.append(segment)
        run = [segment[-1]]
    segments += [(point,) for point in _keep(run, tolerance)[1:]]
    return Contour(contour.start, tuple(segments), contour.closed)


def _keep(run: list[Point], tolerance: float) -> list[Point]:
    kept = {0, len(run) - 1}
    waiting = [(0, len(run) - 1)]
    while waiting:
        low, high = waiting.pop()
        if high - low < 2:
            continue
        away, farthest = max((_distance(run[number], run[low], run[high]), number) for number in range(low + 1, high))
        if away > tolerance:
            kept.add(farthest)
            waiting += [(low, farthest), (farthest, high)]
    return [run[number] for number in sorted(kept)]


def _distance(point: Point, start: Point, end: Point) -> float:
    x, y = end[0] - start[0], end[1] - start[1]
    length = x * x + y * y
    along = 0.0 if length == 0.0 else ((point[0] - start[0]) * x + (point[1] - start[1]) * y) / length
    along = min(max(along, 0.0), 1.0)
    return math.hypot(point[0] - start[0] - along * x, point[1] - start[1] - along * y)


def path_data(outline: Outline, number: Callable[[float], str]) -> str:
    """SVG path data with absolute commands M, L, C and Z."""
    return " ".join(" ".join(_commands(contour, number)) for contour in outline)


def _commands(contour: Contour, number: Callable[[float], str]) -> Iterable[str]:
    yield f"M {number(contour.start[0])} {number(contour.start[1])}"
    for segment in contour.segments:
        yield ("L " if len(segment) == 1 else "C ") + " ".join(f"{number(x)} {number(y)}" for x, y in segment)
    if contour.closed:
        yield "Z"
