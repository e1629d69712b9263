"""What a file of a drawn face says, as records. Coordinates are those of the file: x right, y down."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Point = tuple[float, float]
Knots = tuple[tuple[float, float], ...]
"""A number that changes along a line: (place, value) pairs in order, one pair where it does not change."""

Mode = Literal["strict", "extended"]
Kind = Literal["face", "hole", "pupil", "free", "point", "feature"]
Layer = Literal["back", "face", "hole", "pupil", "inner", "free", "point", "feature", "front"]

KINDS: tuple[Kind, ...] = ("face", "hole", "pupil", "free", "point", "feature")
LAYERS: tuple[Layer, ...] = ("back", "face", "hole", "pupil", "inner", "free", "point", "feature", "front")
"""In the order in which an extended face is drawn."""

STEPS: tuple[Kind, ...] = ("hole", "pupil", "face", "free", "point", "feature")
"""In the order in which a strict face is drawn; the face is cut by the holes.

Source: Thórisson 1996, A1.2.2, "Drawing order".
"""


@dataclass(frozen=True)
class Limits:
    """How far a motor goes, from rest: drawing units, and degrees for pupils and head; ``low <= 0 <= high``."""

    low: float = 0.0
    high: float = 0.0
    low_deg: float = 0.0
    high_deg: float = 0.0


@dataclass(frozen=True)
class Depth:
    """How a polygon goes along when the head turns.

    Attributes:
        depth: how far it lies before the axis of the turn, in radii of the head.
        bulge: how much it follows the round of the head.
        shorten: how much it becomes narrow, 0..1.
    """

    depth: float = 0.0
    bulge: float = 0.0
    shorten: float = 0.0


@dataclass(frozen=True)
class Head:
    """What turns: an ellipse, and the point about which the head tilts."""

    center: Point
    radius: Point
    pivot: Point
    depth: Depth = Depth()


@dataclass(frozen=True)
class Profile:
    """How a line leaves its middle point for its ends: by (1 - |s|^p)^(1/q); (1, 1) is the paper's straight line."""

    p: float = 1.0
    q: float = 1.0


STRAIGHT = Profile()


@dataclass(frozen=True, eq=False)
class Feature:
    """Control points that are connected by lines.

    Attributes:
        name: ``BR``.
        points: resting place of each control point by name.
        smooth: of a brow: a curve through its three points instead of two straight lines.
        profile: of its lines at rest.
        profile_open: of the mouth's lines when it is open.
        profile_shut: of an eye's lines when it is shut.
        shape: distance of the line from where its profile puts it, along the line.
        depth: of what is attached to it.
    """

    name: str
    points: Mapping[str, Point]
    smooth: bool = False
    profile: Profile = STRAIGHT
    profile_open: Profile | None = None
    profile_shut: Profile | None = None
    shape: Knots = ()
    depth: Depth | None = None

    @property
    def literal(self) -> bool:
        """Its lines are those of the paper."""
        return not self.smooth and not self.shape and self.profile == STRAIGHT and self.profile_open is None


@dataclass(frozen=True, eq=False)
class Command:
    """A piece of an outline: a straight line (4 points are on it) or a cubic curve, or the start of a new contour."""

    kind: Literal["M", "L", "C"]
    points: Floats


Outline = tuple[Command, ...]


@dataclass(frozen=True)
class Line:
    """A stretch of a feature's line.

    Attributes:
        feature: its name.
        lower: the lower of the two lines of an eye or mouth.
        offset: how far below the line, along it (-1 left end as seen, 0 middle, 1 right end).
        offset_by: a motor that shrinks the offset as it goes to its minimum, and to which share.
        at: activations by motor code that hold whatever the face does.
        start: where it begins.
        end: where it ends.
        count: pieces.
    """

    feature: str
    lower: bool = False
    offset: Knots = ((0.0, 0.0),)
    offset_by: tuple[str, float] | None = None
    at: Mapping[str, float] = field(default_factory=dict)
    start: float = -1.0
    end: float = 1.0
    count: int = 28


@dataclass(frozen=True)
class Shift:
    """A state that is a movement of the resting outline.

    Attributes:
        move: (x, y).
        rotate_deg: positive turns from x to y.
        scale: (x, y) factors.
        about: what it turns and scales about.
        ramp: heights (y) between which it sets in; above the first nothing moves.
    """

    move: Point = (0.0, 0.0)
    rotate_deg: float = 0.0
    scale: Point = (1.0, 1.0)
    about: Point = (0.0, 0.0)
    ramp: tuple[float, float] | None = None


@dataclass(frozen=True)
class Touch:
    """A state in which the highest point of an outline reaches the middle of a line (a tongue the teeth)."""

    line: Line
    offset: float = 0.0


State = Outline | Shift | Touch


@dataclass(frozen=True, eq=False)
class Driver:
    """What a motor does to an outline at its minimum and at its maximum; several of them add up."""

    motor: str
    low: State | None = None
    high: State | None = None


@dataclass(frozen=True, eq=False)
class Polygon:
    """One polygon; which of its fields count is told by ``docs/toon-format.md``."""

    id: str
    kind: Kind
    fill: str
    layer: Layer
    path: Outline = ()
    low: Outline = ()
    high: Outline = ()
    motor: str = ""
    feature: str = ""
    line: Literal["", "upper", "lower"] = ""
    span: tuple[Line, Line] | None = None
    stroke: Line | None = None
    width: Knots = ()
    closed: bool = False
    follow: float = 1.0
    reach: float | None = None
    drivers: tuple[Driver, ...] = ()
    point: str = ""
    dilate: float | None = None
    fade: str = ""
    clip: tuple[str, ...] = ()
    rule: Literal["evenodd", "nonzero"] = "nonzero"
    depth: Depth | None = None
    body: bool = False
    part: str = ""
    opacity: float = 1.0


Values = Mapping[str, float]
"""P_ctrl or degrees by motor code."""


@dataclass(frozen=True)
class Gesture:
    """What a hand can do: a pose, or a move through several.

    Attributes:
        name: what marks call it.
        keys: when, seconds, and values by motor code; a pose has one key, at 0. What the first leaves out rests, and
            what a later one leaves out stays.
        doc: what it looks like.
        source: where it comes from.
    """

    name: str
    keys: tuple[tuple[float, Values], ...]
    doc: str = ""
    source: str = ""


@dataclass(frozen=True, eq=False)
class Character:
    """A drawn face as its file describes it."""

    name: str
    size: Point
    background: str
    palette: Mapping[str, str]
    head: Head
    features: Mapping[str, Feature]
    motors: Mapping[str, Limits]
    polygons: tuple[Polygon, ...]
    mode: Mode = "extended"
    doc: str = ""
    license: str = ""
    palettes: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    parts: Mapping[str, tuple[Driver, ...]] = field(default_factory=dict)
    expressions: Mapping[str, Values] = field(default_factory=dict)
    proportions: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    gestures: tuple[Gesture, ...] = ()
