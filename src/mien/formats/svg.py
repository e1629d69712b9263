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

from mien.core import Drawing, Path, Scene
from mien.core.drawing import Rgba
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
        """Paths in canvas units become pixels: the canvas is centred, as large as the picture's size allows."""
        width, height = self.scene.size_px
        scale = min(width / self.drawing.size[0], height / self.drawing.size[1])
        left = (width - scale * self.drawing.size[0]) / 2.0
        bottom = (height + scale * self.drawing.size[1]) / 2.0
        decimals = max(0, math.ceil(math.log10(STEPS / max(width, height))))
        ink = self.polygons and self.scene.shading == "wire"
        line = min(width, height) * (LINE_SHARE if ink else SEAM_SHARE)
        yield (
            f'<g fill-rule="evenodd" stroke-width="{line:.4g}" stroke-linejoin="round"'
            + (f' stroke="{_hex(INK)}">' if ink else ">")
        )
        for name, paths in groupby(self.drawing.paths, lambda path: path.name):
            yield f"<g class={quoteattr(name)}>"
            for path in paths:
                contours = [
                    np.stack([left + contour[:, 0] * scale, bottom - contour[:, 1] * scale], axis=1)
                    for contour in path.contours
                ]
                yield _path(path, contours, decimals, line if self.polygons and not ink else 0.0)
            yield "</g>"
        yield "</g>"


def _path(path: Path, contours: list[NDArray[np.float64]], decimals: int, seam: float) -> str:
    outlines = [
        "M" + " ".join(format_number(value, decimals) for value in contour.ravel().tolist()) + "z"
        for contour in contours
    ]
    color = _hex(path.color[:3])
    stroke = ""
    if seam:
        own = SEAM_OF_THICKNESS * _thickness(contours[0])
        stroke = f' stroke="{color}"' + (f' stroke-width="{own:.2g}"' if own < seam else "")
    return f'<path fill="{color}"{_opacity("fill", path.color[3])}{stroke} d="{"".join(outlines)}"/>'


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
    # Pictures that are put into one page must not share a name for different backgrounds.
    name = f"background-{zlib.crc32(''.join(stops).encode()):08x}"
    yield f'<defs><linearGradient id="{name}" x1="0" y1="1" x2="0" y2="0">'
    yield from stops
    yield "</linearGradient></defs>"
    yield f'<rect width="100%" height="100%" fill="url(#{name})"/>'


def _opacity(kind: str, alpha: float) -> str:
    return f' {kind}-opacity="{alpha:.4g}"' if alpha < 1.0 else ""


def _hex(linear: ArrayLike) -> str:
    codes: NDArray[np.uint8] = to_srgb(np.asarray(linear, dtype=np.float32))
    return "#" + "".join(f"{code:02x}" for code in codes.tolist())
