"""Products of vectors, summed from x to z: NumPy's own may sum in another order on another machine."""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

import numpy as np

from mien.compiling import kernel
from mien.core.mesh import Points

from .measured import Floats


def length(vectors: Points) -> Floats:
    """(...) lengths of vectors (..., 3)."""
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    return np.asarray(np.sqrt(x * x + y * y + z * z))


@kernel()
def cross(a, b):
    """The vector product of two vectors, each three numbers."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@kernel()
def unit(x, y, z):
    """A vector of length 1; the one given must have a length."""
    size = np.sqrt(x * x + y * y + z * z)
    return x / size, y / size, z / size


@kernel()
def unit_or_ahead(x, y, z):
    """A vector of length 1; straight ahead if the one given has no length."""
    size = np.sqrt(x * x + y * y + z * z)
    if size > 1e-12:
        return x / size, y / size, z / size
    return 0.0, 0.0, 1.0


@kernel()
def bind(index, weight, values, row):
    """Sum of weight times value over what one row (K,) of a binding names: three numbers."""
    x, y, z = 0.0, 0.0, 0.0
    for k in range(index.shape[1]):
        vertex, part = index[row, k], weight[row, k]
        x += part * values[vertex, 0]
        y += part * values[vertex, 1]
        z += part * values[vertex, 2]
    return x, y, z
