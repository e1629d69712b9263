"""Products of vectors (..., 3), summed from x to z: NumPy's own may sum in another order on another machine."""

from __future__ import annotations

import numpy as np

from mien.core.mesh import Points

from .measured import Floats


def dot(a: Points, b: Points) -> Floats:
    """(...) scalar products."""
    return np.asarray(a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1] + a[..., 2] * b[..., 2])


def cross(a: Points, b: Points) -> Points:
    """(..., 3) vector products."""
    return np.stack(
        [
            a[..., 1] * b[..., 2] - a[..., 2] * b[..., 1],
            a[..., 2] * b[..., 0] - a[..., 0] * b[..., 2],
            a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0],
        ],
        axis=-1,
    )


def length(vectors: Points) -> Floats:
    """(...) lengths."""
    return np.asarray(np.sqrt(dot(vectors, vectors)))


def unit(vectors: Points) -> Points:
    """(..., 3) vectors of length 1; none may have the length 0."""
    return vectors / length(vectors)[..., None]
