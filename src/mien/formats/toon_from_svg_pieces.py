"""The shapes of a drawing as one looks for a face in them: placed on the canvas, measured, named."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib import resources

from .svg_reader import SvgDrawing, SvgShape
from .svg_reader_outlines import Affine, Contour, Outline, Point, flatten, thin, transform
from .svg_reader_paints import Paint

SMALLEST, LARGEST, USUAL = 200.0, 2000.0, 400.0
"""A canvas whose longer side is not between the first two is scaled to the third."""

PAPER: Paint = (0.91, 0.933, 0.957, 1.0)
"""Behind a drawing without a background."""

COVERS = 0.98
"""Share of the canvas that a background covers at least."""

WORD = re.compile(r"[^\W\d_]+")
CAMEL = re.compile(r"(?<=[a-zäöüéèêß])(?=[A-Z])")
LUMA = (0.299, 0.587, 0.114)
"""Source: ITU-R BT.601, weights of red, green and blue."""


@dataclass(frozen=True)
class Box:
    """A rectangle; y down."""

    left: float
    top: float
    right: float
    bottom: float

    @property
    def width(self) -> float:
        """From left to right."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """From top to bottom."""
        return self.bottom - self.top

    @property
    def x(self) -> float:
        """Of the middle."""
        return 0.5 * (self.left + self.right)

    @property
    def y(self) -> float:
        """Of the middle."""
        return 0.5 * (self.top + self.bottom)

    @property
    def area(self) -> float:
        """Of the rectangle."""
        return self.width * self.height

    def grown(self, by: float) -> Box:
        """With a margin all around."""
        return Box(self.left - by, self.top - by, self.right + by, self.bottom + by)

    def holds(self, other: Box) -> bool:
        """Whether the other lies in it."""
        return (
            self.left <= other.left
            and self.top <= other.top
            and self.right >= other.right
            and self.bottom >= other.bottom
        )

    def meets(self, other: Box) -> bool:
        """Whether the two have something in common."""
        return (
            self.left <= other.right
            and other.left <= self.right
            and self.top <= other.bottom
            and other.top <= self.bottom
        )


def box_of(points: Iterable[Point]) -> Box:
    """The box around points, of which there is one at least."""
    xs, ys = zip(*points, strict=True)
    return Box(min(xs), min(ys), max(xs), max(ys))


def outline_box(outline: Outline, tolerance: float) -> Box:
    """The box around an outline."""
    return box_of(point for contour in outline for point in flatten(contour, tolerance))


def meet(boxes: Iterable[Box]) -> Box:
    """What boxes have in common, of which there is one at least; its sides are below 0 where that is nothing."""
    found = list(boxes)
    return Box(
        max(box.left for box in found),
        max(box.top for box in found),
        min(box.right for box in found),
        min(box.bottom for box in found),
    )


def join(boxes: Iterable[Box]) -> Box:
    """The box around boxes, of which there is one at least."""
    found = list(boxes)
    return Box(
        min(box.left for box in found),
        min(box.top for box in found),
        max(box.right for box in found),
        max(box.bottom for box in found),
    )


@dataclass(frozen=True, eq=False)
class Piece:
    """One shape of a drawing on the canvas of the character.

    Attributes:
        shape: as it was read, its outline on the canvas.
        contours: points along it, of each contour.
        box: around what is seen of it, without the width of a stroke.
        role: what its name says it is, such as ``pupil``; empty where it says nothing.
        lower: its name says that it is the lower one of two.
        named: its own name says so, not that of a group around it.
    """

    shape: SvgShape
    contours: tuple[tuple[Point, ...], ...]
    box: Box
    role: str = ""
    lower: bool = False
    named: bool = False

    @property
    def stroked(self) -> bool:
        """It is a line with a width."""
        return self.shape.width > 0.0

    @property
    def ring(self) -> bool:
        """It is a closed line with a width."""
        return self.stroked and all(contour.closed for contour in self.shape.outline)

    @property
    def points(self) -> list[Point]:
        """Points along all contours."""
        return [point for contour in self.contours for point in contour]


def luminance(color: Paint) -> float:
    """How light a colour is, 0..1."""
    return sum(weight * channel for weight, channel in zip(LUMA, color, strict=False))


def contrast(color: Paint, other: Paint) -> float:
    """How much a colour differs from one that it is painted on, 0..1."""
    return color[3] * max(abs(one - two) for one, two in zip(color[:3], other[:3], strict=True))


def make_pieces(drawing: SvgDrawing, tolerance: float) -> tuple[tuple[float, float], list[Piece], Paint | None]:
    """The canvas, the pieces in the order in which they are painted, and the colour of a background behind them all.

    Args:
        drawing: as it was read.
        tolerance: how far outlines may depart from those of the drawing, in units of the canvas.
    """
    longest = max(drawing.size)
    scale = 1.0 if SMALLEST <= longest <= LARGEST else USUAL / longest
    size = (round(drawing.size[0] * scale, 2), round(drawing.size[1] * scale, 2))
    affine: Affine = (scale, 0.0, 0.0, scale, 0.0, 0.0)
    shapes = [
        replace(
            part,
            outline=thin(transform(part.outline, affine), tolerance),
            width=part.width * scale,
            clips=tuple(thin(transform(clip, affine), tolerance) for clip in part.clips),
        )
        for shape in drawing.shapes
        for part in _separate(shape)
    ]
    canvas = Box(0.0, 0.0, *size)
    pieces = [_measure(shape, tolerance) for shape in shapes]
    seen = [
        piece
        for piece in pieces
        if piece.box.width >= 0.0 and piece.box.height >= 0.0 and piece.box.grown(piece.shape.width / 2.0).meets(canvas)
    ]
    background = None
    while seen and _is_background(seen[0], canvas):
        background = seen.pop(0).shape.color
    return size, seen, background


def _measure(shape: SvgShape, tolerance: float) -> Piece:
    contours = tuple(tuple(flatten(contour, tolerance)) for contour in shape.outline)
    role, lower = find_role(shape.names)
    named = bool(role)
    if not named:
        role, lower = find_role(shape.groups)
    boxes = [box_of(point for contour in contours for point in contour)]
    boxes += [outline_box(clip, tolerance) for clip in shape.clips]
    return Piece(shape, contours, meet(boxes), role, lower, named)


def _is_background(piece: Piece, canvas: Box) -> bool:
    """A shape behind everything that fills the canvas; a round face at its edges is none."""
    if piece.stroked or not piece.box.grown(0.01 * canvas.width).holds(canvas):
        return False
    return piece.role == "background" or area(piece.contours[0]) >= COVERS * canvas.area


def area(points: Sequence[Point]) -> float:
    """What a closed line goes around."""
    ends = [*points[1:], points[0]]
    return abs(sum(ax * by - bx * ay for (ax, ay), (bx, by) in zip(points, ends, strict=True))) / 2.0


def _separate(shape: SvgShape) -> Iterator[SvgShape]:
    """The shape in parts that lie apart from one another, as two eyes in one path do."""
    groups: list[tuple[Box, list[Contour]]] = []
    for contour in shape.outline:
        box = box_of(_corners(contour)).grown(shape.width / 2.0)
        near = [group for group in groups if group[0].meets(box)]
        groups = [group for group in groups if group not in near]
        together = [each for _, contours in near for each in contours]
        groups.append((join([box, *(other for other, _ in near)]), [*together, contour]))
    for _, contours in groups:
        yield replace(shape, outline=tuple(contours))


def _corners(contour: Contour) -> Iterator[Point]:
    yield contour.start
    for segment in contour.segments:
        yield from segment


@cache
def _words() -> Mapping[str, tuple[str, int]]:
    """Role and rank of every word that names a feature; the role of the highest rank counts."""
    text = resources.files(__package__).joinpath("data", "svg_words.csv").read_text(encoding="utf-8")
    return {row["word"]: (row["role"], int(row["rank"])) for row in csv.DictReader(text.splitlines())}


def find_role(names: Sequence[str]) -> tuple[str, bool]:
    """Role, and whether it is the lower one of two; the innermost name that tells it counts.

    A code such as ``ER`` counts only at the beginning of a name and in capitals.
    """
    lower = False
    for name in names:
        found = sorted(_roles(name), key=lambda role: role[1])
        lower = lower or any(role == "lower" for role, _ in found)
        if roles := [role for role, _ in found if role not in ("upper", "lower")]:
            return roles[-1], lower
    return "", False


def _roles(name: str) -> Iterator[tuple[str, int]]:
    for place, word in enumerate(WORD.findall(CAMEL.sub(" ", name))):
        if len(word) <= 2 and not (place == 0 and word.isupper()):
            continue
        lowered = word.lower()
        for known in (lowered, lowered.removesuffix("s")):
            if known in _words():
                yield _words()[known]
                break
