"""Rotations of bones as VMC has them, and the angles of a head or an eye that they are.

Quaternions (x, y, z, w) are in Unity's axes, x to the own right, y up, z forward: a positive angle about x nods down,
about y turns to the own right, about z tilts to the own left. Angles are ours, in degrees: turn to the own left, nod
up, tilt to the own left shoulder; the head is tilted first and turned last, as Unity's own angles are.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

Quaternion = tuple[float, float, float, float]
Angles = tuple[float, float, float]

STILL: Quaternion = (0.0, 0.0, 0.0, 1.0)


def multiply(outer: Quaternion, inner: Quaternion) -> Quaternion:
    """One rotation after another: the outer one is done last.

    Source: Hamilton's product.
    """
    a, b, c, d = outer
    x, y, z, w = inner
    return (
        d * x + a * w + b * z - c * y,
        d * y - a * z + b * w + c * x,
        d * z + a * y - b * x + c * w,
        d * w - a * x - b * y - c * z,
    )


def compose(rotations: Iterable[Quaternion]) -> Quaternion:
    """The rotation of the last of some bones, each of which sits on the one before."""
    whole = STILL
    for rotation in rotations:
        whole = multiply(whole, rotation)
    return whole


def to_angles(rotation: Quaternion) -> Angles:
    """Turn, nod and tilt of a rotation."""
    x, y, z, w = rotation
    ahead_x, ahead_y, ahead_z = 2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)
    turn = -math.atan2(ahead_x, ahead_z)
    nod = math.asin(min(max(ahead_y, -1.0), 1.0))
    tilt = math.atan2(2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z))
    return math.degrees(turn), math.degrees(nod), math.degrees(tilt)


def from_angles(turn: float, nod: float, tilt: float = 0.0) -> Quaternion:
    """The rotation with these angles."""
    about_y = 0.0, -_half_sine(turn), 0.0, _half_cosine(turn)
    about_x = -_half_sine(nod), 0.0, 0.0, _half_cosine(nod)
    about_z = 0.0, 0.0, _half_sine(tilt), _half_cosine(tilt)
    return compose((about_y, about_x, about_z))


def halve(rotation: Quaternion) -> Quaternion:
    """The rotation that, done twice, is this one; of less than half a turn."""
    x, y, z, w = rotation
    length = math.sqrt(2.0 * (1.0 + w))
    return x / length, y / length, z / length, (1.0 + w) / length


def _half_sine(angle_deg: float) -> float:
    return math.sin(math.radians(angle_deg) / 2.0)


def _half_cosine(angle_deg: float) -> float:
    return math.cos(math.radians(angle_deg) / 2.0)
