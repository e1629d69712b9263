"""Lashes, and the pink corner of the eye that fills what lids and ball leave open."""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.compiling import kernel
from mien.core.mesh import Ints

from .measured import Archive, Floats
from .vectors import bind, cross, unit

LINE_LIFT_M = 0.00012
"""How far the dark line at the margin of a lid stands off the skin."""

SHUT_DROOP = 3.5
"""How far upper lashes turn down as their lid passes the middle of the eye; else a shut eye shows only their tips."""


@dataclass(frozen=True, eq=False)
class Lashes:
    """Spikes and a dark line bound to the lid margins.

    Attributes:
        index, weight: left and right (N, K), what of the posed skin a vertex sits on.
        reach: left and right (N, 4): length m, upwards, sideways, 1 where the vertex is a tip.
        quads: (Q, 4); lower: (Q,) whether a polygon belongs to the lower lid.
    """

    index: tuple[Ints, Ints]
    weight: tuple[Floats, Floats]
    reach: tuple[Floats, Floats]
    quads: Ints
    lower: np.ndarray[tuple[int], np.dtype[np.bool_]]


def lashes(archive: Archive) -> Lashes:
    """The lashes of the data file."""
    return Lashes(
        (archive.ints("lash_left_index"), archive.ints("lash_right_index")),
        (archive.floats("lash_left_weight"), archive.floats("lash_right_weight")),
        (archive.floats("lash_left_tip"), archive.floats("lash_right_tip")),
        archive.ints("lash_quads"),
        archive.ints("lash_lower").astype(bool),
    )


@kernel()
def place_lashes(index, weight, reach, skin, centre, sign, out):
    """Fill ``out`` (N, 3) m with one eye's lashes on posed skin (V, 3): they stand off the ball, upwards and outwards.

    ``index``, ``weight`` and ``reach`` are those of one side of ``Lashes``; ``sign`` is 1 for the left eye, -1 for the
    right one.
    """
    for n in range(len(reach)):
        x, y, z = bind(index, weight, skin, n)
        rx, ry, rz = unit(x - centre[0], y - centre[1], z - centre[2])
        if reach[n, 3] > 0.0:
            up = unit(-rx * ry, -ry * ry + 1.0, -rz * ry)
            ax, ay, az = cross(up, (rx, ry, rz))
            high, wide = reach[n, 1], reach[n, 2]
            if high > 0.0:
                high += SHUT_DROOP * min(ry, 0.0)
            dx = rx + up[0] * high + sign * ax * wide
            dy = ry + up[1] * high + sign * ay * wide
            dz = rz + up[2] * high + sign * az * wide
            dx, dy, dz = unit(dx, dy, dz)
            out[n, 0], out[n, 1], out[n, 2] = x + dx * reach[n, 0], y + dy * reach[n, 0], z + dz * reach[n, 0]
        else:
            out[n, 0], out[n, 1], out[n, 2] = x + rx * LINE_LIFT_M, y + ry * LINE_LIFT_M, z + rz * LINE_LIFT_M


CARUNCLE_CORNERS = ("e0_0", "e0_1", "e0_11", "ei_1", "ei_11")
CARUNCLE_QUADS = np.array([[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 5, 6]])
CARUNCLE_MIRROR = (0, 3, 6, 1, 4, 5, 2)
"""Vertex that each becomes in the mirror: upper and lower change places, so that the polygons still face outwards."""


def caruncle_corners(archive: Archive) -> Ints:
    """(2, 5) vertices of the skin that hold it, left and right: the corner, two above it and two below."""
    left = np.array([archive.vertex[name] for name in CARUNCLE_CORNERS], dtype=np.int64)
    return np.stack([left, archive.mirror[left]])


@kernel()
def place_caruncle(skin, corners, centre, radius, mirrored, out):
    """Fill ``out`` (7, 3) m, three polygons between the inner corner of the lids and the ball.

    Args:
        skin: (V, 3) m, posed.
        corners: (5,) of ``caruncle_corners``.
        centre: of the ball, m.
        radius: of the ball, m.
        mirrored: whether it is the right eye's.
        out: filled.
    """
    e, near_above, near_below, far_above, far_below = corners[0], corners[1], corners[2], corners[3], corners[4]
    upper, lower = (3, 1) if mirrored else (1, 3)
    above, below = (6, 2) if mirrored else (2, 6)
    bulge, ball = 4, 5
    for axis in range(3):
        c = centre[axis]
        out[0, axis] = c + (skin[e, axis] - c) * 0.985
        out[above, axis] = c + (skin[far_above, axis] - c) * 0.99
        out[below, axis] = c + (skin[far_below, axis] - c) * 0.99
        out[upper, axis] = c + (skin[near_above, axis] * 0.4 + skin[e, axis] * 0.6 - c) * 0.985
        out[lower, axis] = c + (skin[near_below, axis] * 0.4 + skin[e, axis] * 0.6 - c) * 0.985
    mx = (out[above, 0] + out[below, 0]) * 0.5 - centre[0]
    my = (out[above, 1] + out[below, 1]) * 0.5 - centre[1]
    mz = (out[above, 2] + out[below, 2]) * 0.5 - centre[2]
    middle = unit(mx, my, mz)
    for axis in range(3):
        out[ball, axis] = centre[axis] + middle[axis] * (radius - 0.0005)
        total = out[0, axis] + out[upper, axis] + out[lower, axis] + out[ball, axis]
        out[bulge, axis] = total * 0.25 + (0.0005 if axis == 2 else 0.0)
