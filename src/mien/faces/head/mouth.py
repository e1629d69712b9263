"""Parke's mouth: interpolation, scaling and translation of the lips.

Source: Parke 1974, section 3.3 and figure 3.13. The regions are ours, on our topology: rings of ten stations run
around the mouth from the middle of the upper lip (0) over the corner (5) to the middle of the lower lip (9); from
the inside out they are mi, m0 (where the lips meet), mh, m1 (border of the red), mb, m2.
"""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mien.compiling import kernel
from mien.core.mesh import Ints

from .falloff import bell, ellipse, own_side
from .lips import TEETH_RINGS, Contacts, contacts_of
from .measured import Archive, Bools, Floats, Measured
from .moves import Move
from .regions import weigh_region
from .units import PARKE_UNIT_M as UNIT

CENTRE = (0.0, -0.067)
CORNER, CORNER_X = 5, 0.023
ARCH_CURVE = 21.0
"""How the lips bend around the teeth: they lie back by 21 x^2 metres at x metres from the middle, up to the corner;
from there on the cheek goes straight on."""

SMILE = (("mouthSmile", 1.0), ("cheekSquint", 0.32), ("mouthDimple", 0.08))
"""Measured expressions that make Parke's second set of mouth points, the smile at ``mouth.expression`` 0."""

AROUND_M, AROUND_REACH = (0.027, 0.022), 2.6
NOSE_STAYS = 0.6
"""What the mouth's width takes along: fully within an ellipse, less and less up to 2.6 times its radii; and how much
less of the nose, which is within reach."""

GIVE_M = 0.005
"""A smile that draws a corner so far outwards leaves half of what else would draw it; both would tear the cheek."""

CORNER_RINGS = {"mh": 0.7, "m1": 1.0, "mb": 0.8}
CORNER_STATIONS = {3: 0.5, 4: 1.0, 6: -1.0, 7: -0.5}
"""Shares of ``mouth.corner.width``: the red above the corner goes up, the red below it down."""

UPPER_RINGS = {"mj": 0.2, "mi": 1.0, "m0": 1.0, "mh": 1.0, "m1": 0.95, "mb": 0.8, "m2": 0.3}
UPPER_STATIONS = {station: 1.0 - (station / 5.0) * (station / 5.0) for station in range(5)}
"""Shares of ``mouth.upper_lip``: full effect in the middle, none at the corner, station 5."""

WALL_RINGS = {"mj": 0.5, "mk": 0.0}
"""Shares of the width that the walls of the mouth take: cheeks that a shape narrows must hold them."""

RED_RINGS = ("mi", "m0", "mh", "m1", "mb")
"""What of a lip may pass the other jaw's teeth, as the lower lip does in an f."""

TUCK_RINGS = {"mi": 1.0, "m0": 1.0, "mh": 0.95, "m1": 0.55, "mb": 0.4, "m2": 0.15}
TUCK_STATIONS = {6: 0.35, 7: 0.8, 8: 1.0, 9: 1.0}
TUCK_SHIFT_M = (0.0, -0.0016, -0.0072)
"""Shares of ``mouth.tuck``, and where the lower lip is when it is fully under the teeth, from rest."""


@dataclass(frozen=True, eq=False)
class MouthRegions:
    """Weights (V,) of the mouth's deformers on one position set.

    Attributes:
        around: of the width: the mouth and what is around it.
        lips: of the offset from the teeth.
        ends: vertices at the left and the right corner.
        corner: of the left and the right corner's moves.
        corner_lips: of the left and the right corner's width: up is positive.
        upper: of the upper lip's raise.
        tuck: of the lower lip under the teeth.
        contacts: what meets when the lips close.
        reds: (V,) whether a vertex is of the upper, and of the lower lip, which may pass the other's row of teeth.
        over_teeth: (K,) vertices of the upper lip that stay in front of the teeth.
    """

    around: Floats
    lips: Floats
    ends: Ints
    corner: tuple[Floats, Floats]
    corner_lips: tuple[Floats, Floats]
    upper: Floats
    tuck: Floats
    contacts: Contacts
    reds: tuple[Bools, Bools]
    over_teeth: Ints

    @cached_property
    def rows(self) -> Ints:
        """(R,) vertices that any of them moves."""
        return np.flatnonzero(np.stack([*self._moving, self.tuck]).any(axis=0))

    @cached_property
    def moving(self) -> Floats:
        """(R, 7) the weights of ``move_lips`` at these vertices."""
        return np.stack(self._moving, axis=1)[self.rows]

    @property
    def _moving(self) -> tuple[Floats, ...]:
        return self.around, self.lips, self.upper, *self.corner, *self.corner_lips


def mouth_regions(archive: Archive, measured: Measured) -> MouthRegions:
    """The weights, from the neutral points."""
    points = measured.points
    taper = np.maximum(1.0 - 0.6 * (points[:, 0] / CORNER_X) ** 2, 0.35)
    nose = weigh_region("end of the nose", points)
    left, right = (
        bell(points, (side * CORNER_X, CENTRE[1]), (0.0135, 0.0125)) * own_side(points, side, 0.012) for side in (1, -1)
    )
    left_red, right_red = (_by_ring(archive, CORNER_RINGS, CORNER_STATIONS, (side,)) for side in (0, 1))
    return MouthRegions(
        around=ellipse(points, CENTRE, AROUND_M, AROUND_REACH) * (1.0 - NOSE_STAYS * nose) * _reaching_in(archive),
        lips=ellipse(points, CENTRE, (0.026, 0.0105), 1.8) * taper,
        ends=np.array([archive.vertex_at("m0", CORNER, side) for side in (0, 1)]),
        corner=(left, right),
        corner_lips=(left_red, right_red),
        upper=_by_ring(archive, UPPER_RINGS, UPPER_STATIONS),
        tuck=_by_ring(archive, TUCK_RINGS, TUCK_STATIONS),
        contacts=contacts_of(archive, points),
        reds=(_red(archive, range(5)), _red(archive, range(6, 10))),
        over_teeth=np.flatnonzero(_by_ring(archive, dict.fromkeys(TEETH_RINGS, 1.0), dict.fromkeys(range(6), 1.0))),
    )


def _reaching_in(archive: Archive) -> Floats:
    """(V,) shares of the width: less inside the mouth."""
    share = np.ones(len(archive.mirror))
    for name, number in archive.vertex.items():
        if (ring := name.split("_")[0]) in WALL_RINGS:
            share[[number, archive.mirror[number]]] = WALL_RINGS[ring]
    return share


def _red(archive: Archive, stations: range) -> Bools:
    """(V,) whether a vertex is of a lip's red, or beside it, at some stations."""
    return _by_ring(archive, dict.fromkeys(RED_RINGS, 1.0), dict.fromkeys(stations, 1.0)) > 0.0


def _by_ring(
    archive: Archive, rings: Mapping[str, float], stations: Mapping[int, float], sides: tuple[int, ...] = (0, 1)
) -> Floats:
    """(V,) share of the ring times share of the station; 0 on all other vertices."""
    weight = np.zeros(len(archive.mirror))
    for ring, ring_share in rings.items():
        for station, station_share in stations.items():
            for side in sides:
                weight[archive.vertex_at(ring, station, side)] = ring_share * station_share
    return weight


def smile_moves(measured: Measured) -> list[Move]:
    """Parke's interpolation of the mouth between two expressions, each half by itself."""
    return [
        Move(f"mouth.expression.{side}", measured.morphs[f"{name}_{letter}"], share, rest=1.0, span=-1.0)
        for side, letter in (("left", "L"), ("right", "R"))
        for name, share in SMILE
    ]


@kernel()
def arch_back(x):
    """How far back, m, lips and cheeks lie x metres from the middle."""
    near = min(abs(x), CORNER_X)
    return ARCH_CURVE * near * (2.0 * abs(x) - near)


@kernel()
def give_of(x):
    """How much a corner of the mouth, x metres from the middle, still gives to what else draws it outwards."""
    return 1.0 / (1.0 + max(x - CORNER_X, 0.0) / GIVE_M)


@kernel()
def move_lips(points, rows, regions, ends, width, offset, upper_lip, corners):
    """Scale and translate the lips of the skin (V, 3) m, before the jaw turns.

    Args:
        points: changed.
        rows: (R,) vertices of the mouth.
        regions: (R, 7) their weights: width, offset, upper lip, left and right corner, red of either.
        ends: vertices at the left and the right corner.
        width: factor, 1 at rest.
        offset: forward, off the teeth, in Parke's units like all that follow.
        upper_lip: up.
        corners: (8,) left and right: outwards, up, forward, thickness.
    """
    given = give_of(points[ends[0], 0]), give_of(-points[ends[1], 0])
    for n in range(len(rows)):
        v = rows[n]
        x, y, z = points[v, 0], points[v, 1], points[v, 2]
        around = regions[n, 0]
        give = given[0 if x > 0.0 else 1]
        wide = x * (1.0 + ((width - 1.0) * give if width > 1.0 else width - 1.0) * around)
        z -= (arch_back(wide) - arch_back(x)) * around
        z += offset * UNIT * regions[n, 1]
        y += upper_lip * UNIT * regions[n, 2]
        x = wide
        for side in range(2):
            sign, corner = 1.0 - 2.0 * side, regions[n, 3 + side]
            outwards = corners[side] * given[side] if corners[side] > 0.0 else corners[side]
            x += sign * outwards * UNIT * corner
            y += corners[2 + side] * UNIT * corner
            z += corners[4 + side] * UNIT * corner
            y += 0.5 * corners[6 + side] * UNIT * regions[n, 5 + side]
        points[v, 0], points[v, 1], points[v, 2] = x, y, z


@kernel()
def copy_rows(points, rows, out):
    """Copy some rows of points (V, 3) to ``out`` (V, 3)."""
    for n in range(len(rows)):
        for axis in range(3):
            out[rows[n], axis] = points[rows[n], axis]


@kernel()
def tuck_lip(points, before_jaw, rows, share, tuck):
    """Bring the lower lip of the skin (V, 3) m under the upper front teeth, wherever the jaw is (f, v).

    Args:
        points: changed.
        before_jaw: (V, 3) m.
        rows: (R,) vertices of the mouth.
        share: (R,) of the way that each goes.
        tuck: -20 is a full one.

    Source: Parke 1974, section 3.3; he translates the lip, we first undo the jaw's share of it, so that a full
    tuck meets the teeth at any rotation.
    """
    amount = tuck / -20.0
    for n in range(len(rows)):
        v, part = rows[n], amount * share[n]
        if part != 0.0:
            for axis in range(3):
                goal = before_jaw[v, axis] + TUCK_SHIFT_M[axis]
                points[v, axis] += part * (goal - points[v, axis])
