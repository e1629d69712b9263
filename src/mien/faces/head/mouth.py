"""Parke's mouth: interpolation, scaling and translation of the lips; and the contact that speech needs.

Source: Parke 1974, section 3.3 and figure 3.13. The regions are ours, on our topology: rings of ten stations run
around the mouth from the middle of the upper lip (0) over the corner (5) to the middle of the lower lip (9); from
the inside out they are mi, m0 (where the lips meet), mh, m1 (border of the red), mb, m2.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mien.core import Pose
from mien.core.mesh import Ints, Points

from .falloff import bell, ellipse, own_side
from .measured import Archive, Floats, Measured
from .units import PARKE_UNIT_M as UNIT

CENTRE = (0.0, -0.067)
CORNER_X = 0.023
ARCH_CURVE = 21.0
"""How the lips bend around the teeth: they lie back by 21 x^2 metres at x metres from the middle."""

SMILE = (("mouthSmile", 1.0), ("cheekSquint", 0.45), ("mouthDimple", 0.12))
"""Measured expressions that make Parke's second set of mouth points, the smile at ``mouth.expression`` 0."""

CORNER_RINGS = {"mh": 0.7, "m1": 1.0, "mb": 0.8}
CORNER_STATIONS = {3: 0.5, 4: 1.0, 6: -1.0, 7: -0.5}
"""Shares of ``mouth.corner.width``: the red above the corner goes up, the red below it down."""

UPPER_RINGS = {"mj": 0.2, "mi": 1.0, "m0": 1.0, "mh": 1.0, "m1": 0.95, "mb": 0.8, "m2": 0.3}
UPPER_STATIONS = {station: 1.0 - (station / 5.0) * (station / 5.0) for station in range(5)}
"""Shares of ``mouth.upper_lip``: full effect in the middle, none at the corner, station 5."""

TUCK_RINGS = {"mi": 1.0, "m0": 1.0, "mh": 0.95, "m1": 0.55, "mb": 0.4, "m2": 0.15}
TUCK_STATIONS = {6: 0.35, 7: 0.8, 8: 1.0, 9: 1.0}
TUCK_SHIFT_M = (0.0, -0.0016, -0.0072)
"""Shares of ``mouth.tuck``, and where the lower lip is when it is fully under the teeth, from rest."""

CONTACT_RINGS = {"m0": 1.0, "mj": 0.3, "mi": 1.0, "mh": 0.92, "m1": 0.7, "mb": 0.5, "m2": 0.2}
"""Shares of closing; the first ring is where the lips meet, whose gap is closed."""

CONTACT_STATIONS = ((0, 9, 0.0001), (1, 8, 0.0001), (2, 7, 0.0002), (3, 6, 0.0008), (4, 6, 0.0014))
"""Stations that meet, above and below, and how far (m) they pass one another over an open jaw: near the corner the
measured bridge alone leaves a slit."""

OVERLAP_FROM = 0.25
"""Share of the measured open mouth from which on they pass one another fully."""

UPPER_PART = 0.35
"""Share of a gap between the lips that the upper lip closes; the lower lip does the rest."""


@dataclass(frozen=True, eq=False)
class Contact:
    """Vertices of all rings at two stations that meet when the lips close.

    Attributes:
        upper, lower: (R,) vertex numbers, the ring where the lips meet first.
        share: (R,) share of the gap's closing.
        upper_part: share of the gap that the upper lip closes; the lower one does the rest.
        rest_gap: (3,) m from the upper to the lower lip at rest.
        overlap_m: how far they pass one another over an open jaw.
    """

    upper: Ints
    lower: Ints
    share: Floats
    upper_part: float
    rest_gap: Floats
    overlap_m: float


@dataclass(frozen=True, eq=False)
class MouthRegions:
    """Weights (V,) of the mouth's deformers on one position set.

    Attributes:
        around: of the width: the mouth and what is around it.
        lips: of the offset from the teeth.
        corner: of the left and the right corner's moves.
        corner_lips: of the left and the right corner's width: up is positive.
        upper: of the upper lip's raise.
        tuck: of the lower lip under the teeth.
        contacts: what meets when the lips close.
    """

    around: Floats
    lips: Floats
    corner: tuple[Floats, Floats]
    corner_lips: tuple[Floats, Floats]
    upper: Floats
    tuck: Floats
    contacts: tuple[Contact, ...]


def mouth_regions(archive: Archive, measured: Measured) -> MouthRegions:
    """The weights, from the neutral points."""
    points = measured.points
    taper = np.maximum(1.0 - 0.6 * (points[:, 0] / CORNER_X) ** 2, 0.35)
    left, right = (
        bell(points, (side * CORNER_X, CENTRE[1]), (0.012, 0.011)) * own_side(points, side, 0.012) for side in (1, -1)
    )
    left_red, right_red = (_by_ring(archive, CORNER_RINGS, CORNER_STATIONS, (side,)) for side in (0, 1))
    return MouthRegions(
        around=ellipse(points, CENTRE, (0.027, 0.012), 2.2),
        lips=ellipse(points, CENTRE, (0.026, 0.0105), 1.8) * taper,
        corner=(left, right),
        corner_lips=(left_red, right_red),
        upper=_by_ring(archive, UPPER_RINGS, UPPER_STATIONS),
        tuck=_by_ring(archive, TUCK_RINGS, TUCK_STATIONS),
        contacts=_contacts(archive, points),
    )


def _vertex(archive: Archive, ring: str, station: int, side: int) -> int:
    """Number of the vertex at a ring's station, on the left (0) or the right (1); the same on the midline."""
    left = archive.vertex[f"{ring}_{station}"]
    return left if side == 0 else int(archive.mirror[left])


def _by_ring(
    archive: Archive, rings: Mapping[str, float], stations: Mapping[int, float], sides: tuple[int, ...] = (0, 1)
) -> Floats:
    """(V,) share of the ring times share of the station; 0 on all other vertices."""
    weight = np.zeros(len(archive.mirror))
    for ring, ring_share in rings.items():
        for station, station_share in stations.items():
            for side in sides:
                weight[_vertex(archive, ring, station, side)] = ring_share * station_share
    return weight


def _contacts(archive: Archive, points: Points) -> tuple[Contact, ...]:
    share = np.array(list(CONTACT_RINGS.values()))
    out = []
    for side in (0, 1):
        for up, low, overlap_m in CONTACT_STATIONS:
            if up == 0 and side == 1:
                continue  # the midline, which belongs to both sides
            upper, lower = (np.array([_vertex(archive, r, s, side) for r in CONTACT_RINGS]) for s in (up, low))
            # The lower corner station serves two stations above; the second meets it where it lies.
            upper_part = UPPER_PART if up != 4 else 1.0
            out.append(Contact(upper, lower, share, upper_part, points[lower[0]] - points[upper[0]], overlap_m))
    return tuple(out)


def move_mouth(points: Points, pose: Pose, regions: MouthRegions, measured: Measured) -> Points:
    """Points (V, 3) m with expression, width, offset, corners and upper lip; before the jaw turns."""
    out = points.copy()
    for side, letter in (("left", "L"), ("right", "R")):
        smile = 1.0 - pose[f"mouth.expression.{side}"]
        if smile:
            for name, share in SMILE:
                out += smile * share * measured.morphs[f"{name}_{letter}"]
    width = pose["mouth.width"] - 1.0
    if width:
        x = out[:, 0]
        wide = x * (1.0 + width * regions.around)
        out[:, 2] -= ARCH_CURVE * (wide * wide - x * x) * regions.around
        out[:, 0] = wide
    out[:, 2] += pose["mouth.offset"] * UNIT * regions.lips
    out[:, 1] += pose["mouth.upper_lip"] * UNIT * regions.upper
    for number, (side, sign) in enumerate((("left", 1.0), ("right", -1.0))):
        corner = regions.corner[number]
        out[:, 0] += sign * pose[f"mouth.corner.side.{side}"] * UNIT * corner
        out[:, 1] += pose[f"mouth.corner.up.{side}"] * UNIT * corner
        out[:, 2] += pose[f"mouth.corner.forward.{side}"] * UNIT * corner
        out[:, 1] += 0.5 * pose[f"mouth.corner.width.{side}"] * UNIT * regions.corner_lips[number]
    return out


def tuck_lip(points: Points, before_jaw: Points, pose: Pose, regions: MouthRegions) -> Points:
    """Points with the lower lip brought under the upper front teeth, wherever the jaw is (f, v).

    Source: Parke 1974, section 3.3; he translates the lip, we first undo the jaw's share of it, so that a full
    tuck meets the teeth at any rotation.
    """
    amount = pose["mouth.tuck"] / -20.0
    if not amount:
        return points
    goal = before_jaw + np.array(TUCK_SHIFT_M)
    return points + (amount * regions.tuck)[:, None] * (goal - points)


def close_lips(points: Points, pose: Pose, jaw_opening: float, regions: MouthRegions, measured: Measured) -> Points:
    """Points with the lips brought together: the measured bridge over an open jaw, then contact of what is left.

    Args:
        points: (V, 3) m, after the jaw.
        pose: has ``mouth.closure``.
        jaw_opening: the jaw's angle as a share of the measured open mouth.
        regions: of this position set.
        measured: for the morph ``mouthClose``, which only makes sense together with the jaw.
    """
    amount = pose["mouth.closure"]
    if not amount:
        return points
    out = points + (amount * jaw_opening) * measured.morphs["mouthClose"]
    moves = np.zeros_like(out)
    pressed = min(jaw_opening / OVERLAP_FROM, 1.0)
    for contact in regions.contacts:
        gap = out[contact.lower[0]] - out[contact.upper[0]] - contact.rest_gap
        gap[1] -= pressed * contact.overlap_m
        moves[contact.upper] += (amount * contact.upper_part) * contact.share[:, None] * gap
        moves[contact.lower] -= (amount * (1.0 - contact.upper_part)) * contact.share[:, None] * gap
    return out + moves
