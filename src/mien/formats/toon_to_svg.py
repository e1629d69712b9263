"""A drawn face as an SVG file that an artist can open: groups and layers named after features, curves kept.

``toon_from_svg`` reads it again.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import groupby
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from mien.core import Path, Pose
from mien.faces.toon.lines import EYES
from mien.faces.toon.motors import motors
from mien.faces.toon.records import Outline, Polygon
from mien.faces.toon.toon import ToonFace
from mien.render.pixels import to_srgb

from .numbers import format_number
from .svg_reader_xml import INKSCAPE, SVG
from .toon_from_svg_guess import EYE_ROLES, MOUTH_ROLES
from .toon_from_svg_pieces import find_role

DECIMALS = 2
"""Of coordinates, in drawing units."""

LEAST_AREA = 0.05
"""Square units below which a shape shows nothing, as a lid line of an open eye."""

MISLEADING = (*EYE_ROLES, *MOUTH_ROLES, "brow", "face")
"""What the id of a polygon of no feature must not seem to be: there may be eyes on a cap."""

GROUPS: Mapping[str, str] = {
    "BR": "brow_right",
    "BL": "brow_left",
    "ER": "eye_right",
    "EL": "eye_left",
    "PR": "pupil_right",
    "PL": "pupil_left",
    "M": "mouth",
    "N": "nose",
    "AR": "ear_right",
    "AL": "ear_left",
}
"""Names of groups by feature."""


def toon_to_svg(face: ToonFace, pose: Pose) -> str:
    """The text of an SVG file; the same pose has the same text.

    Args:
        face: a drawn face.
        pose: of its table. At rest curves stay curves; in other poses outlines are short straight lines.
    """
    writer = _Writer(face, pose)
    width, height = (format_number(side, DECIMALS) for side in face.character.size)
    body = list(writer.groups())
    return "\n".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<svg xmlns="{SVG}" xmlns:inkscape="{INKSCAPE}" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}">',
            *writer.definitions(),
            f'<rect id="background" width="{width}" height="{height}" fill="{_hex(writer.background)}"/>',
            *body,
            "</svg>",
            "",
        ]
    )


class _Writer:
    """Knows the polygons of a face and how they look in a pose."""

    def __init__(self, face: ToonFace, pose: Pose) -> None:
        drawing = face.shape(pose)
        self._polygons = {polygon.id: polygon for polygon in face.character.polygons}
        paths: list[Path] = list(drawing.paths)
        self._holes: tuple[str, ...] = ()
        if face.character.mode == "strict":
            # A face with holes, through which pupils are seen, is drawn whole, and the holes are painted on it.
            paths.sort(key=lambda path: self._polygons[path.name].kind != "face")
            self._holes = tuple(polygon.id for polygon in face.character.polygons if polygon.kind == "hole")
        self._paths = {path.name: path for path in paths}
        self._height = face.character.size[1]
        still = face.shape(face.neutral).paths
        self._unmoved = {
            path.name
            for path, rest in zip(drawing.paths, still, strict=True)
            if all(np.array_equal(one, other) for one, other in zip(path.contours, rest.contours, strict=True))
        }
        self.background = (drawing.background or (1.0,) * 4)[:3]

    def definitions(self) -> Iterator[str]:
        """What shapes are cut by."""
        cuts = dict.fromkeys(self._cut(polygon) for polygon in self._polygons.values())
        for names in filter(None, cuts):
            paths = [self._paths[name] for name in names]
            shapes = "".join(f'<path clip-rule="{path.rule}" d="{self._flat(path)}"/>' for path in paths)
            yield f"<clipPath id={quoteattr(_clip_id(names))}>{shapes}</clipPath>"

    def _cut(self, polygon: Polygon) -> tuple[str, ...]:
        """The polygons in one of which a polygon is seen; empty for all that is there."""
        return self._holes if polygon.kind == "pupil" and self._holes else polygon.clip[:1]

    def groups(self) -> Iterator[str]:
        """The shapes in the order in which they are painted, those of one feature together."""
        seen: dict[str, int] = {}
        shown = [name for name in self._paths if self._shows(name)]
        for group, names in groupby(shown, lambda name: _group(self._polygons[name])):
            shapes = [self._shape(name) for name in names]
            if not group:
                yield from shapes
                continue
            seen[group] = seen.get(group, 0) + 1
            number = f"-{seen[group]}" if seen[group] > 1 else ""
            yield f'<g id="{group}-layer{number}" inkscape:groupmode="layer" inkscape:label="{group}">'
            yield from shapes
            yield "</g>"

    def _shows(self, name: str) -> bool:
        """Whether a shape shows anything; the opening of a shut mouth stays, for its colour."""
        if self._paths[name].color[3] == 0.0:
            return False
        polygon = self._polygons[name]
        return polygon.kind == "hole" or sum(map(_area, self._paths[name].contours)) > LEAST_AREA

    def _shape(self, name: str) -> str:
        path, polygon = self._paths[name], self._polygons[name]
        color = _hex(path.color[:3])
        opacity = f' opacity="{path.color[3]:.4g}"' if path.color[3] < 1.0 else ""
        label = f" inkscape:label={quoteattr(found)}" if (found := _label(polygon)) else ""
        cuts = self._cut(polygon)
        cut = f" clip-path={quoteattr(f'url(#{_clip_id(cuts)})')}" if cuts else ""
        curved = bool(polygon.path) and name in self._unmoved and self._is_as_drawn(polygon)
        if curved and len(polygon.width) == 1:
            width = format_number(polygon.width[0][1], DECIMALS)
            paint = (
                f'fill="none" stroke="{color}" stroke-width="{width}" stroke-linecap="round" stroke-linejoin="round"'
            )
            data = _curves(polygon.path, closed=polygon.closed)
        elif curved and not polygon.width:
            paint, data = f'fill="{color}"', _curves(polygon.path, closed=True)
        else:
            paint, data = f'fill="{color}"', self._flat(path)
        rule = ' fill-rule="evenodd"' if path.rule == "evenodd" else ""
        return f"<path id={quoteattr(name)}{label}{cut} {paint}{rule}{opacity} d={quoteattr(data)}/>"

    def _is_as_drawn(self, polygon: Polygon) -> bool:
        """Whether the outline of the file is where the shape is: proportions could have moved it."""
        points = np.concatenate([command.points[-1:] for command in polygon.path])
        drawn = np.concatenate(self._paths[polygon.id].contours)
        low, high = drawn.min(axis=0), drawn.max(axis=0)
        margin = 0.5 * max((width for _, width in polygon.width), default=0.0) + 0.01
        ends = np.stack([points[:, 0], self._height - points[:, 1]], axis=1)
        return bool((ends >= low - margin).all() and (ends <= high + margin).all())

    def _flat(self, path: Path) -> str:
        """Path data of short straight lines."""
        return "".join(
            "M" + " ".join(f"{_number(x)},{_number(self._height - y)}" for x, y in contour.tolist()) + "Z"
            for contour in path.contours
        )


def _clip_id(names: tuple[str, ...]) -> str:
    return "clip-" + "-".join(names)


def _group(polygon: Polygon) -> str:
    """The feature that a polygon belongs to; empty for what is none's."""
    if polygon.kind == "face":
        return "head"
    feature = polygon.feature or (polygon.span[0].feature if polygon.span else "")
    feature = feature or (polygon.stroke.feature if polygon.stroke else "")
    if polygon.motor and motors()[polygon.motor].feature in EYES:
        feature = motors()[polygon.motor].feature
    return GROUPS.get(feature or _feature_of_point(polygon.point), "")


def _feature_of_point(point: str) -> str:
    return point if point in ("N", "AR", "AL") else "M" if point.startswith("M") else ""


def _label(polygon: Polygon) -> str:
    """What a polygon is within its feature, in words that are read again; empty where its id tells."""
    group = _group(polygon)
    inside = polygon.layer == "inner" or "mouth" in polygon.clip
    brush = bool(polygon.width)
    match group.partition("_")[0], polygon.kind:
        case "head", _:
            return "head"
        case "eye", "hole":
            return "white"
        case "eye", _:
            return "rim" if polygon.closed and brush else "lash" if brush else "lid"
        case "mouth", "hole":
            return "mouth"
        case "mouth", "feature" if not inside:
            if (polygon.closed and brush) or find_role((polygon.id,))[0] == "mouth":
                return ""
            lower = "lower " if polygon.line == "lower" or (polygon.stroke and polygon.stroke.lower) else ""
            return f"{lower}mouth line" if len(polygon.width) == 1 else f"{lower}lip"
        case "mouth", _:
            return "tongue" if polygon.kind in ("point", "free") else "teeth"
        case "brow" | "pupil" as feature, _:
            return feature
    misleads = polygon.kind in ("free", "point") and find_role((polygon.id,))[0] in MISLEADING
    return f"free {polygon.id}" if misleads else ""


def _curves(outline: Outline, *, closed: bool) -> str:
    pieces = []
    for number, command in enumerate(outline):
        if command.kind == "M" and number and closed:
            pieces.append("Z")
        pieces.append(command.kind + " ".join(f"{_number(x)},{_number(y)}" for x, y in command.points.tolist()))
    return " ".join([*pieces, "Z"] if closed else pieces)


def _area(contour: NDArray[np.float64]) -> float:
    x, y = contour.T
    return float(abs((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())) / 2.0


def _number(value: float) -> str:
    return format_number(value, DECIMALS)


def _hex(linear: tuple[float, ...]) -> str:
    codes = to_srgb(np.asarray(linear[:3], dtype=np.float32))
    return "#" + "".join(f"{code:02x}" for code in codes.tolist())
