"""The tongue: its tip rises, bends, and goes out between whatever teeth and lips leave open.

Source: Parke 1974, section 5.1, wishes for a tongue; its course here, over the lower teeth and the lower lip, is ours.
"""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.compiling import kernel
from mien.core import exact
from mien.core.mesh import Points

from .angles import share, sin_cos, soft_step
from .jaw import swing
from .measured import Floats
from .units import DEG

RAISE_M = 0.0105
BACK_Z_M, TIP_Z_M = 0.052, 0.084

SIDES = 16
"""Vertices of each ring around the tongue, from the tip to the root."""

JAW_SHARE, SHIFT_SHARE = 0.82, 0.7
"""How far the tongue goes with the jaw's rotation, and with its forward moves; aside it goes all the way, between the
lower teeth."""

BEHIND_M, TO_LIPS_M, BEYOND_M = 0.0015, 0.0085, 0.0240
"""Ways of the tip: up to the teeth, on to the lips, and out over the lower one."""

GAP_M, WIDE_M = 0.0006, 0.002
"""A gap between teeth or lips through which a tip begins to go, and how much more lets it go its full way."""

CLEAR_M = 0.0005
ARCH = 50.0
"""The rows of teeth lie back by 50 x^2 metres at x metres from the middle."""

ONTO_M, OVER_M = 0.009, 0.006
"""Behind the front teeth the tongue begins to rise onto them; behind the lip it begins to lie on that."""

DROOP = 60.0
BEND_IN_M, BEND_OUT_M = 0.004, 0.009
SIDE_IN_M, SIDE_OUT_M = 0.002, 0.009
"""How far the tip bends up or down, and to a side, within the mouth, and as much more outside."""

BESIDE_M = 0.005
"""Teeth so near in height and depth are beside a point of the tongue."""


@dataclass(frozen=True, eq=False)
class Tongue:
    """A tongue at rest, N vertices.

    Attributes:
        profile: (N, 5) share of the tip's way; height over the middle of its ring, m; half the height of its ring, m;
            and the room to the teeth on the right and on the left, m.
        edges: (2, 2) m, y and z of the edges of the front teeth, the upper ones first.
        front: (2,) m, height of the edge of the upper front teeth, and how far forward they reach.
    """

    profile: Floats
    edges: Floats
    front: Floats


def tongue_of(points: Points, upper_teeth: Points, lower_teeth: Points) -> Tongue:
    """The tongue whose points (N, 3) m these are, between the teeth (K, 3) m."""
    tip = exact.smoothstep((points[:, 2] - BACK_Z_M) / (TIP_Z_M - BACK_Z_M))
    heights = points[:, 1].reshape(-1, SIDES)
    low, high = heights.min(axis=1), heights.max(axis=1)
    middle, half = np.repeat(0.5 * (low + high), SIDES), np.repeat(0.5 * (high - low), SIDES)
    upper, lower = (teeth[np.abs(teeth[:, 0]) < 0.004] for teeth in (upper_teeth, lower_teeth))
    edges = upper[np.argmin(upper[:, 1]), 1:], lower[np.argmax(lower[:, 1]), 1:]
    front = np.array([upper[:, 1].min(), upper[:, 2].max()])
    teeth = np.concatenate([upper_teeth, lower_teeth])
    rooms = [_room(points, teeth, side) for side in (-1.0, 1.0)]
    return Tongue(np.stack([tip, points[:, 1] - middle, half, *rooms], axis=1), np.stack(edges), front)


def _room(points: Points, teeth: Points, side: float) -> Floats:
    """(N,) m that points may go aside, to the right (-1) or the left, before they meet teeth (K, 3) m."""
    x, y, z = np.moveaxis(teeth[None] - points[:, None], 2, 0)
    beside = (np.abs(y) < BESIDE_M) & (np.abs(z) < BESIDE_M) & (teeth[:, 0] * side > 0.0)
    return np.maximum(np.where(beside, side * x, np.inf).min(axis=1) - CLEAR_M, 0.0)


@kernel()
def way_out(out, gap, aperture):
    """How far the tip goes forward, m: as far as the gaps between the teeth and between the lips, m, let it."""
    teeth, lips = soft_step((gap - GAP_M) / WIDE_M), soft_step((aperture - GAP_M) / WIDE_M)
    return min(out * (BEHIND_M + TO_LIPS_M + BEYOND_M), BEHIND_M + teeth * (TO_LIPS_M + lips * BEYOND_M))


@kernel()
def move_tongue(points, profile, edges, tip, jaw_deg, axis, shift, lips):
    """Move the tongue with the jaw, and its tip.

    Args:
        points: (N, 3) m, at rest; changed.
        profile: of ``Tongue``.
        edges: of ``Tongue``.
        tip: raise, out, side and up.
        jaw_deg: rotation of the jaw.
        axis: (2,) m, of the jaw.
        shift: of the chin, m.
        lips: lower edge of the upper lip, upper edge of the lower one, how far forward that is, and its red, m.
    """
    rise, out, aside, bend = tip
    sine, cosine = sin_cos(JAW_SHARE * jaw_deg * DEG)
    jaw_sine, jaw_cosine = sin_cos(jaw_deg * DEG)
    low_y, low_z = swing(edges[1, 0], edges[1, 1], axis, jaw_sine, jaw_cosine)
    low_y, low_z = low_y + shift[1], low_z + shift[2]
    slope = jaw_sine / jaw_cosine
    parted = soft_step((edges[0, 0] - low_y - GAP_M) / WIDE_M)
    forward = way_out(out, edges[0, 0] - low_y, lips[0] - lips[1])
    led = soft_step(forward / (BEHIND_M + 0.5 * TO_LIPS_M))
    lip_z = max(lips[2], low_z + CLEAR_M)
    for n in range(len(points)):
        part, above, half = profile[n, 0], profile[n, 1], profile[n, 2]
        middle, z = swing(points[n, 1] - above, points[n, 2] + part * forward, axis, sine, cosine)
        middle, z = middle + SHIFT_SHARE * shift[1], z + SHIFT_SHARE * shift[2]
        x = points[n, 0]
        # Over the teeth: as high as lies between both rows, and on the lower one if there is room.
        floor = low_y + (low_z - z) * slope
        room = max(0.5 * (edges[0, 0] - floor) - CLEAR_M, 0.0)
        thick = min(half, room)
        over = floor + CLEAR_M + thick
        # Over the lip, and down in front of it.
        onto_lip = soft_step((z - lip_z + OVER_M) / OVER_M)
        lip_thick = min(half, max(0.5 * (lips[0] - lips[1]) - CLEAR_M, 0.0))
        thick += onto_lip * (lip_thick - thick)
        over += onto_lip * (lips[1] + CLEAR_M + thick - over)
        beyond = max(z - lips[3], 0.0)
        outside = led * share((z - low_z) / (OVER_M + BEYOND_M))
        over += bend * BEND_OUT_M * outside * outside - (1.0 - share(bend)) * DROOP * beyond * beyond
        onto = led * soft_step((z + ARCH * x * x - low_z + ONTO_M) / ONTO_M)
        y = middle + above + part * (rise * RAISE_M + bend * BEND_IN_M * part * part)
        within = min(max(aside * part * SIDE_IN_M, -profile[n, 3]), profile[n, 4])
        freely = shift[0] + within
        held = min(max(freely, -profile[n, 3]), profile[n, 4])
        points[n, 0] = x + held + parted * (freely - held) + aside * part * SIDE_OUT_M * outside
        points[n, 1] = y + onto * (over + above * thick / half - y)
        points[n, 2] = z
