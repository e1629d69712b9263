"""Contact: lips, cheeks and chin stay before the teeth, and lids before the eyeballs, whatever a pose and a shape ask.

A row of teeth with its gums is an outline around an upright axis inside the mouth: how far it reaches in each
direction, and between which heights. Skin that comes nearer than a share of what it keeps at rest is pushed out.
"""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mien.compiling import kernel
from mien.core.mesh import Ints, Points

from .angles import soft_step
from .conformation import LIDS
from .measured import Bools, Floats, Lids
from .vectors import length

WAYS = 25
"""Directions of an outline, from the right over the front to the left."""

AXIS_BACK_M = 0.050
"""How far the axis stands behind the foremost tooth of a row."""

AT_LEAST, AT_MOST_M = 0.35, 0.003
"""Skin keeps this share of how far it stands before the teeth at rest, up to so much."""

FADE_M = 0.005
"""Above and below a row of teeth contact fades over this height."""

YIELD, LEAST = 0.8, 0.3
"""How far teeth and tongue give way for what the skin is pressed out, and what is left of their reach at least: a
cage that is pushed takes its subdivided skin only a part of the way."""

LID_GAP = 0.99
"""Share of the least of its distances from the ball, shut, at rest and wide open, that a lid keeps."""

SAG = 0.2
"""How much farther off, in radii, a cage must stay whose lids are stretched by 1 both ways: its refined skin sags."""

OVER_CHIN_M = 0.009
"""How high the lower gums stay above the end of the chin at least; at rest it is 31 mm."""

NEAREST_M = 0.0025
"""What stands nearer to the teeth at rest, such as the inner corner of the mouth, is left where it is."""

UNFELT_M = 0.003
"""Teeth do not give way for less: in ordinary poses jaw and skull stay rigid."""

LOWEST_M, HIGHEST_M, BEHIND_M = -0.118, -0.044, 0.052
"""What of the resting skin may meet the teeth: between these heights, before this depth."""


@dataclass(frozen=True, eq=False)
class Before:
    """The skin that stands before the teeth.

    Attributes:
        rows: (B,) vertices.
        clearance: (B, 2) m that each keeps of the upper and of the lower row; 0 where it never meets that.
        edge: (B,) whether it is where the lips meet: a lip that rolls in takes that between the rows.
    """

    rows: Ints
    clearance: Floats
    edge: Bools


def before_teeth(
    skin: Points, lips: tuple[Bools, Bools], seen: Bools, edge: Ints, inside: Points, lower: Bools
) -> Before:
    """The skin that stands before the teeth.

    Args:
        skin: (S, 3) m, at rest.
        lips: (S,) whether it is of the upper, and of the lower lip: they meet their own teeth only.
        seen: (S,) whether it is outside the mouth.
        edge: vertices where the lips meet.
        inside: (K, 3) m, teeth and gums.
        lower: (K,) which of them the jaw carries.
    """
    gaps = np.empty((len(skin), 2))
    measure_gaps(skin, inside, lower, np.empty((2, WAYS, 3)), gaps)
    near = seen & (skin[:, 1] > LOWEST_M) & (skin[:, 1] < HIGHEST_M) & (skin[:, 2] > BEHIND_M)
    meets = ~np.stack(lips[::-1], axis=1) & near[:, None] & (gaps > NEAREST_M)
    rows = np.flatnonzero(meets.any(axis=1))
    return Before(rows, np.where(meets, np.minimum(AT_LEAST * gaps, AT_MOST_M), 0.0)[rows], np.isin(rows, edge))


@kernel("f8[:,:], f8[:,:], b1[:], f8[:,:,:], f8[:,:]")
def measure_gaps(skin, inside, lower, outlines, gaps):
    """Fill ``gaps`` (S, 2) with how far skin (S, 3) m stands before either row of teeth, m: of ``trace_rows``."""
    axes = trace_rows(inside, lower, outlines)
    for v in range(len(skin)):
        for jaw in range(2):
            x, z = skin[v, 0], skin[v, 2] - axes[jaw]
            reach, _, _ = outline_at(x, z, outlines[jaw])
            gaps[v, jaw] = np.sqrt(x * x + z * z) - reach


@kernel()
def place_of(x, z):
    """Where a direction lies among the ``WAYS`` of an outline: 0 to the right, the last to the left."""
    ahead = max(z, 0.0)
    return 0.5 * (WAYS - 1) * (1.0 + x / (abs(x) + ahead + 1e-12))


@kernel()
def trace_rows(points, lower, outlines):
    """The depths, m, of the axes behind the upper and the lower row of teeth, whose ``outlines`` are filled.

    Args:
        points: (K.., 3) m, of teeth and gums.
        lower: (K,) whether a point belongs to the lower row.
        outlines: (2, WAYS.., 3), filled with reach, lowest and highest height in each direction, m;
            reach 0 where there is nothing.
    """
    foremost = (-1.0, -1.0)
    for jaw in range(2):
        for way in range(WAYS):
            outlines[jaw, way, 0], outlines[jaw, way, 1], outlines[jaw, way, 2] = 0.0, 1.0, -1.0
    for n in range(len(lower)):
        upper_z, lower_z = foremost
        foremost = (upper_z, max(lower_z, points[n, 2])) if lower[n] else (max(upper_z, points[n, 2]), lower_z)
    axes = foremost[0] - AXIS_BACK_M, foremost[1] - AXIS_BACK_M
    for n in range(len(lower)):
        jaw = 1 if lower[n] else 0
        x, z = points[n, 0], points[n, 2] - axes[jaw]
        place, away = place_of(x, z), np.sqrt(x * x + z * z)
        for way in range(int(place), int(np.ceil(place)) + 1):
            outline = outlines[jaw, way]
            outline[0] = max(outline[0], away)
            outline[1], outline[2] = min(outline[1], points[n, 1]), max(outline[2], points[n, 1])
    return axes


@kernel()
def outline_at(x, z, outline):
    """Reach, lowest and highest height, m, of an outline (WAYS, 3) in a direction."""
    place = place_of(x, z)
    first = min(int(place), WAYS - 2)
    t = place - first
    near, next_one = outline[first], outline[first + 1]
    if near[0] == 0.0 or next_one[0] == 0.0:
        return 0.0, 1.0, -1.0
    reach = near[0] + t * (next_one[0] - near[0])
    low, high = near[1] + t * (next_one[1] - near[1]), near[2] + t * (next_one[2] - near[2])
    return reach, low, high


@kernel()
def lift_row(points, lower, chin_y):
    """Lift what the jaw carries inside the mouth (K, 3) m off the end of the chin, which is at a height, m."""
    lowest = 1.0
    for n in range(len(points)):
        if lower[n]:
            lowest = min(lowest, points[n, 1])
    missing = chin_y + OVER_CHIN_M - lowest
    if missing > 0.0:
        for n in range(len(points)):
            if lower[n]:
                points[n, 1] += missing


@kernel()
def push_before(skin, before, rolled, axes, outlines, pressed):
    """Push skin (S, 3) m out, level, to where it clears both rows of teeth.

    Args:
        skin: changed.
        before: rows, clearance and edge of ``Before``.
        rolled: how far the upper and the lower lip are rolled in, 0..1.
        axes: and outlines: of ``trace_rows``.
        pressed: (2, WAYS.., 3), filled in its first column with how much was missing in each direction, m.
    """
    rows, clearance, edge = before
    for jaw in range(2):
        for way in range(WAYS):
            pressed[jaw, way, 0] = 0.0
    for n in range(len(rows)):
        v = rows[n]
        for jaw in range(2):
            x, y, z = skin[v, 0], skin[v, 1], skin[v, 2] - axes[jaw]
            reach, low, high = outline_at(x, z, outlines[jaw])
            away = np.sqrt(x * x + z * z)
            missing = reach + clearance[n, jaw] - away
            if clearance[n, jaw] > 0.0 and z > 0.0 and missing > 0.0:
                if edge[n]:
                    missing *= 1.0 - rolled[jaw]
                missing *= soft_step((y - low + FADE_M) / FADE_M) * soft_step((high + FADE_M - y) / FADE_M)
                size = 1.0 + missing / max(away, 1e-6)
                skin[v, 0], skin[v, 2] = x * size, axes[jaw] + z * size
                place = place_of(x, z)
                for way in range(int(place), int(np.ceil(place)) + 1):
                    pressed[jaw, way, 0] = max(pressed[jaw, way, 0], missing)


@kernel()
def give_way(points, lower, axes, pressed):
    """Draw what is inside the mouth (K, 3) m in by a share of what the skin before it is ``pressed``."""
    for n in range(len(points)):
        jaw = 1 if lower[n] else 0
        x, z = points[n, 0], points[n, 2] - axes[jaw]
        place = place_of(x, z)
        first = min(int(place), WAYS - 2)
        here, there = pressed[jaw, first, 0], pressed[jaw, first + 1, 0]
        missing = here + (place - first) * (there - here) - UNFELT_M
        if missing > 0.0:
            away = np.sqrt(x * x + z * z)
            size = max(1.0 - YIELD * missing / max(away, 1e-6), LEAST)
            points[n, 0], points[n, 2] = x * size, axes[jaw] + z * size


def ball_gaps(lids: Lids, open_lids: Sequence[Points], balls: Floats) -> Floats:
    """(L,) m that each vertex of the lids keeps off its eyeball.

    Args:
        lids: at rest and shut.
        open_lids: (S, 3) m, skins on which they are open, at rest and wide.
        balls: (2, 4) m, centre and radius of the left and of the right eye.
    """
    ball = balls[np.where(lids.side > 0, 0, 1)]
    away = [lids.radius_shut, *(length(skin[lids.index] - ball[:, :3]) for skin in open_lids)]
    return LID_GAP * np.maximum(np.min(away, axis=0) - ball[:, 3], 0.0)


@kernel()
def stretch_of(amounts, kinds, axes):
    """How far the lids of either eye are wider times higher than at rest, from steps (K,) of the shape."""
    wider, higher = 0.0, 0.0
    for k in range(len(amounts)):
        if kinds[k] == LIDS:
            wider, higher = max(wider, amounts[k] * axes[k, 0]), max(higher, amounts[k] * axes[k, 1])
    return wider * higher


@kernel()
def keep_off_balls(skin, numbers, gaps, stretch, balls, held):
    """Push lids of the skin (S, 3) m out to where they clear the eyeballs.

    Args:
        skin: changed.
        numbers: of ``LidTable``.
        gaps: of ``ball_gaps``.
        stretch: of ``stretch_of``.
        balls: (2.., 4) m, centre and radius at rest.
        held: (2.., 4) m, now.
    """
    for n in range(len(numbers)):
        v, side = numbers[n, 0], 1 - numbers[n, 1]
        if gaps[n] > 0.0:
            x, y, z = skin[v, 0] - held[side, 0], skin[v, 1] - held[side, 1], skin[v, 2] - held[side, 2]
            wanted = held[side, 3] * (1.0 + gaps[n] / balls[side, 3] + SAG * stretch)
            away = np.sqrt(x * x + y * y + z * z)
            if 0.0 < away < wanted:
                size = wanted / away
                skin[v, 0] = held[side, 0] + x * size
                skin[v, 1] = held[side, 1] + y * size
                skin[v, 2] = held[side, 2] + z * size
