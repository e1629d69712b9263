"""The classic skin's polygons stay nearly plane where it is smooth, whatever a pose and a shape ask.

Flat shading shows each polygon as one facet, which only a plane one is. The diagonals of a plane quadrilateral cross;
those of a bent one pass each other at a gap. Polygon after polygon, pairs of corners go against one another along the
normal until the gap is small, and again from the other end of the face, as often as it takes up to ``SWEEPS``. Where
neighbours ask for different things they meet in between. A polygon whose diagonals pass beside each other is twisted:
its corners go towards a parallelogram as well.
"""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.compiling import kernel
from mien.core.mesh import Ints

from .angles import share
from .measured import Archive, Floats, Kind
from .units import DEG
from .vectors import cross

MOST = 5.75 * DEG
"""What a polygon may bend, radians; at rest none bends by more, so that a face at rest stays as it is measured."""

LEAST = 4.5 * DEG
"""One that bends by more is bent by as much less than that, down to this, so that it does not come near it for ever."""

SWEEPS = 120

EAGER = 1.3
"""A polygon goes past its aim by as much: neighbours draw it back."""

SOUND = 0.15
"""Where the diagonals of a sound polygon cross, one of them at least has so much of its length on either side."""

STILL = (0.0, 0.0, 0.0)

ALMOST_OUT = 0.01
"""Product of both shares of a diagonal that counts where it is less, or where the diagonals pass beside each other."""


@dataclass(frozen=True, eq=False)
class Planes:
    """The polygons that stay plane.

    Attributes:
        pairs: (K, 2, 4) vertices of a polygon of the left half, and of its mirror image.
        free: (S,) 0..1 how readily a vertex moves for that.
    """

    pairs: Ints
    free: Floats


def planes_of(archive: Archive, kind: Kind) -> Planes:
    """Those of a skin; a cage has none, as subdivision makes it smooth.

    Ears, lips, lids, nostrils and the inside of the mouth stay as they are: what meets there goes on meeting. Elsewhere
    the share of the polygons around a vertex that are to be plane says how freely it moves.
    """
    left, mirror = archive.ints("plane_quads"), archive.mirror
    pairs, count = np.stack([left, mirror[left]], axis=1), len(mirror)
    fixed = archive.quads[archive.groups != archive.group_names.index("skin")]
    free = np.bincount(pairs.ravel(), minlength=count) / np.bincount(archive.quads.ravel(), minlength=count)
    free[fixed], free[archive.ints("lid_index")] = 0.0, 0.0
    return Planes(pairs if kind == "surface" else pairs[:0], free)


@kernel()
def dot(a, b):
    """The product of two vectors, each three numbers."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel()
def way(skin, start, end, scale):
    """From one vertex of the skin (S, 3) m to another, scaled, m."""
    x, y, z = skin[end, 0] - skin[start, 0], skin[end, 1] - skin[start, 1], skin[end, 2] - skin[start, 2]
    return x * scale[0], y * scale[1], z * scale[2]


@kernel()
def step_to_plane(skin, corners, free, scale):
    """How far the first and the third corner of a polygon (4,) go, and the other two against them, m.

    Args:
        skin: (S, 3) m.
        corners: vertices of the polygon.
        free: of ``Planes``.
        scale: (3,) of the head, which bends polygons more or less.
    """
    one, other = way(skin, corners[0], corners[2], scale), way(skin, corners[1], corners[3], scale)
    side, normal = way(skin, corners[0], corners[1], scale), cross(one, other)
    room, size = free[corners[0]] + free[corners[1]] + free[corners[2]] + free[corners[3]], dot(normal, normal)
    if room == 0.0 or size == 0.0:
        return STILL
    # In a parallelogram two opposite corners have the sum of the others.
    x, y, z = other[0] - one[0] + 2.0 * side[0], other[1] - one[1] + 2.0 * side[1], other[2] - one[2] + 2.0 * side[2]
    rise = dot((x, y, z), normal) / size
    # Seen along the normal, the diagonals cross after these shares of their lengths.
    of_one, of_other = dot(cross(side, other), normal) / size, dot(cross(side, one), normal) / size
    by_one = np.sqrt(dot(one, one)) / max(of_other * (1.0 - of_other), ALMOST_OUT)
    by_other = np.sqrt(dot(other, other)) / max(of_one * (1.0 - of_one), ALMOST_OUT)
    bend = 0.5 * abs(rise) * min(by_one, by_other)
    flatter = 1.0 - max(2.0 * MOST - bend, LEAST) / bend if bend > MOST else 0.0
    crossing = max(min(of_one, 1.0 - of_one), min(of_other, 1.0 - of_other))
    sounder = share(1.0 - crossing / SOUND)
    part, up = sounder * EAGER / room, (flatter - sounder) * rise * EAGER / room
    return (
        (part * x + up * normal[0]) / scale[0],
        (part * y + up * normal[1]) / scale[1],
        (part * z + up * normal[2]) / scale[2],
    )


@kernel()
def shift(skin, corners, free, step):
    """Move the corners of a polygon in the skin (S, 3) m by turns along a step and against it, as they are free."""
    sign = 1.0
    for k in range(4):
        for axis in range(3):
            skin[corners[k], axis] += sign * free[corners[k]] * step[axis]
        sign = -sign


@kernel()
def plane_skin(skin, pairs, free, scale, times):
    """Change the skin (S, 3) m until its polygons are nearly plane once the head has its ``scale``.

    Args:
        skin: changed.
        pairs: free: of ``Planes``.
        scale: (3,) of the head.
        times: (2, S), overwritten: when each vertex has moved last, and when each pair was looked at.
    """
    if len(pairs) == 0:
        return
    moved, seen, now, last = times[0], times[1], 0.0, 0.0
    for v in range(len(moved)):
        moved[v], seen[v] = 0.0, -1.0
    for sweep in range(SWEEPS):
        for n in range(len(pairs)):
            k = n if sweep % 2 == 0 else len(pairs) - 1 - n
            left, right = pairs[k, 0], pairs[k, 1]
            newest = 0.0
            for corner in range(4):
                newest = max(newest, moved[left[corner]], moved[right[corner]])
            now += 1.0
            if newest < seen[k]:
                continue
            seen[k] = now
            # Both halves look before either moves, so that mirrored poses stay mirrored where they touch.
            on_left, on_right = step_to_plane(skin, left, free, scale), step_to_plane(skin, right, free, scale)
            if on_left == STILL and on_right == STILL:
                continue
            shift(skin, left, free, on_left)
            shift(skin, right, free, on_right)
            last = now
            for corner in range(4):
                moved[left[corner]] = moved[right[corner]] = now
        if last <= now - len(pairs):
            break
