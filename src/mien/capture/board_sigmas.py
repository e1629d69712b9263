"""How exactly corners of a board were found: as much as they depart from a smooth grid."""

from __future__ import annotations

import numpy as np

from mien.core.mesh import Points

USUAL_PX = 0.2
"""Where there are too few corners to tell."""

LEAST_PX = 0.05
"""Paper is never flat enough, nor are lenses simple enough, for more."""

DEGREE = 3
"""Of the polynomials that a grid follows through perspective and the lens, beside its homography."""


def corner_sigma(corners: Points) -> float:
    """Standard deviation of u and of v, px, of what is no smooth function of row and column.

    Args:
        corners: (R, C, 2) px, NaN where one is not seen.
    """
    seen = np.isfinite(corners[..., 0])
    rows, columns = np.nonzero(seen)
    x, y = 2.0 * columns / (corners.shape[1] - 1) - 1.0, 2.0 * rows / (corners.shape[0] - 1) - 1.0
    terms = np.stack([x**a * y**b for a in range(DEGREE + 1) for b in range(DEGREE + 1 - a)], axis=1)
    found = corners[seen]
    spare = len(found) - terms.shape[1] - 3
    if spare < terms.shape[1]:
        return USUAL_PX
    weights = _perspective(x, y, found)
    scaled = terms / weights[:, None]
    fitted = scaled @ np.linalg.lstsq(scaled, found, rcond=None)[0]
    sigma = float(np.sqrt(((found - fitted) ** 2).sum() / (2.0 * spare)))
    return round(max(sigma, LEAST_PX), 3)


def _perspective(x: Points, y: Points, found: Points) -> Points:
    """How far each corner is from the camera, relative to the middle: the denominator of its homography, (N,)."""
    middle, spread = found.mean(axis=0), found.std()
    u, v = ((found - middle) / spread).T
    plane = np.stack([x, y, np.ones_like(x)], axis=1)
    zero = np.zeros_like(plane)
    equations = np.concatenate(
        [np.hstack([plane, zero, -u[:, None] * plane]), np.hstack([zero, plane, -v[:, None] * plane])]
    )
    homography = np.linalg.svd(equations)[2][-1]
    weights = plane @ homography[6:]
    return weights / weights.mean()
