"""The turn of a drawn head: what lies in front of the axis moves with the turn, what lies behind moves against it."""

from __future__ import annotations

import math

import numpy as np

from mien.core import exact

from .records import Floats, Head


def turn(
    points: Floats,
    head: Head,
    depth: float | Floats,
    bulge: float | Floats,
    shorten: float | Floats,
    horizontal_deg: float,
    vertical_deg: float,
    tilt_deg: float = 0.0,
) -> Floats:
    """(N, 2) points of a drawn head that is turned to a side and up, then tilted; the same to the bit at 0 degrees.

    A point at (u, v) of the ellipsoid, from its centre in radii, lies at Z = depth + bulge sqrt(1 - u² - v²) in front
    of the axis; a turn by a moves it by -Z sin a radii and narrows u by the share ``shorten`` (1 - cos a). Depth,
    bulge and shorten are numbers, or (N,) when points of several polygons turn in one call.

    Args:
        points: (N, 2) drawing units, y down.
        head: what it turns about.
        depth: in radii; 0 on the axis, positive in front.
        bulge: in radii; how much further the middle stands out.
        shorten: share of the narrowing of a flat disc.
        horizontal_deg: positive to the left as one sees the picture.
        vertical_deg: positive upwards.
        tilt_deg: positive towards the head's own left shoulder, the right as one sees the picture.
    """
    if horizontal_deg == 0.0 and vertical_deg == 0.0 and tilt_deg == 0.0:
        return points
    across, down = (np.ascontiguousarray(points[:, axis]) - head.center[axis] for axis in (0, 1))
    u, v = across / head.radius[0], down / head.radius[1]
    forward = depth + bulge * np.sqrt(np.maximum(0.0, 1.0 - u * u - v * v))
    # As small moves that are added, a turn by nothing is nothing to the bit.
    x = points[:, 0] + _move(across, forward, shorten, head.radius[0], horizontal_deg)
    y = points[:, 1] + _move(down, forward, shorten, head.radius[1], vertical_deg)
    if tilt_deg:
        sine, cosine = sin_cos_deg(tilt_deg)
        right, below = x - head.pivot[0], y - head.pivot[1]
        x += right * (cosine - 1.0) - below * sine
        y += right * sine + below * (cosine - 1.0)
    return np.stack([x, y], axis=1)


def _move(
    from_center: Floats, forward: Floats, shorten: float | Floats, radius: float, angle_deg: float
) -> Floats | float:
    """(N,) how far points go in the direction of one angle."""
    if angle_deg == 0.0:
        return 0.0
    sine, cosine = sin_cos_deg(angle_deg)
    return -(1.0 - cosine) * shorten * from_center - radius * sine * forward


def sin_cos_deg(angle_deg: float) -> tuple[float, float]:
    """Sine and cosine of an angle, the same bits on every machine."""
    sine, cosine = exact.sin_cos(math.radians(angle_deg))
    return float(sine), float(cosine)
