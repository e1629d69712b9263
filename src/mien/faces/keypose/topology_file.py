"""Topology files: parts, polygons by point number with their colour, midline, creases.

Source: Parke 1972, "Representation of the face" (around each polygon clockwise) and "The animation program".
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import Path

from mien.core import LoadError, Material

from .lines import read_lines
from .records import KeyposeTopology, Polygon, SkinPart

COLOR = re.compile(r"#[0-9a-fA-F]{6}")
PART_NAME = re.compile(r"[A-Za-z][\w.-]*")
MOST_POINTS = 100_000
"""More than anybody measures by hand; a number beyond it is a slip."""

BLEND = "blend"

FLAGS: Mapping[str, tuple[str, bool]] = {
    "two-sided": ("two_sided", True),
    "flat": ("flat", True),
    "unlit": ("lit", False),
    "subdivide": ("subdivide", True),
}
"""Word behind the name of a part -> field of its material and what it becomes."""


def read_topology(path: Path) -> KeyposeTopology:
    """The topology in a file.

    Raises:
        LoadError: with the line that is wrong.
    """
    draft = _Draft(path)
    for number, words in read_lines(path):
        READERS.get(words[0], _Draft.add_polygon)(draft, words, number)
    return draft.finish()


def format_topology(topology: KeyposeTopology) -> str:
    """The text of a topology file."""
    lines: list[str] = []
    for part in topology.parts:
        lines.append(" ".join(["part", part.name, *_material_words(part.material), *([BLEND] if part.blend else [])]))
        lines += [" ".join([*map(str, polygon.points), polygon.color]) for polygon in part.polygons]
        lines.append("")
    if topology.midline:
        lines += [" ".join(["midline", *map(str, topology.midline)]), ""]
    lines += [" ".join(["crease", *map(str, line)]) for line in topology.creases]
    return "\n".join(lines).rstrip("\n") + "\n"


@dataclass
class _Draft:
    """A topology while its file is read."""

    path: Path
    parts: list[SkinPart] = field(default_factory=list)
    polygons: list[list[Polygon]] = field(default_factory=list)
    midline: dict[int, int] = field(default_factory=dict)
    creases: list[tuple[tuple[int, ...], int]] = field(default_factory=list)

    def add_part(self, words: list[str], line: int) -> None:
        if len(words) < 2 or not PART_NAME.fullmatch(words[1]):
            raise LoadError(self.path, f"want 'part NAME', got {' '.join(words)!r}", line=line)
        if words[1] in (part.name for part in self.parts):
            raise LoadError(self.path, f"part {words[1]!r} is there twice", line=line)
        flags = [word for word in words[2:] if word != BLEND]
        self.parts.append(SkinPart(words[1], (), self._material(flags, line), BLEND in words))
        self.polygons.append([])

    def _material(self, words: list[str], line: int) -> Material:
        fields: dict[str, object] = {}
        rest = iter(words)
        for word in rest:
            if word == "gloss":
                gloss = next(rest, "nothing")
                fields["gloss"] = _share(gloss)
                if fields["gloss"] is None:
                    raise LoadError(self.path, f"want a gloss from 0 to 1, got {gloss!r}", line=line)
            elif word in FLAGS:
                name, value = FLAGS[word]
                fields[name] = value
            else:
                known = ", ".join(["gloss NUMBER", *FLAGS, BLEND])
                raise LoadError(self.path, f"{word!r} is nothing that a part can be", line=line, hint=f"it is {known}")
        return Material(**fields)  # type: ignore[arg-type]

    def add_polygon(self, words: list[str], line: int) -> None:
        if not self.parts:
            raise LoadError(self.path, f"a polygon before any part: {' '.join(words)!r}", line=line, hint="part skin")
        if not COLOR.fullmatch(words[-1]):
            got = " ".join(words)
            raise LoadError(self.path, f"want 'number number number … #rrggbb', got {got!r}", line=line)
        points = self._numbers(words[:-1], line)
        if len(points) < 3:
            raise LoadError(self.path, f"a polygon of {len(points)} points: it takes three", line=line)
        if len(set(points)) != len(points):
            twice = next(point for point in points if points.count(point) > 1)
            raise LoadError(self.path, f"point {twice} is twice in one polygon", line=line)
        self.polygons[-1].append(Polygon(points, words[-1].lower(), line))

    def add_midline(self, words: list[str], line: int) -> None:
        for point in self._numbers(words[1:], line):
            self.midline.setdefault(point, line)

    def add_crease(self, words: list[str], line: int) -> None:
        points = self._numbers(words[1:], line)
        if len(points) < 2:
            raise LoadError(self.path, "a crease takes two points or more", line=line)
        self.creases.append((points, line))

    def _numbers(self, words: list[str], line: int) -> tuple[int, ...]:
        for word in words:
            if not (word.isascii() and word.isdecimal()) or not 1 <= int(word[:9]) <= MOST_POINTS or len(word) > 9:
                raise LoadError(self.path, f"{word!r} is not the number of a point, 1 or more", line=line)
        return tuple(map(int, words))

    def finish(self) -> KeyposeTopology:
        """The topology, when it is whole."""
        parts = tuple(replace(part, polygons=tuple(own)) for part, own in zip(self.parts, self.polygons, strict=True))
        topology = KeyposeTopology(parts, tuple(self.midline), tuple(points for points, _ in self.creases))
        if not topology.polygons:
            raise LoadError(self.path, "has no polygon", hint="part skin, and a line such as 1 2 3 #e0ac96")
        used = {point for polygon in topology.polygons for point in polygon.points}
        for polygon in topology.polygons:
            for point in polygon.points:
                if point > len(used):
                    gap = next(number for number in range(1, point) if number not in used)
                    raise LoadError(
                        self.path,
                        f"point {point} is here, but point {gap} is in no polygon",
                        line=polygon.line,
                        hint="points are numbered from 1 without gaps",
                    )
        for point, line in self.midline.items():
            if point not in used:
                raise LoadError(self.path, f"point {point} of the midline is in no polygon", line=line)
        self._check_edges(topology)
        return topology

    def _check_edges(self, topology: KeyposeTopology) -> None:
        for points, line in self.creases:
            for first, last in pairwise(points):
                if frozenset((first, last)) not in topology.edges:
                    raise LoadError(
                        self.path,
                        f"{first} {last} is no edge of a polygon, so a polygon would span the crease",
                        line=line,
                        hint="name neighbours along the edges of polygons",
                    )
        self._check_sense(topology)

    def _check_sense(self, topology: KeyposeTopology) -> None:
        """Two polygons at one edge go along it in opposite directions; fins at which several meet are not judged."""
        lines: dict[frozenset[int], list[tuple[int, int]]] = {}
        for part in topology.parts:
            for polygon in part.polygons if not part.material.two_sided else ():
                around = polygon.points
                for first, last in zip(around, [*around[1:], around[0]], strict=True):
                    lines.setdefault(frozenset((first, last)), []).append((first, polygon.line))
        for edge, ways in lines.items():
            if len(ways) == 2 and ways[0][0] == ways[1][0]:
                first, (last,) = ways[0][0], edge - {ways[0][0]}
                raise LoadError(
                    self.path,
                    f"goes from {first} to {last}, and so does the polygon in line {ways[0][1]}",
                    line=ways[1][1],
                    hint="go around every polygon clockwise as seen from outside",
                )


READERS: Mapping[str, Callable[[_Draft, list[str], int], None]] = {
    "part": _Draft.add_part,
    "midline": _Draft.add_midline,
    "crease": _Draft.add_crease,
}


def _share(word: str) -> float | None:
    try:
        number = float(word)
    except ValueError:
        return None
    return number if math.isfinite(number) and 0.0 <= number <= 1.0 else None


def _material_words(material: Material) -> Iterator[str]:
    if material.gloss:
        yield from ("gloss", repr(material.gloss))
    for word, (name, value) in FLAGS.items():
        if getattr(material, name) == value:
            yield word
