"""Weights that fade with distance: 1 where a deformer acts fully, 0 where it leaves a point alone."""

from __future__ import annotations

import numpy as np

from mien.core import exact
from mien.core.mesh import Points
from mien.core.sparse import Floats


def ellipse(points: Points, centre: tuple[float, float], radii: tuple[float, float], reach: float) -> Floats:
    """(V,) 1 inside an ellipse of the frontal plane, fading to 0 at ``reach`` times its radii; 0 behind the ears."""
    dx, dy = (points[:, 0] - centre[0]) / radii[0], (points[:, 1] - centre[1]) / radii[1]
    distance = np.sqrt(dx * dx + dy * dy)
    return exact.smoothstep((reach - distance) / (reach - 1.0)) * (points[:, 2] > 0.03)


def bell(points: Points, centre: tuple[float, float], radii: tuple[float, float]) -> Floats:
    """(V,) Gaussian bell of the frontal plane, 0 behind the ears and where it has faded below 1/100."""
    dx, dy = (points[:, 0] - centre[0]) / radii[0], (points[:, 1] - centre[1]) / radii[1]
    weight = exact.exp(-(dx * dx + dy * dy))
    return np.where((weight > 0.01) & (points[:, 2] > 0.03), weight, 0.0)


def own_side(points: Points, side: int, ramp_m: float) -> Floats:
    """(V,) 0 on the midline and beyond, 1 from ``ramp_m`` on the left (side 1) or right (side -1)."""
    return exact.smoothstep(points[:, 0] * side / ramp_m)


def along(axis: int, weight: Floats) -> Points:
    """(V, 3) vectors along an axis (0 x, 1 y, 2 z), as long as the weights (V,)."""
    out = np.zeros((len(weight), 3))
    out[:, axis] = weight
    return out
