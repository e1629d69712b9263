"""Lines of an eye or a mouth that fit its drawn outline: two ends, a middle above and below, and how they bend.

The profile (1 - s^p)^(1/q) is that of ``mien.faces.toon``.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from .svg_reader_outlines import Contour, Outline, Point
from .toon_from_svg_pieces import Box, box_of

Profile = tuple[float, float]

STRAIGHT: Profile = (1.0, 1.0)
GENTLE: Profile = (2.0, 1.0)

LEVEL = 0.03
"""Share of its width below which a line is level, and says nothing about how it bends."""

EXPONENTS = (1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0, 8.0)
SAMPLES = tuple(number / 12 for number in range(1, 12))

END = 0.02
"""Points as near to the outermost one as this share of the width make up an end."""


@dataclass(frozen=True)
class Lens:
    """Two lines between common ends.

    Attributes:
        left: the left end as seen.
        right: the right end.
        top: middle of the upper line.
        bottom: middle of the lower line.
        profile: exponents p and q of both.
    """

    left: Point
    right: Point
    top: Point
    bottom: Point
    profile: Profile

    @property
    def box(self) -> Box:
        """Around its four points."""
        return box_of((self.left, self.right, self.top, self.bottom))

    @property
    def opening(self) -> float:
        """Between its lines, in the middle."""
        return self.bottom[1] - self.top[1]


def weight(profile: Profile, s: float) -> float:
    """Share of the middle's height that a line has at ``s`` of the way to an end."""
    return max(0.0, 1.0 - s ** profile[0]) ** (1.0 / profile[1])


def fit_lens(contours: Iterable[Sequence[Point]], *, closed: bool) -> Lens:
    """The lens that is nearest to an outline; of an open line both lines are the same."""
    edges = _edges(contours, closed=closed)
    points = [start for start, _ in edges] + [end for _, end in edges]
    box = box_of(points)
    left = (box.left, _end_height(points, box.left, END * box.width))
    right = (box.right, _end_height(points, box.right, END * box.width))
    middle = _heights(edges, box.x) or [box.y]
    top, bottom = (box.x, min(middle)), (box.x, max(middle))
    lens = Lens(left, right, top, bottom, STRAIGHT)
    if max(abs(y - end[1]) for y in (top[1], bottom[1]) for end in (left, right)) < LEVEL * box.width:
        return Lens(left, right, top, bottom, GENTLE)
    drawn = [(x, s, side, _heights(edges, x)) for s in SAMPLES for side, x in _abscissas(lens, s)]
    heights = [(s, side, min(ys), max(ys)) for _, s, side, ys in drawn if ys]

    def miss(profile: Profile) -> float:
        total = 0.0
        for s, side, high, low in heights:
            end = (left if side < 0 else right)[1]
            share = weight(profile, s)
            total += (end + share * (top[1] - end) - high) ** 2 + (end + share * (bottom[1] - end) - low) ** 2
        return total

    profile = min(((p, q) for p in EXPONENTS for q in EXPONENTS), key=lambda each: (miss(each), each))
    return Lens(left, right, top, bottom, profile)


def lens_around(box: Box, points: Sequence[Point], sink: float) -> Lens:
    """The lens in a box that holds all points, as round as it can be.

    Args:
        box: around the lens.
        points: what it must hold.
        sink: height of its ends, as a share of the box from its top.
    """
    height = box.top + sink * box.height
    lens = Lens((box.left, height), (box.right, height), (box.x, box.top), (box.x, box.bottom), (2.0, 2.0))
    for exponent in (2.0, 2.5, 3.0, 4.0, 6.0):
        lens = Lens(lens.left, lens.right, lens.top, lens.bottom, (exponent, exponent))
        if all(_holds(lens, point) for point in points):
            break
    return lens


def lens_outline(lens: Lens) -> Outline:
    """The area between the lines of a lens, as short straight lines."""
    shares = [number / 12 for number in range(-12, 13)]
    upper = [(_x(lens, t), _y(lens, t, lens.top[1])) for t in shares]
    lower = [(_x(lens, t), _y(lens, t, lens.bottom[1])) for t in reversed(shares[1:-1])]
    points = [*upper, *lower]
    return (Contour(points[0], tuple((point,) for point in points[1:]), True),)


def _x(lens: Lens, t: float) -> float:
    end = lens.left if t < 0.0 else lens.right
    return lens.top[0] + abs(t) * (end[0] - lens.top[0])


def _y(lens: Lens, t: float, middle: float) -> float:
    end = (lens.left if t < 0.0 else lens.right)[1]
    return end + weight(lens.profile, abs(t)) * (middle - end)


def _holds(lens: Lens, point: Point) -> bool:
    end = lens.left if point[0] < lens.top[0] else lens.right
    t = (point[0] - lens.top[0]) / abs(end[0] - lens.top[0])
    if abs(t) >= 1.0:
        return False
    return _y(lens, t, lens.top[1]) <= point[1] <= _y(lens, t, lens.bottom[1])


def _edges(contours: Iterable[Sequence[Point]], *, closed: bool) -> list[tuple[Point, Point]]:
    edges = []
    for points in contours:
        edges += list(pairwise([*points, points[0]] if closed else points))
    return edges


def _end_height(points: Sequence[Point], x: float, near: float) -> float:
    heights = [point[1] for point in points if abs(point[0] - x) <= near]
    return 0.5 * (min(heights) + max(heights))


def _abscissas(lens: Lens, s: float) -> list[tuple[int, float]]:
    return [
        (-1, lens.top[0] + s * (lens.left[0] - lens.top[0])),
        (1, lens.top[0] + s * (lens.right[0] - lens.top[0])),
    ]


def _heights(edges: Iterable[tuple[Point, Point]], x: float) -> list[float]:
    """Where an upright line at ``x`` meets the edges."""
    found = []
    for (ax, ay), (bx, by) in edges:
        if min(ax, bx) <= x <= max(ax, bx) and ax != bx:
            found.append(ay + (x - ax) / (bx - ax) * (by - ay))
    return found
