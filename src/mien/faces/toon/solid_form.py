"""What each polygon of a drawn head is on a body: around it, on its front, standing out from it, or no part of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from .polygons import Contours
from .proportions import EARS, feature_of
from .records import Character, Floats, Polygon
from .solid_rim import directions, measure_reach, reach

Role = Literal["still", "front", "around", "out"]
Indices = NDArray[np.int64]

AROUND = 0.15
"""A polygon with more than this share of its vertices on the rim or beyond goes around the back: our choice."""

OUT, OUTER = 1.08, 0.35
"""What reaches so far beyond the rim, with more than this share of its vertices, stands out if it is small."""

SMALL, TINY = 0.5, 0.06
"""Shares of the area of the head: what is smaller and lies behind the face, or elsewhere, is small; our choice."""

EDGE = 1.0
"""What comes so near to the lower edge of the canvas reaches it, drawing units."""

BROAD, NOTCHES = 12, 3
"""What does not count for the rim, in 1 / 128 turns: at first all that stands out, then only what is very narrow."""

LONGEST = 9.0
"""Edges are cut to about this length, drawing units, so that they can bend."""


@dataclass(frozen=True, eq=False)
class Form:
    """A drawn head at rest, as the body that it is drawn on needs it.

    Attributes:
        height: of the canvas.
        center: (2,) the head's middle in the drawing, y down.
        radii: (COUNT,) of ``solid_rim``.
        roles: of each polygon.
        ears: which polygons are ears or hang from them, at the side of the head.
        inner: which polygons that stand out lie within one drawn before, and so on the front of it.
        anchors: (2,) middle of each contour of each polygon, from the middle of the head, y up.
        cuts: of each contour, vertex (N,) and next vertex (N,) of each cut, and its share (N, 1) of the way to that.
    """

    height: float
    center: Floats
    radii: Floats
    roles: tuple[Role, ...]
    ears: tuple[bool, ...]
    inner: tuple[bool, ...]
    anchors: tuple[tuple[Floats, ...], ...]
    cuts: tuple[tuple[tuple[Indices, Indices, Floats], ...], ...]

    @classmethod
    def of(cls, character: Character, polygons: Sequence[Polygon], rest: Sequence[Contours]) -> Form:
        """The form of a head by the contours (N, 2) of its polygons at rest, y down.

        Args:
            character: whose.
            polygons: its polygons in drawing order.
            rest: their contours.
        """
        center = np.array(character.head.center)
        still = _still(polygons, rest, character.size[1])
        heads = [number for number, polygon in enumerate(polygons) if not still[number] and not polygon.clip]
        ends = directions() * measure_reach(_relative(rest, heads, center), BROAD)[:, None]
        center = center + 0.5 * (ends.min(axis=0) + ends.max(axis=0)) * [1.0, -1.0]
        radii = measure_reach(_relative(rest, heads, center), BROAD)
        placed = [tuple(_up(contour, center) for contour in contours) for contours in rest]
        roles = _roles(polygons, still, placed, radii)
        radii = measure_reach(_relative(rest, [each for each in heads if roles[each] != "out"], center), NOTCHES)
        roles = _roles(polygons, still, placed, radii)
        return cls(
            character.size[1],
            center,
            radii,
            roles,
            tuple(
                feature_of(polygon, character) in EARS and _beside(np.concatenate(contours).mean(axis=0))
                for polygon, contours in zip(polygons, placed, strict=True)
            ),
            _inner(roles, placed),
            tuple(tuple(contour.mean(axis=0) for contour in contours) for contours in placed),
            tuple(tuple(_cuts(contour) for contour in contours) for contours in rest),
        )

    def cut(self, contours: Sequence[Contours]) -> list[Contours]:
        """The contours of all polygons with vertices all along their edges, from the head's middle, y up."""
        return [
            tuple(
                _up(contour[start] * (1.0 - share) + contour[end] * share, self.center)
                for contour, (start, end, share) in zip(each, cuts, strict=True)
            )
            for each, cuts in zip(contours, self.cuts, strict=True)
        ]

    def at_rim(self, contours: Sequence[Floats]) -> list[NDArray[np.bool_]]:
        """(N,) of each contour (N, 2), from the head's middle, y up, which vertices lie on the rim or beyond."""
        return [_shares(contour, self.radii) >= 1.0 for contour in contours]

    def on_canvas(self, contours: Sequence[Floats]) -> Contours:
        """Contours from the head's middle as they lie on the canvas, y up."""
        middle = np.array([self.center[0], self.height - self.center[1]])
        return tuple(contour + middle for contour in contours)


def area(contour: Floats) -> float:
    """The area within a closed contour (N, 2), negative where it runs clockwise."""
    x, y = contour.T
    return 0.5 * float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())


def _up(points: Floats, center: Floats) -> Floats:
    return np.asarray((points - center) * [1.0, -1.0])


def _beside(middle: Floats) -> bool:
    return bool(middle[1] < 0.5 * abs(middle[0]))


def _still(polygons: Sequence[Polygon], rest: Sequence[Contours], height: float) -> list[bool]:
    """Which polygons are below the head: those that say so, else what reaches the lower edge and what lies on that."""
    if any(polygon.body for polygon in polygons):
        return [polygon.body for polygon in polygons]
    points = [np.concatenate(contours) for contours in rest]
    low = [each for each in points if each[:, 1].max() >= height - EDGE]
    tops = [(each.min(axis=0), each.max(axis=0)) for each in low]
    return [any((each.mean(axis=0) >= a).all() and (each.mean(axis=0) <= b).all() for a, b in tops) for each in points]


def _inner(roles: Sequence[Role], placed: Sequence[Contours]) -> tuple[bool, ...]:
    boxes: list[tuple[Floats, Floats]] = []
    found = []
    for role, contours in zip(roles, placed, strict=True):
        points = np.concatenate(contours)
        low, high = points.min(axis=0), points.max(axis=0)
        found.append(role == "out" and any((low >= a).all() and (high <= b).all() for a, b in boxes))
        if role == "out":
            boxes.append((low, high))
    return tuple(found)


def _relative(rest: Sequence[Contours], chosen: Sequence[int], center: Floats) -> list[list[Floats]]:
    return [[_up(contour, center) for contour in rest[number]] for number in chosen]


def _roles(
    polygons: Sequence[Polygon], still: Sequence[bool], placed: Sequence[Contours], radii: Floats
) -> tuple[Role, ...]:
    """What each polygon is, by its contours from the middle of the head, y up."""
    whole = area(directions() * radii[:, None])
    roles: dict[str, Role] = {}
    for polygon, stays, contours in zip(polygons, still, placed, strict=True):
        roles[polygon.id] = "still" if stays else _role(polygon, contours, radii, whole)
    # What is cut by another polygon lies where that does.
    for polygon in polygons:
        for cutter in polygon.clip:
            if roles[cutter] in ("front", "out") or roles[polygon.id] == "out":
                roles[polygon.id] = roles[cutter]
    return tuple(roles[polygon.id] for polygon in polygons)


def _role(polygon: Polygon, contours: Contours, radii: Floats, whole: float) -> Role:
    shares = _shares(np.concatenate(contours), radii)
    size = abs(sum(area(contour) for contour in contours))
    small = size < (SMALL if polygon.layer == "back" else TINY) * whole
    if small and shares.max() > OUT and (shares > 1.0).mean() > OUTER:
        return "out"
    painted = polygon.feature not in ("", *EARS) or (polygon.kind == "point" and small)
    return "front" if painted or (shares >= 1.0).mean() < AROUND else "around"


def _shares(points: Floats, radii: Floats) -> Floats:
    return np.asarray(np.sqrt((points * points).sum(axis=1)) / reach(radii, points))


def _cuts(contour: Floats) -> tuple[Indices, Indices, Floats]:
    along = np.roll(contour, -1, axis=0) - contour
    pieces = np.maximum(np.ceil(np.sqrt((along * along).sum(axis=1)) / LONGEST), 1.0).astype(np.int64)
    start = np.repeat(np.arange(len(contour)), pieces)
    number = np.arange(pieces.sum()) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    return start, (start + 1) % len(contour), (number / pieces[start])[:, None]
