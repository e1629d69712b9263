"""Pictures as filled paths: SVG, sharp at every size.

Source: Scalable Vector Graphics (SVG) 1.1, W3C Recommendation 2011.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path as FilePath
from xml.sax.saxutils import escape, quoteattr

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mien.core import Drawing, Path, Region, Scene
from mien.core.drawing import Rgba
from mien.render.outlines import find_fillings, place_canvas
from mien.render.pixels import to_srgb
from mien.render.wire import INK, LINE_SHARE

from .atomic import writing
from .numbers import format_number

STEPS = 50_000
"""Coordinates are rounded so that the longer side of the picture has at least as many steps."""

STOPS = 17
"""Stops of the background: it runs evenly in linear light, but gradients of viewers run in sRGB."""

SEAM_SHARE = 1.0 / 1000.0
"""Width of the line around a polygon in its own colour, a share of the shorter side: without it seams shine through."""

SEAM_OF_THICKNESS = 0.45
"""The same as a share of the thickness of thin polygons: a lash must not look like two."""


OVERLAP_PX = 2
"""Width of the line around what fills a hole, half of it under what has the hole."""


@dataclass(frozen=True, eq=False)
class VectorPicture:
    """Filled paths that can be written, and that show themselves in a notebook.

    Attributes:
        drawing: the paths, in the order in which they are painted.
        scene: size, background and, of polygons, whether their edges are inked (shading wire).
        polygons: the paths are neighbours on a surface, and no seam between them may be seen.
        notes: text that goes into the file: what made it, which face.
    """

    drawing: Drawing
    scene: Scene
    polygons: bool = False
    notes: Mapping[str, str] = field(default_factory=dict)

    def write(self, path: FilePath | str) -> None:
        """Writes an SVG file.

        Raises:
            MienError: the place cannot be written.
        """
        text = self.to_svg()
        with writing(path) as temporary:
            temporary.write_text(text, encoding="utf-8", newline="\n")

    def to_svg(self) -> str:
        """The text of an SVG file; the same picture has the same text."""
        return "\n".join(
            [*self._head(), *_background(self.scene.behind(self.drawing.background)), *self._paths(), "</svg>", ""]
        )

    def _repr_svg_(self) -> str:
        return self.to_svg()

    def _head(self) -> Iterator[str]:
        width, height = self.scene.size_px
        yield (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}" role="img">'
        )
        title = self.notes.get("Title") or self.notes.get("Face")
        if title:
            yield f"<title>{escape(title)}</title>"
        if self.notes:
            yield f"<desc>{escape('; '.join(f'{key}: {value}' for key, value in self.notes.items()))}</desc>"

    def _paths(self) -> Iterator[str]:
        width, height = self.scene.size_px
        canvas = _Canvas(self.scene.size_px, *place_canvas(self.drawing, self.scene.size_px))
        ink = self.polygons and self.scene.shading == "wire"
        line = min(width, height) * (LINE_SHARE if ink else SEAM_SHARE)
        body = list(self._groups(canvas, line if self.polygons and not ink else 0.0))
        if canvas.definitions:
            yield f"<defs>{''.join(canvas.definitions.values())}</defs>"
        yield (
            f'<g fill-rule="evenodd" stroke-width="{line:.4g}" stroke-linejoin="round"'
            + (f' stroke="{_hex(INK)}">' if ink else ">")
        )
        yield from body
        yield "</g>"

    def _groups(self, canvas: _Canvas, seam: float) -> Iterator[str]:
        """The paths of a name together, and among them those that are cut alike."""
        paths = self.drawing.paths
        owners: dict[int, list[Path]] = {}
        for before, later in find_fillings(self.drawing):
            owners.setdefault(before, []).append(paths[later])
        for name, numbers in groupby(range(len(paths)), lambda number: paths[number].name):
            yield f"<g class={quoteattr(name)}>"
            for cuts, alike in groupby(numbers, lambda number: canvas.cuts(paths[number])):
                yield from (f"<g {cut}>" for cut in cuts)
                for number in alike:
                    path, data = paths[number], canvas.data(paths[number])
                    color = f'"{_hex(path.color[:3])}"'
                    rule = ' fill-rule="nonzero"' if path.rule == "nonzero" else ""
                    around = _seam(path, canvas.scale, seam, color) if seam else ""
                    yield f'<path fill={color}{_opacity("fill", path.color[3])}{rule}{around} d="{data}"/>'
                    for owner in owners.get(number, ()):
                        # Where the hole that it fills ends both cover their part of a pixel; nothing may shine through.
                        line = f'stroke={color}{_opacity("stroke", path.color[3])} stroke-width="{OVERLAP_PX}"'
                        yield f'<path {canvas.clip(owner)} fill="none" {line} d="{data}"/>'
                yield from ("</g>" for _ in cuts)
            yield "</g>"


@dataclass(frozen=True)
class _Canvas:
    """Where a drawing lies in a picture, and what of it cuts paths: each outline is defined once.

    Attributes:
        size_px: of the picture.
        scale, left, bottom: pixels a unit, and where the origin lies.
        definitions: clips and masks by name.
    """

    size_px: tuple[int, int]
    scale: float
    left: float
    bottom: float
    definitions: dict[str, str] = field(default_factory=dict)

    def data(self, outline: Path | Region) -> str:
        """The contours of an outline, in pixels, as a path has them."""
        decimals = max(0, math.ceil(math.log10(STEPS / max(self.size_px))))
        places = [
            np.stack([self.left + contour[:, 0] * self.scale, self.bottom - contour[:, 1] * self.scale], axis=1)
            for contour in outline.contours
            if len(contour)
        ]
        return "".join(
            "M" + " ".join(format_number(value, decimals) for value in contour.ravel().tolist()) + "z"
            for contour in places
        )

    def cuts(self, path: Path) -> tuple[str, ...]:
        """Attributes of groups, one in the other, that cut a path."""
        return (*map(self.clip, path.inside), *map(self.mask, path.outside))

    def clip(self, outline: Path | Region) -> str:
        """The attribute by which what is inside of an outline is left."""
        data = self.data(outline)
        name = f"clip-{_sign(outline.rule, data)}"
        self.definitions[name] = f'<clipPath id="{name}"><path clip-rule="{outline.rule}" d="{data}"/></clipPath>'
        return f'clip-path="url(#{name})"'

    def mask(self, region: Region) -> str:
        """The attribute by which what is outside of a region is left: a clip has no way to say so of every rule."""
        data, (width, height) = self.data(region), self.size_px
        name = f"mask-{_sign(region.rule, data)}"
        whole = f'x="0" y="0" width="{width}" height="{height}"'
        self.definitions[name] = (
            f'<mask id="{name}" maskUnits="userSpaceOnUse" {whole}><rect {whole} fill="#fff"/>'
            f'<path fill="#000" fill-rule="{region.rule}" d="{data}"/></mask>'
        )
        return f'mask="url(#{name})"'


def _sign(*texts: str) -> str:
    """Eight letters that differ where texts do: pictures in one page must not share a name for different things."""
    return f"{zlib.crc32(''.join(texts).encode()):08x}"


def _seam(path: Path, scale: float, seam: float, color: str) -> str:
    """Attributes of the line around a polygon in its own colour."""
    own = SEAM_OF_THICKNESS * _thickness(path.contours[0] * scale)
    return f" stroke={color}" + (f' stroke-width="{own:.2g}"' if own < seam else "")


def _thickness(outline: NDArray[np.float64]) -> float:
    """How wide a thin polygon (n, 2) is: twice its area over its circumference."""
    doubled_area = circumference = 0.0
    corners = outline.tolist()
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True):
        doubled_area += ax * by - bx * ay
        circumference += math.sqrt((bx - ax) * (bx - ax) + (by - ay) * (by - ay))
    return abs(doubled_area) / max(circumference, 1e-9)


def _background(ends: tuple[Rgba, Rgba]) -> Iterator[str]:
    bottom, top = (np.array(color) for color in ends)
    if bottom[3] == top[3] == 0.0:
        return
    if (bottom == top).all():
        yield f'<rect width="100%" height="100%" fill="{_hex(top[:3])}"{_opacity("fill", float(top[3]))}/>'
        return
    stops = []
    for up in np.linspace(0.0, 1.0, STOPS):
        color = bottom + (top - bottom) * up
        stops.append(f'<stop offset="{up:.4f}" stop-color="{_hex(color[:3])}"{_opacity("stop", float(color[3]))}/>')
    name = f"background-{_sign(*stops)}"
    yield f'<defs><linearGradient id="{name}" x1="0" y1="1" x2="0" y2="0">'
    yield from stops
    yield "</linearGradient></defs>"
    yield f'<rect width="100%" height="100%" fill="url(#{name})"/>'


def _opacity(kind: str, alpha: float) -> str:
    return f' {kind}-opacity="{alpha:.4g}"' if alpha < 1.0 else ""


def _hex(linear: ArrayLike) -> str:
    codes: NDArray[np.uint8] = to_srgb(np.asarray(linear, dtype=np.float32))
    return "#" + "".join(f"{code:02x}" for code in codes.tolist())
