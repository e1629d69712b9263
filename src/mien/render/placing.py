"""What ``triangles.place_mesh`` says, compiled: the same formulas in the same order, so every number is the same."""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: allow-untyped-defs, allow-untyped-calls, no-check-untyped-defs

from __future__ import annotations

import numpy as np

from mien.compiling import kernel
from mien.core.exact import GRID_M

from .triangles import BACK, FRONT, HIDDEN

CUT = 3
"""Beside what ``triangles`` says of a side: the border of the picture cuts it."""


@kernel("f8[:,:], f8[:,:], f8[:], f8[:], i8, i8, f8[:,:], f8[:,:], u1[:], i4[:,:], f8[:]")
def place_points(given, axes, position, settings, first, last, points, view, codes, places, inverse):
    """Fill rows first:last: points on their grid, in the camera's frame, planes they lie outside of, place, 1 / depth.

    ``axes`` (3, 3) are right, up and forward; ``settings`` are scale, width, height, near plane, steps a pixel, limit.
    """
    scale, near, steps, limit = settings[0], settings[3], settings[4], settings[5]
    half_width, half_height = settings[1] * 0.5, settings[2] * 0.5
    for v in range(first, last):
        for k in range(3):
            points[v, k] = np.rint(given[v, k] * (1.0 / GRID_M)) * GRID_M
        x, y, z = points[v, 0] - position[0], points[v, 1] - position[1], points[v, 2] - position[2]
        across = (x * axes[0, 0] + y * axes[0, 1]) + z * axes[0, 2]
        above = (x * axes[1, 0] + y * axes[1, 1]) + z * axes[1, 2]
        depth = (x * axes[2, 0] + y * axes[2, 1]) + z * axes[2, 2]
        view[v, 0], view[v, 1], view[v, 2] = across, above, depth
        code = 0
        if depth - near < 0.0:
            code |= 1
        if depth * half_width + across * scale < 0.0:
            code |= 2
        if depth * half_width + across * -scale < 0.0:
            code |= 4
        if depth * half_height + above * scale < 0.0:
            code |= 8
        if depth * half_height + above * -scale < 0.0:
            code |= 16
        codes[v] = code
        nearness = 1.0 / max(depth, near)
        inverse[v] = nearness
        right = half_width + (across * scale) * nearness
        down = half_height + (above * -scale) * nearness
        places[v, 0] = np.int32(np.rint(min(max(right * steps, -limit), limit)))
        places[v, 1] = np.int32(np.rint(min(max(down * steps, -limit), limit)))


@kernel("i8[:,:], u1[:], i4[:,:], b1[:], i8, i8, u1[:]")
def see_sides(triangles, codes, places, two_sided, first, last, sides):
    """Fill ``sides`` first:last: what is seen of a triangle, CUT where the picture's border cuts it."""
    for t in range(first, last):
        a, b, c = triangles[0, t], triangles[1, t], triangles[2, t]
        if codes[a] | codes[b] | codes[c]:
            sides[t] = HIDDEN if codes[a] & codes[b] & codes[c] else CUT
            continue
        ax, ay = np.int64(places[a, 0]), np.int64(places[a, 1])
        bx, by = np.int64(places[b, 0]) - ax, np.int64(places[b, 1]) - ay
        cx, cy = np.int64(places[c, 0]) - ax, np.int64(places[c, 1]) - ay
        area = bx * cy - cx * by
        sides[t] = FRONT if area < 0 else (BACK if area > 0 and two_sided[t] else HIDDEN)


@kernel("i8[:,:], i4[:,:], u1[:], i8[:], i8[:], i4[:,:], u1[:], i8[:]")
def sort_out(triangles, neighbours, sides, whole, cut, corners, borders, counts):
    """Fill ``counts`` (2,): triangles that are seen whole, and those that the picture's border cuts.

    Their numbers go to the front of ``whole`` and ``cut``; corners and borders of the whole ones to that of theirs.
    """
    seen, crossing = 0, 0
    for t in range(triangles.shape[1]):
        side = sides[t]
        if side == CUT:
            cut[crossing] = t
            crossing += 1
        elif side != HIDDEN:
            whole[seen] = t
            border = 0
            for k in range(3):
                corners[seen, k] = triangles[k, t]
                beyond = neighbours[t, k]
                border |= (1 if beyond < 0 or sides[beyond] != side else 0) << k
            borders[seen] = border
            seen += 1
    counts[0], counts[1] = seen, crossing
