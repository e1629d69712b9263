"""The jaw: rotation about its axis with a share for every point."""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np

from mien.compiling import kernel

from .angles import sin_cos
from .measured import Floats
from .units import DEG

JawKind = Literal["fitted", "parke", "untapered"]

SHARES: Mapping[JawKind, tuple[tuple[float, ...], tuple[float, ...]]] = {
    "fitted": ((0.0, 1.0), (0.0, 1.0)),
    "parke": ((0.0, 0.44, 0.80, 1.0), (0.0, 1.0 / 3.0, 1.0, 1.0)),
    "untapered": ((0.0, 0.44, 0.60, 0.67, 1.0), (0.0, 0.5, 0.5, 1.0, 1.0)),
}
"""Fitted shares, and what they become: chin, corner of the mouth and lower lip.

The fitted ones are 0.44 at the corner, 0.68 to 0.93 on the lower lip and 0.80 to 0.93 on the chin. Parke's chin turns
fully and his corner by a third, the lower lip in between; at first all of the lower lip turned fully and the corner by
a half.
"""


@kernel()
def swing(y, z, axis, sine, cosine):
    """A point's y and z turned about the jaw's axis."""
    y, z = y - axis[0], z - axis[1]
    return axis[0] + y * cosine - z * sine, axis[1] + y * sine + z * cosine


@kernel()
def rotate_jaw(points, angle_deg, axis, share, waves):
    """Swing points (V, 3) m open by an angle.

    Args:
        points: head frame.
        angle_deg: positive opens the mouth.
        axis: (2,) m, y and z of the axis, which runs along x.
        share: (V,) share of the angle; 1 turns a point with the jaw, 0 leaves it where it is.
        waves: (2, V), overwritten by sines and cosines.

    Source: Parke 1974, section 3.3.
    """
    if angle_deg == 0.0:
        return
    sines, cosines = waves[0], waves[1]
    for v in range(len(share)):
        sine, cosine = sin_cos((angle_deg * DEG) * share[v])
        sines[v], cosines[v] = sine, cosine
    for v in range(len(points)):
        points[v, 1], points[v, 2] = swing(points[v, 1], points[v, 2], axis, sines[v], cosines[v])


@kernel()
def open_jaw(points, angle_deg, axis, share, open_angle_deg, residual, waves):
    """Open the jaw of the skin (V, 3) m: rotation, then what it misses of the measured open mouth (throat, corners).

    ``residual`` (V, 3) m is what is missed at ``open_angle_deg``.
    """
    if angle_deg == 0.0:
        return
    rotate_jaw(points, angle_deg, axis, share, waves)
    opened = angle_deg / open_angle_deg
    for v in range(len(points)):
        for axis_number in range(3):
            points[v, axis_number] += opened * residual[v, axis_number]


@kernel()
def carry_with_jaw(points, carried, angle_deg, axis, shift):
    """Turn the points (N, 3) m that are ``carried`` (N,) with the jaw, and shift them with the chin."""
    sine, cosine = sin_cos(angle_deg * DEG)
    for n in range(len(points)):
        if carried[n]:
            if angle_deg != 0.0:
                points[n, 1], points[n, 2] = swing(points[n, 1], points[n, 2], axis, sine, cosine)
            for k in range(3):
                points[n, k] += shift[k]


@kernel()
def chin_shift(forward, side, chin):
    """How far the chin is shifted: forward, and to the own left (-1..1).

    ``chin`` (3, 3) m are its measured moves to the left, to the right, and forward.
    """
    x, y, z = forward * chin[2, 0], forward * chin[2, 1], forward * chin[2, 2]
    way, row = (side, 0) if side > 0.0 else (-side, 1)
    return x + way * chin[row, 0], y + way * chin[row, 1], z + way * chin[row, 2]


def remake_shares(share: Floats, jaw: JawKind) -> Floats:
    """Fitted shares as they are, or remade as Parke's; points of no share keep none.

    Source: Parke 1974, section 3.3 and figure 3.12.
    """
    return np.interp(share, *SHARES[jaw])
