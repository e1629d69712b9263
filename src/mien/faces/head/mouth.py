"""Parke's mouth: interpolation, scaling and translation of the lips; and the contact that speech needs.

Source: Parke 1974, section 3.3 and figure 3.13. The regions are ours, on our topology: rings of ten stations run
around the mouth from the middle of the upper lip (0) over the corner (5) to the middle of the lower lip (9); from
the inside out they are mi, m0 (where the lips meet), mh, m1 (border of the red), mb, m2.
"""

from __future__ import annotations

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

UPPER_RINGS = {"mj": 0.2, "mi": 1.0, "m0": 1.0, "mh": 1.0, "m1": 0.95, "mb": 0.8, "m2": 0.3}
TUCK_RINGS = {"mi": 1.0, "m0": 1.0, "mh": 0.95, "m1": 0.55, "mb": 0.4, "m2": 0.15}
TUCK_STATIONS = {6: 0.35, 7: 0.8, 8: 1.0, 9: 1.0}
TUCK_SHIFT_M = (0.0, -0.0016, -0.0072)
CONTACT_RINGS = {"mj": 0.3, "mi": 1.0, "m0": 1.0, "mh": 0.92, "m1": 0.7, "mb": 0.5, "m2": 0.2}
CONTACT_PAIRS = ((0, 9), (1, 8), (2, 7), (3, 6), (4, 6))
OVERLAP_M = (0.0001, 0.0001, 0.0002, 0.0008, 0.0014)
"""How much the pairs pass one another over an open jaw: near the corner the bridge alone leaves a slit."""

OVERLAP_FROM = 0.25
"""Share of the measured open mouth from which on they pass one another fully."""

UPPER_PART = 0.35
"""Share of a gap between the lips that the upper lip closes; the lower lip does the rest."""


@dataclass(frozen=True, eq=False)
class MouthRegions:
    """Weights (V,) of the mouth's deformers on one position set."""

    around: Floats
    lips: Floats
    corner: tuple[Floats, Floats]
    corner_lips: tuple[Floats, Floats]
    upper: Floats
    tuck: Floats
    contact: tuple[tuple[Ints, Ints, Floats, Floats], ...]
    rest_gap: Points


def mouth_regions(archive: Archive, measured: Measured) -> MouthRegions:
    """The weights, from the neutral points."""
    points = measured.points
    around = ellipse(points, CENTRE, (0.027, 0.012), 2.2)
    taper = np.maximum(0.0, 1.0 - 0.6 * (points[:, 0] / CORNER_X) ** 2)
    lips = ellipse(points, CENTRE, (0.026, 0.0105), 1.8) * np.maximum(taper, 0.35)
    corner: list[Floats] = []
    corner_lips: list[Floats] = []
    for side in (1, -1):
        fade = bell(points, (side * CORNER_X, CENTRE[1]), (0.012, 0.011)) * own_side(points, side, 0.012)
        corner.append(fade)
        red = np.zeros(len(points))
        for ring, share in (("mh", 0.7), ("m1", 1.0), ("mb", 0.8)):
            for station, sign in ((3, 0.5), (4, 1.0), (6, -1.0), (7, -0.5)):
                red[_both(archive, ring, station)[0 if side == 1 else 1]] = sign * share
        corner_lips.append(red)
    upper = np.zeros(len(points))
    for ring, share in UPPER_RINGS.items():
        for station in range(5):
            for vertex in _both(archive, ring, station):
                # The corner itself stays: full effect in the middle, none at station 5.
                upper[vertex] = share * max(0.0, 1.0 - (station / 5.0) ** 2)
    tuck = np.zeros(len(points))
    for ring, share in TUCK_RINGS.items():
        for station, part in TUCK_STATIONS.items():
            for vertex in _both(archive, ring, station):
                tuck[vertex] = share * part
    contact = _contact(archive)
    gap = np.stack([points[lower[0]] - points[upper[0]] for upper, lower, _, _ in contact])
    return MouthRegions(around, lips, tuple(corner), tuple(corner_lips), upper, tuck, contact, gap)  # type: ignore[arg-type]


def _both(archive: Archive, ring: str, station: int) -> tuple[int, int]:
    """Vertices of a ring's station on the left and the right; the same one on the midline."""
    left = archive.vertex[f"{ring}_{station}"]
    return left, int(archive.mirror[left])


def _contact(archive: Archive) -> tuple[tuple[Ints, Ints, Floats, Floats], ...]:
    """Columns of vertices that close with each pair of lip points: (upper, lower, shares), innermost m0 first."""
    order = sorted(CONTACT_RINGS, key=lambda ring: ring != "m0")
    columns = []
    for side in (0, 1):
        for up, low in CONTACT_PAIRS:
            upper = np.array([_both(archive, ring, up)[side] for ring in order], dtype=np.int64)
            lower = np.array([_both(archive, ring, low)[side] for ring in order], dtype=np.int64)
            shares = np.array([CONTACT_RINGS[ring] for ring in order])
            # The lower corner station serves two pairs; the second moves only the upper lip.
            columns.append((upper, lower, shares, shares * (up != 4)))
    return tuple(columns)


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
    for number, (upper, lower, up_share, low_share) in enumerate(regions.contact):
        gap = out[lower[0]] - out[upper[0]] - regions.rest_gap[number]
        gap[1] -= pressed * OVERLAP_M[number % len(CONTACT_PAIRS)]
        lower_part = 1.0 - UPPER_PART if low_share.any() else 0.0
        moves[upper] += (amount * (1.0 - lower_part)) * up_share[:, None] * gap
        moves[lower] -= (amount * lower_part) * low_share[:, None] * gap
    halves = np.concatenate([regions.contact[0][0], regions.contact[0][1]])
    # Left and right columns share the midline: each was counted twice there.
    moves[halves] *= 0.5
    return out + moves


def lip_gap_m(points: Points, archive: Archive) -> float:
    """Greatest distance between the lips over the stations where they meet, metres; about 0 when shut.

    It is measured on subdivided skin or on the surface set as the height of the lower above the upper edge of
    contact, middle to next-but-corner.
    """
    gaps = [
        points[archive.vertex[f"m0_{up}"], 1] - points[archive.vertex[f"m0_{low}"], 1] for up, low in CONTACT_PAIRS[:4]
    ]
    return float(max(gaps))
