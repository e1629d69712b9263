"""What a capture project says besides what was measured."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType

from .records import Photograph

METRES: Mapping[str, float] = MappingProxyType({"m": 1.0, "cm": 0.01, "mm": 0.001, "inch": 0.0254})
"""Units that lengths of a project may be written in."""

KINDS = ("chessboard", "charuco")

PROJECT, POINTS, REFERENCES, BOARDS, TOPOLOGY = (
    "project.toml",
    "points.csv",
    "references.csv",
    "boards.csv",
    "topology.txt",
)
"""Files of a project."""

PICTURES, SOLUTION = "photographs", "solution"
"""Folders of a project."""


@dataclass(frozen=True)
class Board:
    """A board whose corners are found in photographs.

    Attributes:
        target: what it is called; its corners are ``target:row:column``, both from 0 at the upper left.
        kind: ``chessboard`` or ``charuco``.
        columns, rows: how many squares it has; one corner less lies between them.
        square_m: side of a square.
        marker_m: side of a marker; of ChArUco boards.
        dictionary: of the markers, as OpenCV calls it; of ChArUco boards.
        photographs: names of those to look for it in; all, if there are none.
    """

    target: str
    kind: str
    columns: int
    rows: int
    square_m: float
    marker_m: float = 0.0
    dictionary: str = ""
    photographs: tuple[str, ...] = ()

    @property
    def corners(self) -> tuple[int, int]:
        """How many corners between squares there are, in (columns, rows)."""
        return self.columns - 1, self.rows - 1

    def may_be_in(self, photo: str) -> bool:
        """Whether to look for it in the photograph of that name."""
        return not self.photographs or photo in self.photographs


DISTANCE_SIGMA_M = 0.02
"""How exact a distance of a camera is where nothing is told: a tape measure, held to where the lens might begin."""


@dataclass(frozen=True)
class Pair:
    """A front and a side photograph without references, as of 1972.

    Attributes:
        front, side: names of the photographs.
        scale: two points and how far they are apart, m; without it, two references.
        camera_distance_m: by photograph, where it was measured: from the lens to the nearest point, and its standard
            deviation.
        orthographic: as if the cameras stood infinitely far away.
        midline: points on the symmetry plane.
        mirror: one half was measured, and the other is its mirror image.
        twins: points by the name of their mirror image.
        side_from: the face's own side that the side photograph shows; found where it is not told.
        side_turn_deg: standard deviation of how far the side photograph is turned from exact profile.
    """

    front: str
    side: str
    scale: tuple[str, str, float] | None = None
    camera_distance_m: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    orthographic: bool = False
    midline: tuple[str, ...] = ()
    mirror: bool = True
    twins: Mapping[str, str] = field(default_factory=dict)
    side_from: str | None = None
    side_turn_deg: float = 3.0


@dataclass(frozen=True)
class Project:
    """A capture project: ``project.toml`` and where it lies.

    Attributes:
        folder: all other files lie in it.
        name: of the project.
        doc: a line or two about it.
        unit: of lengths in its files; a name of ``METRES``.
        photographs: in the order of the file.
        boards: to be found in them.
        pair: if it is one.
        still: points that do not move with expression.
    """

    folder: Path
    name: str
    photographs: tuple[Photograph, ...]
    doc: str = ""
    unit: str = "mm"
    boards: tuple[Board, ...] = ()
    pair: Pair | None = None
    still: tuple[str, ...] = ()

    @property
    def metres(self) -> float:
        """Metres of its unit."""
        return METRES[self.unit]
