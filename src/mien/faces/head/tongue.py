"""The tongue, and what turns with the jaw inside the mouth."""

from __future__ import annotations

import numpy as np

from mien.core import Pose, exact
from mien.core.mesh import Points

RAISE_M = np.array([0.0, 0.0105, 0.0005])
OUT_M = np.array([0.0, 0.0035, 0.0125])
BACK_Z_M, TIP_Z_M = 0.052, 0.084


def move_tongue(points: Points, pose: Pose) -> Points:
    """Points (N, 3) m with the tip raised behind the upper teeth, or forward between the teeth.

    The root stays; the move grows towards the tip.
    """
    up, out = pose["tongue.raise"], pose["tongue.out"]
    if not (up or out):
        return points
    share = exact.smoothstep((points[:, 2] - BACK_Z_M) / (TIP_Z_M - BACK_Z_M))[:, None]
    return points + share * (up * RAISE_M + out * OUT_M)
