"""The tongue, and what turns with the jaw inside the mouth."""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from mien.compiling import kernel
from mien.core import exact
from mien.core.mesh import Points

from .measured import Floats

RAISE_M = (0.0, 0.0105, 0.0005)
OUT_M = (0.0, 0.0035, 0.0125)
BACK_Z_M, TIP_Z_M = 0.052, 0.084


def tip_share(points: Points) -> Floats:
    """(N,) how far a vertex goes with the tip: the root stays."""
    return exact.smoothstep((points[:, 2] - BACK_Z_M) / (TIP_Z_M - BACK_Z_M))


@kernel()
def move_tongue(points, share, up, out):
    """Raise the tip of the tongue (N, 3) m behind the upper teeth, or push it between them, by ``tip_share`` (N,)."""
    for axis in range(3):
        tip = up * RAISE_M[axis] + out * OUT_M[axis]
        for n in range(len(points)):
            points[n, axis] += share[n] * tip
