"""Outlines of the elements of an SVG file that are shapes, and the numbers among their attributes.

Source: Scalable Vector Graphics (SVG) 1.1, W3C Recommendation 2011, chapters 7 and 9.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from mien.core import LoadError

from .svg_reader_outlines import Affine, Outline, ellipse, polygon, rectangle
from .svg_reader_paths import TooManyPointsError, parse_length, parse_numbers, parse_path, parse_points
from .svg_reader_xml import Element

MOST_POINTS = 100_000

SHAPES = ("path", "rect", "circle", "ellipse", "line", "polyline", "polygon")

Size = tuple[float, float]
Box = tuple[float, float, float, float]
"""Left, top, width and height."""

Value = TypeVar("Value")


def read_attribute(path: Path, element: Element, name: str, parse: Callable[[str], Value], otherwise: str) -> Value:
    """An attribute, parsed.

    Raises:
        LoadError: it cannot be understood.
    """
    try:
        return parse(element.attributes.get(name, otherwise))
    except TooManyPointsError:
        raise too_many_points(path, element) from None
    except ValueError as error:
        raise LoadError(path, f"{name} of <{element.name}>: {error}", line=element.line) from None


def too_many_points(path: Path, element: Element) -> LoadError:
    """What to say of a drawing that is no flat face any more."""
    return LoadError(
        path,
        f"the drawing has more than {MOST_POINTS:,} points",
        line=element.line,
        hint="simplify it first (in Inkscape: Path > Simplify); a face has some hundreds",
    )


def read_outline(path: Path, element: Element, view: Size, most_points: int) -> Outline:
    """The outline of a shape; of nothing where a side of it is 0.

    Args:
        path: the file.
        element: one of ``SHAPES``.
        view: width and height that percentages are of.
        most_points: how many it may have.

    Raises:
        LoadError: an attribute cannot be understood, or there are too many points.
    """
    wide, high = view
    diagonal = math.hypot(wide, high) / math.sqrt(2.0)

    def length(name: str, whole: float, otherwise: str = "0") -> float:
        return read_attribute(path, element, name, lambda text: parse_length(text, whole), otherwise)

    def points(text: str) -> list[tuple[float, float]]:
        return parse_points(text, most_points)

    match element.name:
        case "path":
            return read_attribute(path, element, "d", lambda text: parse_path(text, most_points), "")
        case "rect":
            width, height = length("width", wide), length("height", high)
            rx, ry = (_radius(element, name, length, whole) for name, whole in (("rx", wide), ("ry", high)))
            rx, ry = (ry if rx is None else rx), (rx if ry is None else ry)
            found = rectangle(length("x", wide), length("y", high), width, height, rx or 0.0, ry or 0.0)
            return found if width > 0.0 and height > 0.0 else ()
        case "circle" | "ellipse":
            rx, ry = (
                (length("r", diagonal),) * 2 if element.name == "circle" else (length("rx", wide), length("ry", high))
            )
            found = ellipse(length("cx", wide), length("cy", high), rx, ry)
            return found if rx > 0.0 and ry > 0.0 else ()
        case "line":
            ends = [(length(f"x{end}", wide), length(f"y{end}", high)) for end in "12"]
            return polygon(ends, closed=False)
        case _:
            return polygon(read_attribute(path, element, "points", points, ""), closed=element.name == "polygon")


def _radius(element: Element, name: str, length: Callable[[str, float], float], whole: float) -> float | None:
    """Of the corners of a rectangle; None where the other one counts."""
    return length(name, whole) if element.attributes.get(name, "auto").strip() != "auto" else None


def read_canvas(path: Path, root: Element) -> Box:
    """The part of the plane that is seen.

    Raises:
        LoadError: it is not given, or empty.
    """
    if "viewBox" in root.attributes:
        return read_view_box(path, root)
    sides = [root.attributes.get(name, "100%") for name in ("width", "height")]
    if any(side.strip().endswith("%") for side in sides):
        raise LoadError(
            path,
            "the size of the drawing is not known",
            line=root.line,
            hint='give the <svg> a viewBox, as in viewBox="0 0 400 440"',
        )
    width, height = (
        read_attribute(path, root, name, lambda text: parse_length(text, 0.0), "") for name in ("width", "height")
    )
    return _check_box(path, root, (0.0, 0.0, width, height))


def read_view_box(path: Path, element: Element) -> Box:
    """The ``viewBox`` of an element.

    Raises:
        LoadError: it is not four numbers, or empty.
    """
    numbers = read_attribute(path, element, "viewBox", parse_numbers, "")
    if len(numbers) != 4:
        raise LoadError(path, f"viewBox holds {len(numbers)} numbers, want 4", line=element.line)
    left, top, width, height = numbers
    return _check_box(path, element, (left, top, width, height))


def fit_view(path: Path, element: Element, width: float, height: float) -> Affine:
    """From the inside of an element with a ``viewBox`` to a space of that size.

    Source: SVG 1.1, section 7.8, ``preserveAspectRatio``.
    """
    if "viewBox" not in element.attributes:
        return (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
    left, top, wide, high = read_view_box(path, element)
    x, y = width / wide, height / high
    words = element.attributes.get("preserveAspectRatio", "xMidYMid meet").split()
    if words[:1] == ["none"]:
        return (x, 0.0, 0.0, y, -left * x, -top * y)
    scale = max(x, y) if "slice" in words else min(x, y)
    align = words[0] if words else "xMidYMid"
    shares = {"xMin": 0.0, "xMax": 1.0}.get(align[:4], 0.5), {"YMin": 0.0, "YMax": 1.0}.get(align[4:], 0.5)
    return (
        scale,
        0.0,
        0.0,
        scale,
        shares[0] * (width - wide * scale) - left * scale,
        shares[1] * (height - high * scale) - top * scale,
    )


def _check_box(path: Path, element: Element, box: Box) -> Box:
    if box[2] <= 0.0 or box[3] <= 0.0:
        raise LoadError(path, f"the canvas is empty, {box[2]:g} by {box[3]:g}", line=element.line)
    return box
