"""The head pivots on the neck: a rotation whose angle fades from the skull to the collar."""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from mien.compiling import kernel
from mien.core import exact
from mien.core.mesh import Points

from .angles import turn
from .measured import Floats
from .vectors import unit

PIVOT = (0.0, -0.085, -0.022)
"""Where the resting head turns on its neck, m."""

BASE_Y_M, BASE_SLOPE = -0.163, -0.19
"""The neck ends on the plane y = -0.163 - 0.19 z, where the collar sits."""

RIGID_ABOVE_M = 0.055


def neck_share(points: Points) -> Floats:
    """(V,) share of the head's rotation: 0 at the collar, 1 from the chin up."""
    height = points[:, 1] - (BASE_Y_M + BASE_SLOPE * points[:, 2])
    return exact.smoothstep(height / RIGID_ABOVE_M)


@kernel()
def turn_point(x, y, z, angles):
    """A point about the pivot tilted, nodded, then turned; ``angles`` are turn, nod and tilt, radians."""
    turned, nodded, tilted = angles
    x, y = turn(x, y, -tilted)
    y, z = turn(y, z, -nodded)
    z, x = turn(z, x, turned)
    return x, y, z


@kernel()
def turn_back(place, angles, pivot, forward):
    """A place in the room, m, as the turned head sees it that slid ``forward`` m: the inverse of ``turn_head``."""
    turned, nodded, tilted = angles
    if turned == 0.0 and nodded == 0.0 and tilted == 0.0:
        return place[0], place[1], place[2] - forward
    x, y, z = place[0] - pivot[0], place[1] - pivot[1], place[2] - pivot[2] - forward
    z, x = turn(z, x, -turned)
    y, z = turn(y, z, nodded)
    x, y = turn(x, y, tilted)
    return x + pivot[0], y + pivot[1], z + pivot[2]


@kernel()
def turn_axes(angles):
    """Where the three steps take the axes x, y and z."""
    x = turn_point(1.0, 0.0, 0.0, angles)
    y = turn_point(0.0, 1.0, 0.0, angles)
    z = turn_point(0.0, 0.0, 1.0, angles)
    return x, y, z


@kernel()
def turn_directions(directions, axes):
    """Turn directions (N, 3) with the head; ``axes`` are those of ``turn_axes``."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = axes
    for n in range(len(directions)):
        x, y, z = directions[n, 0], directions[n, 1], directions[n, 2]
        directions[n, 0] = ax * x + bx * y + cx * z
        directions[n, 1] = ay * x + by * y + cy * z
        directions[n, 2] = az * x + bz * y + cz * z


@kernel()
def turn_head(points, share, axes, angles, pivot, forward):
    """Tilt, nod, then turn points (V, 3) m about the neck's ``pivot``, m, and slide them ``forward`` m.

    Each goes its ``share`` (V,) of the way.
    """
    turned, nodded, tilted = angles
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = axes
    for v in range(len(points)):
        if share[v] == 0.0:
            continue
        x, y, z = points[v, 0] - pivot[0], points[v, 1] - pivot[1], points[v, 2] - pivot[2]
        if share[v] >= 1.0:
            points[v, 0] = ax * x + bx * y + cx * z + pivot[0]
            points[v, 1] = ay * x + by * y + cy * z + pivot[1]
            points[v, 2] = az * x + bz * y + cz * z + pivot[2] + forward
        else:
            part = share[v]
            x, y, z = turn_point(x, y, z, (turned * part, nodded * part, tilted * part))
            points[v, 0], points[v, 1], points[v, 2] = x + pivot[0], y + pivot[1], z + pivot[2] + part * forward


@kernel()
def scale_all(points, eyes, scale):
    """Scale points (V, 3) m about the middle of the head, and the normals (E, 3) of both eyes to fit."""
    for v in range(len(points)):
        for axis in range(3):
            points[v, axis] *= scale[axis]
    for eye in eyes:
        for v in range(len(eye)):
            x, y, z = eye[v, 0] / scale[0], eye[v, 1] / scale[1], eye[v, 2] / scale[2]
            eye[v, 0], eye[v, 1], eye[v, 2] = unit(x, y, z)


@kernel()
def turn_all(points, eyes, share, angles, pivot, forward):
    """Turn points (V, 3) m on the neck by their share (V,) of the angles, and the normals (E, 3) of both eyes.

    The head slides ``forward`` m as well.
    """
    axes = turn_axes(angles)
    turn_head(points, share, axes, angles, pivot, forward)
    for eye in eyes:
        turn_directions(eye, axes)
