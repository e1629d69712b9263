"""The head pivots on the neck: a rotation whose angle fades from the skull to the collar."""

from __future__ import annotations

import numpy as np

from mien.core import Pose, exact
from mien.core.mesh import Points

from .measured import Floats
from .units import DEG

PIVOT = np.array([0.0, -0.085, -0.022])
BASE_Y_M, BASE_SLOPE = -0.163, -0.19
"""The neck ends on the plane y = -0.163 - 0.19 z, where the collar sits."""

RIGID_ABOVE_M = 0.055


def neck_share(points: Points) -> Floats:
    """(V,) share of the head's rotation: 0 at the collar, 1 from the chin up."""
    height = points[:, 1] - (BASE_Y_M + BASE_SLOPE * points[:, 2])
    return exact.smoothstep(height / RIGID_ABOVE_M)


def head_angles(pose: Pose) -> tuple[float, float, float]:
    """Turn to the own left, nod upwards, tilt to the own left; radians."""
    return pose["head.turn"] * DEG, pose["head.nod"] * DEG, pose["head.tilt"] * DEG


def turn_head(points: Points, angles: tuple[float, float, float], share: Floats) -> Points:
    """Points (V, 3) m tilted, nodded, then turned about the neck's pivot, each by its share (V,) of the angles."""
    if not any(angles):
        return points
    out = np.where((share >= 1.0)[:, None], turn_direction(points - PIVOT, angles) + PIVOT, points)
    neck = np.flatnonzero((share > 0.0) & (share < 1.0))
    turn, nod, tilt = (angle * share[neck] for angle in angles)
    x, y, z = (points[neck] - PIVOT).T
    x, y = _rotate(x, y, -tilt)
    y, z = _rotate(y, z, -nod)
    z, x = _rotate(z, x, turn)
    out[neck] = np.stack([x, y, z], axis=1) + PIVOT
    return out


def turn_back(point: Points, angles: tuple[float, float, float]) -> Points:
    """(N, 3) m, points of the room as the turned head sees them: the inverse of ``turn_head``."""
    if not any(angles):
        return point
    turn, nod, tilt = (np.asarray(angle) for angle in angles)
    x, y, z = (point - PIVOT).T
    z, x = _rotate(z, x, -turn)
    y, z = _rotate(y, z, nod)
    x, y = _rotate(x, y, tilt)
    return np.stack([x, y, z], axis=1) + PIVOT


def turn_direction(directions: Points, angles: tuple[float, float, float]) -> Points:
    """(N, 3) directions turned with the head."""
    if not any(angles):
        return directions
    turn, nod, tilt = (np.asarray(angle) for angle in angles)
    # Columns of the rotation are where its three steps take the axes.
    axes = np.eye(3)
    x, y, z = axes
    x, y = _rotate(x, y, -tilt)
    y, z = _rotate(y, z, -nod)
    z, x = _rotate(z, x, turn)
    rows = (x, y, z)
    return np.stack(
        [row[0] * directions[:, 0] + row[1] * directions[:, 1] + row[2] * directions[:, 2] for row in rows], axis=1
    )


def _rotate(a: Floats, b: Floats, angle: Floats) -> tuple[Floats, Floats]:
    """Coordinates turned from axis a towards axis b."""
    sine, cosine = exact.sin_cos(angle)
    return a * cosine - b * sine, a * sine + b * cosine
