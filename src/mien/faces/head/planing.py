"""The classic skin's polygons stay nearly plane where it is smooth, whatever a pose and a shape ask.

Flat shading shows each polygon as one facet, which only a plane one is. The diagonals of a plane quadrilateral cross;
those of a bent one pass each other at a gap. Polygon after polygon, pairs of corners go against one another along the
normal until the gap is small, and again from the other end of the face. Where neighbours ask for different things they
meet in between. A polygon whose diagonals pass beside each other is twisted: its corners go towards a parallelogram.
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

LOOKS, SWEEPS = 8, 15
"""How often it is looked where normals point and what gaps are small, and how often all polygons act on one look.

Within a look each act is a projection on what is plane enough, so that two poses end no farther apart than they began:
rounding stays rounding. Looking before each act leaves fewer polygons bent, but multiplies rounding by up to 10^9.
"""

EAGER = 1.6
"""A polygon goes past its aim by as much, which neighbours take back: below 2, and in the end none has to move."""

SOUND = 0.15
"""Where the diagonals of a sound polygon cross, one of them at least has so much of its length on either side."""

THIN = 0.3
"""Sine of the angle between diagonals below which a normal counts less, to nothing where there is none."""

ALMOST_OUT = 0.05
"""Product of both shares of a diagonal that counts where it is less, or where the diagonals pass beside each other."""


STILL = (0.0, 0.0, 0.0)


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
def way(skin, start, end):
    """From one vertex of the skin (S, 3) m to another."""
    return skin[end, 0] - skin[start, 0], skin[end, 1] - skin[start, 1], skin[end, 2] - skin[start, 2]


@kernel()
def scaled(vector, scale):
    """A vector with each number times that of a scale."""
    return vector[0] * scale[0], vector[1] * scale[1], vector[2] * scale[2]


@kernel()
def look_at_polygon(skin, corners, scale, normal, rule):
    """Fill in how a polygon (4,) of the skin (S, 3) m lies.

    Args:
        skin: (S, 3) m.
        corners: vertices of the polygon.
        scale: (3,) of the head, which bends polygons more or less.
        normal: (3,), filled with its unit normal, which is shorter where it is too thin to tell.
        rule: (2..,), filled with twice the gap of its diagonals that is small enough, m, and how twisted it is, 0..1.
    """
    one, other = way(skin, corners[0], corners[2]), way(skin, corners[1], corners[3])
    side, across = way(skin, corners[0], corners[1]), cross(one, other)
    size = np.sqrt(dot(across, across))
    normal[0], normal[1], normal[2], rule[0], rule[1] = 0.0, 0.0, 0.0, 0.0, 1.0
    if size == 0.0:
        return
    plain = share(size / (np.sqrt(dot(one, one) * dot(other, other)) * THIN))
    for axis in range(3):
        normal[axis] = plain * across[axis] / size
    # Seen along the normal, the diagonals cross after these shares of their lengths.
    of_one = dot(cross(side, other), across) / (size * size)
    of_other = dot(cross(side, one), across) / (size * size)
    # Folded along a diagonal, both triangles turn by the gap over their heights; a scale keeps ratios of volumes.
    wide, tall = scaled(one, scale), scaled(other, scale)
    area = cross(wide, tall)
    by_one = np.sqrt(dot(wide, wide)) / max(of_other * (1.0 - of_other), ALMOST_OUT)
    by_other = np.sqrt(dot(tall, tall)) / max(of_one * (1.0 - of_one), ALMOST_OUT)
    rule[0] = 2.0 * MOST * dot(area, area) / (scale[0] * scale[1] * scale[2] * size * min(by_one, by_other))
    crossing = max(min(of_one, 1.0 - of_one), min(of_other, 1.0 - of_other))
    rule[1] = 1.0 - plain * min(crossing / SOUND, 1.0) if crossing > 0.0 else 1.0


@kernel()
def step_to_plane(skin, corners, free, normal, rule):
    """How far the first and the third corner of a polygon (4,) go, and the other two against them, m.

    Args:
        skin: (S, 3) m.
        corners: vertices of the polygon.
        free: of ``Planes``.
        normal: rule: of ``look_at_polygon``.
    """
    a, b, c, d = corners[0], corners[1], corners[2], corners[3]
    room = free[a] + free[b] + free[c] + free[d]
    # In a parallelogram two opposite corners have the sum of the others.
    x = skin[b, 0] + skin[d, 0] - skin[a, 0] - skin[c, 0]
    y = skin[b, 1] + skin[d, 1] - skin[a, 1] - skin[c, 1]
    z = skin[b, 2] + skin[d, 2] - skin[a, 2] - skin[c, 2]
    rise, twist = dot((x, y, z), normal), rule[1]
    excess = max(rise - rule[0], 0.0) + min(rise + rule[0], 0.0)
    if room == 0.0 or (excess == 0.0 and twist == 0.0):
        return STILL
    up, aside = (EAGER * excess - twist * rise) / room, twist / room
    return up * normal[0] + aside * x, up * normal[1] + aside * y, up * normal[2] + aside * z


@kernel()
def shift(skin, corners, free, step):
    """Move the corners of a polygon in the skin (S, 3) m by turns along a step and against it, as they are free."""
    sign = 1.0
    for k in range(4):
        for axis in range(3):
            skin[corners[k], axis] += sign * free[corners[k]] * step[axis]
        sign = -sign


@kernel()
def sweep_skin(skin, pairs, free, normals, rules, backwards):
    """Whether any polygon still moved points of the skin (S, 3) m, each pair after the other."""
    moved = False
    for n in range(len(pairs)):
        k = len(pairs) - 1 - n if backwards else n
        left, right = pairs[k, 0], pairs[k, 1]
        # Both halves look before either moves, so that mirrored poses stay mirrored where they touch.
        on_left = step_to_plane(skin, left, free, normals[2 * k], rules[2 * k])
        on_right = step_to_plane(skin, right, free, normals[2 * k + 1], rules[2 * k + 1])
        if on_left != STILL or on_right != STILL:
            moved = True
            shift(skin, left, free, on_left)
            shift(skin, right, free, on_right)
    return moved


@kernel()
def plane_skin(skin, pairs, free, scale, normals, rules):
    """Change the skin (S, 3) m until its polygons are nearly plane once the head has its ``scale``.

    Args:
        skin: changed.
        pairs: free: of ``Planes``.
        scale: (3,) of the head.
        normals: (2 K.., 3), overwritten.
        rules: (2 K.., 2..), overwritten.
    """
    for _ in range(LOOKS if len(pairs) else 0):
        for k in range(len(pairs)):
            for side in range(2):
                look_at_polygon(skin, pairs[k, side], scale, normals[2 * k + side], rules[2 * k + side])
        sweep, going = 0, True
        while going and sweep < SWEEPS:
            going = sweep_skin(skin, pairs, free, normals, rules, sweep % 2 == 1)
            sweep += 1
        if sweep == 1 and not going:
            break
