"""A character from a drawing: what an SVG file shows becomes a face that can be played."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mien.core import MienError

from .svg_reader import read_svg
from .toon_from_svg_colors import Palette
from .toon_from_svg_guess import Found, find_face
from .toon_from_svg_pieces import PAPER, make_pieces
from .toon_from_svg_polygons import make_polygons
from .toon_from_svg_rig import Rig, make_rig

TOLERANCE = 0.25
"""How far outlines may depart from those of the drawing, in drawing units."""


@dataclass(frozen=True, eq=False)
class GuessedToon:
    """A character as it was guessed from a drawing.

    Attributes:
        document: the contents of a ``toon.json``.
        found: the parts of the drawing and what they were taken for.
        rig: control points and limits.
        remarks: what of the drawing is not shown as it was meant, a line each.
    """

    document: Mapping[str, Any]
    found: Found
    rig: Rig
    remarks: tuple[str, ...]

    def to_text(self) -> str:
        """The text of a ``toon.json``: a line for each polygon, motor and feature."""
        lines = []
        for key, value in self.document.items():
            if isinstance(value, dict) and key != "head":
                inside = ",\n".join(f"  {_json(name)}: {_json(each)}" for name, each in value.items())
                lines.append(f" {_json(key)}: {{\n{inside}\n }}")
            elif isinstance(value, list) and value and isinstance(value[0], dict):
                inside = ",\n".join(f"  {_json(each)}" for each in value)
                lines.append(f" {_json(key)}: [\n{inside}\n ]")
            else:
                lines.append(f" {_json(key)}: {_json(value)}")
        return "{\n" + ",\n".join(lines) + "\n}\n"

    def summary(self) -> str:
        """What was found, in a line: features with the number of their polygons."""
        counts: dict[str, int] = {}
        for part in self.found.parts:
            counts[part.role or "free"] = counts.get(part.role or "free", 0) + 1
        return ", ".join(f"{count} {role.replace('_', ' ')}" for role, count in counts.items())


def toon_from_svg(path: Path | str, name: str, tolerance: float = TOLERANCE) -> GuessedToon:
    """The character that a drawing shows.

    Args:
        path: an SVG file.
        name: of the character.
        tolerance: how far outlines may depart from those of the drawing, in drawing units.

    Raises:
        LoadError: the file cannot be read, is hostile or too large, or there is no face in it.
        MienError: the tolerance is not above 0 and at most 10.
    """
    if not 0.0 < tolerance <= 10.0:
        raise MienError(f"tolerance {tolerance:g} is out of range — it goes from above 0 to 10 drawing units")
    drawing = read_svg(path)
    size, pieces, background = make_pieces(drawing, tolerance)
    found = find_face(drawing.path, size, pieces)
    rig = make_rig(found)
    palette = Palette()
    behind = background or PAPER
    ground = palette.add(behind, "background")
    polygons = make_polygons(found, rig, palette, behind)
    face = found.face
    document = {
        "format": "mien-toon",
        "version": 1,
        "name": name,
        "doc": f"Made from {drawing.path.name}.",
        "mode": "extended",
        "size": list(size),
        "background": ground,
        "palette": palette.codes(),
        "head": {
            "center": [round(face.x, 2), round(face.y, 2)],
            "radius": [round(face.width / 2.0, 2), round(face.height / 2.0, 2)],
            "pivot": [round(face.x, 2), round(face.bottom, 2)],
            "depth": 0.12,
            "bulge": 0,
            "shorten": 0.4,
        },
        "features": rig.features,
        "motors": rig.motors,
        "polygons": polygons,
    }
    return GuessedToon(document, found, rig, (*drawing.remarks, *found.remarks))


def _json(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)
