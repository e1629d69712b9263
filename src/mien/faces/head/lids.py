"""Eyelids: two-dimensional interpolation between open and shut, projected back on a sphere about the eye."""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.compiling import kernel
from mien.core import exact
from mien.core.mesh import Ints, Points

from .angles import share, sin_cos
from .measured import Floats, Lids
from .units import DEG

FOLLOW_DOWN, FOLLOW_UP = 0.019, 0.008
"""Share of closing a degree of gaze: the upper lid follows the eye down, less so up."""

LOWER_FOLLOW = 0.8


@dataclass(frozen=True, eq=False)
class LidTable:
    """The lids as arrays.

    Attributes:
        numbers: (L, 3) vertex; 1 left, 0 right; 1 upper, -1 lower lid, 0 corners.
        polar: (L, 6) sine and cosine of the azimuth; elevation, rad, and radius, m, at rest and shut.
        rest: (L, 3) m about the eye.
    """

    numbers: Ints
    polar: Floats
    rest: Points


def lid_table(lids: Lids) -> LidTable:
    """The table of measured or fitted lids."""
    sine, cosine = exact.sin_cos(lids.azimuth)
    return LidTable(
        np.stack([lids.index, (lids.side > 0).astype(np.int64), lids.upper], axis=1),
        np.stack([sine, cosine, lids.elevation, lids.elevation_shut, lids.radius, lids.radius_shut], axis=1),
        on_sphere(lids.azimuth, lids.elevation, lids.radius),
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


def on_sphere(azimuth: Floats, elevation: Floats, radius: Floats) -> Points:
    """(..., 3) m about the eye: azimuth outwards and elevation upwards (...), rad; radius (...), m."""
    sin_up, cos_up = exact.sin_cos(elevation)
    sin_around, cos_around = exact.sin_cos(azimuth)
    flat = radius * cos_up
    return np.stack([flat * sin_around, radius * sin_up, flat * cos_around], axis=-1)
