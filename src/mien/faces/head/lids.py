"""Eyelids: two-dimensional interpolation between open and shut, projected back on a sphere about the eye."""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.compiling import kernel
from mien.core import exact
from mien.core.mesh import Ints, Points

from .angles import share, sin_cos, soft_step
from .measured import LID_RINGS, Floats, Lids
from .units import DEG

FOLLOW_DOWN, FOLLOW_UP = 0.019, 0.008
"""Share of closing a degree of gaze: the upper lid follows the eye down, less so up."""

LOWER_FOLLOW = 0.8

MEETING_STATIONS = ((1, 11), (2, 10), (3, 9), (4, 8), (5, 7))
"""Stations of the upper and of the lower lid that meet, from the inner corner outwards."""

MEETING_RINGS = [LID_RINGS.index(ring) for ring in ("margin", "inner", "hidden", "lip", "crease")]
MEETING_SHARES = (1.0, 1.0, 1.0, 0.7, 0.25)
"""Rings that are held together, the first of which meets the other lid's, and how far each goes along."""

HELD_FROM = 0.75
"""Share of the way to shut from which on lids are held together."""


@dataclass(frozen=True, eq=False)
class LidTable:
    """The lids as arrays.

    Attributes:
        numbers: (L, 3) vertex; 1 left, 0 right; 1 upper, -1 lower lid, 0 corners.
        polar: (L, 6) sine and cosine of the azimuth; elevation, rad, and radius, m, at rest and shut.
        rest: (L, 3) m about the eye.
        pairs: (K, 2, R) vertices above and below that meet, on the margin and on the rings that go with it.
        gaps: (K, 4) m from the upper to the lower margin when shut; and 1 left, 0 right.
    """

    numbers: Ints
    polar: Floats
    rest: Points
    pairs: Ints
    gaps: Floats


def lid_table(lids: Lids) -> LidTable:
    """The table of measured or fitted lids."""
    sine, cosine = exact.sin_cos(lids.azimuth)
    shut = on_sphere(lids.azimuth, lids.elevation_shut, lids.radius_shut)
    pairs, gaps = [], []
    for side in (1, -1):
        rows = np.flatnonzero(lids.side == side).reshape(len(LID_RINGS), -1)
        for above, below in MEETING_STATIONS:
            upper, lower = rows[MEETING_RINGS, above], rows[MEETING_RINGS, below]
            pairs.append((lids.index[upper], lids.index[lower]))
            gaps.append((*((shut[lower[0]] - shut[upper[0]]) * (side, 1, 1)), float(side > 0)))
    return LidTable(
        np.stack([lids.index, (lids.side > 0).astype(np.int64), lids.upper], axis=1),
        np.stack([sine, cosine, lids.elevation, lids.elevation_shut, lids.radius, lids.radius_shut], axis=1),
        on_sphere(lids.azimuth, lids.elevation, lids.radius),
        np.array(pairs),
        np.array(gaps),
    )


@kernel()
def closing(opening, rest):
    """How far the lids have gone from rest (0) to shut (1) at Parke's opening; ``rest`` is that of a face at rest."""
    return max(1.0 - opening / rest, 0.0)


@kernel()
def elevation_deg(height):
    """Degrees from the sine of an elevation: the arcsine's series is exact enough for lids."""
    return height * (1.0 + height * height / 6.0) / DEG


@kernel()
def move_lids(points, numbers, polar, rest, closed, gaze_up_deg):
    """Close the lids of the skin (V, 3) m by a share of the way.

    A lid vertex is given in two dimensions, azimuth and elevation about its eye. These are interpolated; the
    sphere gives the third. What the lids have moved since rest is added, so that squints and raised cheeks stay.

    Args:
        points: skin at rest or with expressions; changed.
        numbers: of ``LidTable``.
        polar: of ``LidTable``.
        rest: of ``LidTable``.
        closed: share of the way to shut, left and right.
        gaze_up_deg: where each eye looks, upwards; the lids follow.

    Source: Parke 1974, section 3.1.2 and figure 3.8.
    """
    for n in range(len(numbers)):
        v, left, upper = numbers[n, 0], numbers[n, 1], numbers[n, 2]
        part, up = (closed[0], gaze_up_deg[0]) if left else (closed[1], gaze_up_deg[1])
        follow = -(FOLLOW_DOWN if up < 0.0 else FOLLOW_UP) * up * share(1.0 - part)
        if upper > 0:
            part += follow
        elif upper < 0:
            part -= LOWER_FOLLOW * follow
        part = min(part, 1.0)
        elevation = polar[n, 2] + part * (polar[n, 3] - polar[n, 2])
        radius = polar[n, 4] + share(part) * (polar[n, 5] - polar[n, 4])
        sine, cosine = sin_cos(elevation)
        flat = radius * cosine
        x = flat * polar[n, 0] - rest[n, 0]
        points[v, 0] += x if left else -x
        points[v, 1] += radius * sine - rest[n, 1]
        points[v, 2] += flat * polar[n, 1] - rest[n, 2]


@kernel()
def meet_lids(points, pairs, gaps, closed):
    """Keep margins (V, 3) m that meet from passing one another, and together when shut, whatever raises the cheeks.

    Args:
        points: changed.
        pairs: of ``LidTable``.
        gaps: of ``LidTable``.
        closed: share of the way to shut, left and right.
    """
    for k in range(len(gaps)):
        held = soft_step((closed[0 if gaps[k, 3] == 1.0 else 1] - HELD_FROM) / (1.0 - HELD_FROM))
        upper, lower = pairs[k, 0, 0], pairs[k, 1, 0]
        for axis in range(3):
            excess = points[lower, axis] - points[upper, axis] - gaps[k, axis]
            part = 0.5 * (1.0 if axis == 1 and excess > 0.0 else held) * excess
            for ring in range(pairs.shape[2]):
                points[pairs[k, 0, ring], axis] += MEETING_SHARES[ring] * part
                points[pairs[k, 1, ring], axis] -= MEETING_SHARES[ring] * part


def on_sphere(azimuth: Floats, elevation: Floats, radius: Floats) -> Points:
    """(..., 3) m about the eye: azimuth outwards and elevation upwards (...), rad; radius (...), m."""
    sin_up, cos_up = exact.sin_cos(elevation)
    sin_around, cos_around = exact.sin_cos(azimuth)
    flat = radius * cos_up
    return np.stack([flat * sin_around, radius * sin_up, flat * cos_around], axis=-1)
