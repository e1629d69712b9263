"""The jaw: rotation about its axis with a share for every point."""

from __future__ import annotations

import numpy as np

from mien.core import exact
from mien.core.mesh import Points

from .measured import Floats, Measured
from .units import DEG


def rotate_jaw(points: Points, angle_deg: float, axis: Floats, share: Floats | float = 1.0) -> Points:
    """Points (V, 3) m with the jaw swung open by an angle.

    Args:
        points: head frame.
        angle_deg: positive opens the mouth.
        axis: (2,) m, y and z of the axis, which runs along x.
        share: (V,) share of the angle; 1 turns a point with the jaw, 0 leaves it where it is.

    Source: Parke 1974, section 3.3.
    """
    if not angle_deg:
        return points
    angle = (angle_deg * DEG) * np.asarray(share, dtype=np.float64)
    sine, cosine = exact.sin_cos(angle)
    y, z = points[:, 1] - axis[0], points[:, 2] - axis[1]
    return np.stack([points[:, 0], axis[0] + y * cosine - z * sine, axis[1] + y * sine + z * cosine], axis=1)


def open_jaw(points: Points, angle_deg: float, axis: Floats, open_angle_deg: float, measured: Measured) -> Points:
    """Skin with the jaw open: the rotation, then what it misses of the measured open mouth (throat, corners)."""
    if not angle_deg:
        return points
    turned = rotate_jaw(points, angle_deg, axis, measured.jaw_share)
    return turned + (angle_deg / open_angle_deg) * measured.jaw_residual


def parke_shares(share: Floats) -> Floats:
    """Fitted shares remade as Parke's: the chin turns fully, the mouth corner by a third, the lower lip in between.

    The fitted shares are 0.44 at the corner and 0.80 to 0.93 on chin and middle of the lower lip; the map between
    is piecewise linear, so points of no share keep none.

    Source: Parke 1974, section 3.3 and figure 3.12 (b).
    """
    return np.interp(share, [0.0, 0.44, 0.80, 1.0], [0.0, 1.0 / 3.0, 1.0, 1.0])
