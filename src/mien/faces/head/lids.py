"""Eyelids: two-dimensional interpolation between open and shut, projected back on a sphere about the eye."""

from __future__ import annotations

import numpy as np

from mien.core import exact
from mien.core.mesh import Points

from .measured import Floats, Lids
from .rest import REST_OPENING

WIDE = 0.24
"""How far the lids pass their rest when the eye is wide open, as a share of the way from rest to shut."""

FOLLOW_DOWN, FOLLOW_UP = 0.019, 0.008
"""Share of closing a degree of gaze: the upper lid follows the eye down, less so up."""

LOWER_FOLLOW = 0.8


def closing(opening: float) -> float:
    """How far the lids have gone from rest (0) to shut (1) at Parke's opening; negative is wider than rest."""
    if opening <= REST_OPENING:
        return 1.0 - opening / REST_OPENING
    return -WIDE * (opening - REST_OPENING) / (1.0 - REST_OPENING)


def move_lids(points: Points, lids: Lids, closed: tuple[float, float], gaze_up_deg: tuple[float, float]) -> Points:
    """Points (V, 3) m with the lids of the left and right eye closed by a share of the way.

    A lid vertex is given in two dimensions, azimuth and elevation about its eye. These are interpolated; the
    sphere gives the third. What the lids have moved since rest is added, so that squints and raised cheeks stay.

    Args:
        points: skin at rest or with expressions.
        lids: polar coordinates at rest and shut.
        closed: share of the way to shut, left and right.
        gaze_up_deg: where each eye looks, upwards; the lids follow.

    Source: Parke 1974, section 3.1.2 and figure 3.8.
    """
    left = lids.side > 0
    share = np.where(left, closed[0], closed[1])
    up = np.where(left, gaze_up_deg[0], gaze_up_deg[1])
    follow = -np.where(up < 0.0, FOLLOW_DOWN, FOLLOW_UP) * up * np.clip(1.0 - share, 0.0, 1.0)
    share = np.where(lids.upper > 0, share + follow, np.where(lids.upper < 0, share - LOWER_FOLLOW * follow, share))
    share = np.minimum(share, 1.0)
    elevation = lids.elevation + share * (lids.elevation_shut - lids.elevation)
    radius = lids.radius + np.clip(share, 0.0, 1.0) * (lids.radius_shut - lids.radius)
    move = on_sphere(lids.azimuth, elevation, radius) - on_sphere(lids.azimuth, lids.elevation, lids.radius)
    move[:, 0] *= lids.side
    out = points.copy()
    out[lids.index] += move
    return out


def on_sphere(azimuth: Floats, elevation: Floats, radius: Floats) -> Points:
    """(..., 3) m about the eye: azimuth outwards and elevation upwards (...), rad; radius (...), m."""
    sin_up, cos_up = exact.sin_cos(elevation)
    sin_around, cos_around = exact.sin_cos(azimuth)
    flat = radius * cos_up
    return np.stack([flat * sin_around, radius * sin_up, flat * cos_around], axis=-1)
