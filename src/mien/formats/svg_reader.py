"""The shapes of an SVG file, in one system of coordinates, with the colours in which they are painted.

A drawing from anywhere: nothing is fetched, expanded without bound or executed; what cannot be shown is remarked on.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from mien.core import LoadError

from .svg_reader_outlines import Affine, Contour, Outline, count_points, ellipse, scale_of, then, transform
from .svg_reader_paints import REFERENCE, Paint, Paints, parse_share
from .svg_reader_paths import parse_length, parse_transform
from .svg_reader_shapes import MOST_POINTS, SHAPES, fit_view, read_attribute, read_canvas, read_outline, too_many_points
from .svg_reader_style import INITIAL, cascade, read_rules
from .svg_reader_xml import MOST_ELEMENTS, Element, Remarks, read_elements

DEEPEST_VISIT = 200
"""How deep elements may lie in one another once what is used is put in its place."""

DOT = 0.02
"""A stroke that is shorter than this share of its width is a dot."""

GROUPS = ("g", "svg", "a", "switch", "symbol")
SILENT = (
    "defs", "title", "desc", "metadata", "style", "linearGradient", "radialGradient", "solidColor", "clipPath", "mask",
    "pattern", "marker", "filter", "view",
)  # fmt: skip
"""Elements that show nothing by themselves."""

REASONS = {
    "image": "pictures are neither read nor fetched",
    "text": "turn letters into paths first",
    "animate": "a face moves by its motors",
    "animateTransform": "a face moves by its motors",
    "animateMotion": "a face moves by its motors",
    "set": "a face moves by its motors",
}
"""Why elements are left out."""

UNSHOWN = ("mask", "filter", "stroke-dasharray")
"""Properties that change what is seen and are not followed."""


@dataclass(frozen=True)
class SvgShape:
    """One outline that is filled or stroked.

    Attributes:
        names: its own label and id.
        groups: labels and ids of the groups around it, the innermost first.
        line: of the file.
        outline: in the drawing's units, x to the right, y downwards.
        color: sRGB and alpha 0..1.
        even_odd: whether what is enclosed twice is a hole.
        width: of the stroke, in the drawing's units; 0 for a filled shape.
        clips: outlines that it is seen in only, in all of them at once.
    """

    names: tuple[str, ...]
    groups: tuple[str, ...]
    line: int
    outline: Outline
    color: Paint
    even_odd: bool = False
    width: float = 0.0
    clips: tuple[Outline, ...] = ()


@dataclass(frozen=True)
class SvgDrawing:
    """What an SVG file shows.

    Attributes:
        path: the file.
        size: width and height of the canvas, whose upper left corner is the origin.
        shapes: in the order in which they are painted.
        remarks: what is not shown as it was meant, a line each.
    """

    path: Path
    size: tuple[float, float]
    shapes: tuple[SvgShape, ...]
    remarks: tuple[str, ...]


def read_svg(path: Path | str) -> SvgDrawing:
    """The shapes of an SVG file.

    Raises:
        LoadError: it is no SVG, declares entities, is too large, has more than ``MOST_POINTS`` points, shows nothing,
            or a number in it cannot be understood.
    """
    path = Path(path)
    remarks = Remarks(path)
    root = read_elements(path, remarks)
    left, top, width, height = read_canvas(path, root)
    walk = _Walk(path, root, remarks)
    walk.visit(root, _Place((1.0, 0.0, 0.0, 1.0, -left, -top), INITIAL, (), (), (width, height), 1.0))
    if not walk.shapes:
        hint = " ".join(remarks.texts()[:1]) or "is everything in <defs>, or not displayed?"
        raise LoadError(path, "shows no shape", hint=hint)
    return SvgDrawing(path, (width, height), tuple(walk.shapes), remarks.texts())


@dataclass(frozen=True)
class _Place:
    """What an element takes over from those around it.

    Attributes:
        affine: from its coordinates to the drawing's.
        style: values of the properties.
        names: its own.
        groups: names of the groups, the innermost first.
        view: width and height that percentages are of.
        opacity: of the groups.
        depth: how many there are around it.
        clips: outlines that it is seen in only.
    """

    affine: Affine
    style: Mapping[str, str]
    names: tuple[str, ...]
    groups: tuple[str, ...]
    view: tuple[float, float]
    opacity: float
    depth: int = 0
    clips: tuple[Outline, ...] = ()


class _Walk:
    """Goes through the elements and gathers shapes."""

    def __init__(self, path: Path, root: Element, remarks: Remarks) -> None:
        self.shapes: list[SvgShape] = []
        self._path, self._root, self._remarks = path, root, remarks
        self._by_id = {element.attributes["id"]: element for element in root if "id" in element.attributes}
        self._rules = read_rules(root, remarks)
        self._paints = Paints(self._by_id, self._rules, remarks)
        self._points = self._visited = 0
        self._used: list[str] = []
        self._outlines: dict[tuple[Element, tuple[float, float]], Outline] = {}

    def visit(self, element: Element, around: _Place) -> None:
        """Gathers what an element shows."""
        self._visited += 1
        if self._visited > MOST_ELEMENTS or around.depth > DEEPEST_VISIT:
            raise LoadError(
                self._path,
                f"<use> makes more than {MOST_ELEMENTS:,} elements, or nests them more than {DEEPEST_VISIT} deep",
                line=element.line,
                hint="draw what is used instead",
            )
        if element.name in SILENT:
            return
        style = cascade(element, around.style, self._rules, self._remarks)
        if style["display"] == "none":
            return
        for name in UNSHOWN:
            if style[name] != "none":
                self._remarks.add(element.line, f"{name} of <{element.name}> is not followed")
        turned = read_attribute(self._path, element, "transform", parse_transform, "")
        own = tuple(element.attributes[key] for key in ("label", "id") if key in element.attributes)
        opacity = around.opacity * self._share(element, style["opacity"])
        groups = (*around.names, *around.groups)
        depth, clips = around.depth + 1, around.clips
        place = _Place(then(turned, around.affine), style, own, groups, around.view, opacity, depth, clips)
        if style["clip-path"] != "none":
            place = replace(place, clips=(*clips, *self._clip(element, place)))
        if element.name in GROUPS:
            if element.name == "svg" and element is not self._root:
                place = self._enter_view(element, element.attributes, place)
            for child in element.children:
                self.visit(child, place)
        elif element.name == "use":
            self._use(element, place)
        elif element.name in SHAPES:
            self._paint(element, place)
        else:
            self._remarks.add(
                element.line, f"<{element.name}> is left out: {REASONS.get(element.name, 'it is no shape')}"
            )

    def _clip(self, element: Element, place: _Place) -> tuple[Outline, ...]:
        """What an element is clipped by; nothing, with a remark, where that cannot be followed."""
        match = REFERENCE.fullmatch(place.style["clip-path"].strip())
        target = self._by_id.get(match[1]) if match else None
        bounded = target is not None and target.attributes.get("clipPathUnits") == "objectBoundingBox"
        if target is None or target.name != "clipPath" or bounded:
            self._remarks.add(element.line, f"clip-path of <{element.name}> is not followed")
            return ()
        outline: Outline = ()
        for child in target.children:
            if child.name in SHAPES:
                turned = read_attribute(self._path, child, "transform", parse_transform, "")
                outline += transform(self._outline(child, place.view), then(turned, place.affine))
            elif child.name not in SILENT:
                self._remarks.add(child.line, f"<{child.name}> in <clipPath> is left out: only shapes are read")
        return (outline,) if outline else ()

    def _use(self, element: Element, place: _Place) -> None:
        href = element.attributes.get("href", "").strip()
        target = self._by_id.get(href[1:]) if href.startswith("#") else None
        if target is None:
            reason = "there is no such thing in it" if href.startswith("#") else "nothing outside the file is fetched"
            self._remarks.add(element.line, f"<use> of {href[:60]!r} is left out: {reason}")
            return
        if href in self._used:
            raise LoadError(self._path, f"<use> of {href!r} leads back to itself", line=element.line)
        shift = (self._length(element, "x", place.view[0]), self._length(element, "y", place.view[1]))
        place = replace(place, affine=then((1.0, 0.0, 0.0, 1.0, *shift), place.affine))
        if target.name == "symbol":
            sides = {side: element.attributes[side] for side in ("width", "height") if side in element.attributes}
            place = self._enter_view(target, sides, place)
        self._used.append(href)
        self.visit(target, place)
        self._used.pop()

    def _enter_view(self, element: Element, sides: Mapping[str, str], place: _Place) -> _Place:
        """The place inside an element with a view of its own."""
        given = _with_attributes(element, sides)
        width, height = (
            self._length(given, name, whole, "100%")
            for name, whole in zip(("width", "height"), place.view, strict=True)
        )
        corner = (1.0, 0.0, 0.0, 1.0, self._length(given, "x", place.view[0]), self._length(given, "y", place.view[1]))
        fitted = fit_view(self._path, element, width, height)
        inside = (width, height)
        return replace(place, affine=then(fitted, then(corner, place.affine)), view=inside)

    def _paint(self, element: Element, place: _Place) -> None:
        if place.style["visibility"] != "visible":
            return
        outline = self._outline(element, place.view)
        outline = transform(outline, place.affine)
        filled = tuple(contour for contour in outline if len(contour.segments) > 1 or len(contour.segments[0]) > 1)
        if filled and element.name != "line" and (color := self._color(element, place, "fill")):
            closed = tuple(replace(contour, closed=True) for contour in filled)
            even_odd = place.style["fill-rule"] == "evenodd"
            self._add(element, place, SvgShape(place.names, place.groups, element.line, closed, color, even_odd))
        if outline and (color := self._color(element, place, "stroke")):
            width = self._length_of(element, place.style["stroke-width"], place.view) * scale_of(place.affine)
            if width > 0.0:
                self._stroke(element, place, outline, color, width)

    def _outline(self, element: Element, view: tuple[float, float]) -> Outline:
        """The outline of a shape in its own coordinates, which are read once however often it is used."""
        key = (element, view)
        if key not in self._outlines:
            self._outlines[key] = read_outline(self._path, element, view, MOST_POINTS - self._points)
        self._points += count_points(self._outlines[key])
        if self._points > MOST_POINTS:
            raise too_many_points(self._path, element)
        return self._outlines[key]

    def _stroke(self, element: Element, place: _Place, outline: Outline, color: Paint, width: float) -> None:
        """A stroke; one without length and with round ends is a dot."""
        lines: list[Contour] = []
        for contour in outline:
            if _reach(contour) > DOT * width:
                lines.append(contour)
            elif place.style["stroke-linecap"] == "round":
                dot = ellipse(*contour.start, width / 2.0, width / 2.0)
                self._add(element, place, SvgShape(place.names, place.groups, element.line, dot, color))
        if lines:
            stroke = SvgShape(place.names, place.groups, element.line, tuple(lines), color, width=width)
            self._add(element, place, stroke)

    def _add(self, element: Element, place: _Place, shape: SvgShape) -> None:
        """Keeps a shape with its clips, whose points count for each shape that they clip."""
        self._points += sum(map(count_points, place.clips))
        if self._points > MOST_POINTS:
            raise too_many_points(self._path, element)
        self.shapes.append(replace(shape, clips=place.clips))

    def _color(self, element: Element, place: _Place, of: str) -> Paint | None:
        color = self._paints.find(place.style[of], place.style, element.line)
        if color is None:
            return None
        alpha = color[3] * self._share(element, place.style[f"{of}-opacity"]) * place.opacity
        return (*color[:3], alpha) if alpha > 0.0 else None

    def _share(self, element: Element, text: str) -> float:
        try:
            return parse_share(text)
        except ValueError:
            raise LoadError(self._path, f"{text[:40]!r} is no opacity, want 0 to 1", line=element.line) from None

    def _length(self, element: Element, name: str, whole: float, otherwise: str = "0") -> float:
        return read_attribute(self._path, element, name, lambda text: parse_length(text, whole), otherwise)

    def _length_of(self, element: Element, text: str, view: tuple[float, float]) -> float:
        try:
            return parse_length(text, max(view))
        except ValueError as error:
            raise LoadError(self._path, f"stroke-width: {error}", line=element.line) from None


def _reach(contour: Contour) -> float:
    """How far a contour goes from its start at most, along either axis."""
    x, y = contour.start
    return max(max(abs(px - x), abs(py - y)) for segment in contour.segments for px, py in segment)


def _with_attributes(element: Element, attributes: Mapping[str, str]) -> Element:
    """The element with some attributes replaced."""
    return replace(element, attributes={**element.attributes, **attributes})
