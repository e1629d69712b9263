"""Eyebrows: interpolation between high and low arch, translation of the inner end; and the strips of hair."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.core import Pose
from mien.core.mesh import Ints, Points

from .falloff import bell, own_side
from .measured import Archive, Floats, Measured
from .rest import REST_ARCH
from .units import PARKE_UNIT_M as UNIT
from .vectors import unit

HIGH = (("browOuterUp", 0.95), ("browInnerUp", 0.30))
LOW = (("browOuterUp", -0.40),)
INNER_END = (0.0105, 0.0235)


@dataclass(frozen=True, eq=False)
class BrowRegions:
    """(V,) weights of the inner end of the left and right brow."""

    inner: tuple[Floats, Floats]


def brow_regions(measured: Measured) -> BrowRegions:
    """The weights, from the neutral points."""
    points = measured.points
    left, right = (
        bell(points, (side * INNER_END[0], INNER_END[1]), (0.018, 0.013)) * own_side(points, side, 0.008)
        for side in (1, -1)
    )
    return BrowRegions((left, right))


def move_brows(points: Points, pose: Pose, regions: BrowRegions, measured: Measured) -> Points:
    """Points (V, 3) m with arch and separation of the brows.

    Two sets of points are interpolated, high arch at 0 and low at 1; the measured face lies between, at rest.

    Source: Parke 1974, section 3.2.
    """
    out = points.copy()
    for number, (side, letter, sign) in enumerate((("left", "L", 1.0), ("right", "R", -1.0))):
        arch = pose[f"eyebrow.arch.{side}"]
        rows, amount = (
            (HIGH, (REST_ARCH - arch) / REST_ARCH)
            if arch < REST_ARCH
            else (LOW, (arch - REST_ARCH) / (1.0 - REST_ARCH))
        )
        if amount:
            for name, share in rows:
                out += amount * share * measured.morphs[f"{name}_{letter}"]
        out[:, 0] += sign * pose[f"eyebrow.separation.{side}"] * UNIT * regions.inner[number]
    return out


@dataclass(frozen=True, eq=False)
class BrowStrips:
    """A tapered strip bound to the skin: point = sum of weights times cage points, plus an offset along the normal."""

    index: tuple[Ints, Ints]
    weight: tuple[Floats, Floats]
    offset: Floats
    quads: Ints
    along: Floats
    across: Floats


def brow_strips(archive: Archive, lift_m: float) -> BrowStrips:
    """The strips, lifted off the skin by ``lift_m`` more than measured (flat pictures need it)."""
    return BrowStrips(
        (archive.ints("brow_left_index"), archive.ints("brow_right_index")),
        (archive.floats("brow_left_weight"), archive.floats("brow_right_weight")),
        archive.floats("brow_offset") + lift_m,
        archive.ints("brow_quads"),
        archive.floats("brow_along"),
        archive.floats("brow_across"),
    )


def bind(index: Ints, weight: Floats, values: Points) -> Points:
    """(N, 3) sums of weight times value, in the order of the columns."""
    out = np.zeros((len(index), values.shape[1]))
    for column in range(index.shape[1]):
        out += weight[:, column, None] * values[index[:, column]]
    return out


def place_brows(strips: BrowStrips, points: Points, normals: Points) -> Points:
    """(2 B, 3) m, left strip then right, on posed skin."""
    out = []
    for index, weight in zip(strips.index, strips.weight, strict=True):
        normal = bind(index, weight, normals)
        out.append(bind(index, weight, points) + strips.offset[:, None] * unit(normal))
    return np.concatenate(out)
