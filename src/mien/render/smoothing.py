"""Smooth edges, compiled: where one sample a pixel is not enough, and four more for those pixels alone.

A pixel is marked when the border of something runs through it: an edge between a triangle that is seen and one that is
not, or of another part or colour; or when the depth has a kink there, where one surface pierces another without an
edge: an eyeball its lid, a tooth a lip.
"""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: allow-untyped-defs, allow-untyped-calls, no-check-untyped-defs

from __future__ import annotations

import numpy as np

from mien.compiling import kernel

from .reference import BEND, HIDDEN_PX
from .spans import (
    END_COLUMN,
    END_ROW,
    FIRST_COLUMN,
    FIRST_ROW,
    ORIGIN_X,
    ORIGIN_Y,
    Z,
    at_sample,
    pack,
    plane,
)


@kernel()
def mark_edges(places, inverse, corners, borders, t, top, end, scale, depth, marks):
    """Mark in rows top:end the pixels that those edges of triangle t touch that are borders and not hidden."""
    for k in range(3):
        if (borders[t] >> k) & 1:
            i, j = corners[t, k], corners[t, (k + 1) % 3]
            ax, ay = np.int64(places[i, 0]), np.int64(places[i, 1])
            bx, by = np.int64(places[j, 0]), np.int64(places[j, 1])
            nearest = max(inverse[i], inverse[j])
            if by < ay:
                ax, ay, bx, by = bx, by, ax, ay
            for row in range(max(ay >> 8, top), min(by >> 8, end - 1) + 1):
                first, last = ax, bx
                if by > ay:
                    first = ax + (max(row << 8, ay) - ay) * (bx - ax) // (by - ay)
                    last = ax + (min((row + 1) << 8, by) - ay) * (bx - ax) // (by - ay)
                width = marks.shape[1]
                for x in range(max(min(first, last) >> 8, 0), min(max(first, last) >> 8, width - 1) + 1):
                    if (float(depth[(row - top) * width + x]) - nearest) * scale <= HIDDEN_PX * nearest:
                        marks[row - top, x] = 1


@kernel()
def mark_kinks(upper, middle, lower, scale, marks):
    """Mark pixels of a row of 1 / depth, between two others, where the surface turns too much."""
    zero, one, most = np.float32(0.0), np.float32(1.0), np.float32(BEND)
    inside = len(marks) - 2
    left, right, here = middle[:inside], middle[2:], middle[1 : inside + 1]
    above, below, out = upper[1 : inside + 1], lower[1 : inside + 1], marks[1 : inside + 1]
    for x in range(inside):
        z = here[x]
        size = scale / z
        rise, further = (z - left[x]) * size, (right[x] - z) * size
        across = (np.abs(further - rise) > most * (one + rise * further)) & (left[x] > zero) & (right[x] > zero)
        rise, further = (z - above[x]) * size, (below[x] - z) * size
        along = (np.abs(further - rise) > most * (one + rise * further)) & (above[x] > zero) & (below[x] > zero)
        out[x] |= np.uint8((z > zero) & (across | along))


@kernel()
def list_marks(marks, rows, first, last, columns, before):
    """Number of marks in columns first:last, which are removed.

    Fills their ``columns``, row by row, and how many are ``before`` each pixel of those columns, (rows, W + 1).
    """
    count = 0
    for row in range(rows):
        for x in range(first, last):
            before[row, x] = count
            if marks[row, x]:
                columns[count] = x
                count += 1
                marks[row, x] = 0
        before[row, last] = count
    return count


@kernel()
def edge(px, py, qx, qy):
    """What grows to the inside of an edge that runs clockwise on the screen: by x, by y, and where both are 0.

    It is 0 or more where a sample belongs to the triangle: whole numbers, in 1/256 pixels, as in ``reference``.
    """
    dx, dy = qx - px, qy - py
    owned = dy < 0 or (dy == 0 and dx > 0)
    return -dy, dx, dy * px - dx * py - (0 if owned else 1)


@kernel()
def reach(side):
    """How much more than at the corner of a pixel it can be at a sample in it."""
    return 255 * (max(side[0], 0) + max(side[1], 0))


@kernel()
def draw_samples(
    places, corners, shapes, frames, planes, group, t, top, end, first, last, limit, before, columns, depth, color
):
    """Draw triangle t into the four samples (K, 4) of the pixels that are marked in rows top:end, columns first:last.

    These pixels are few and their triangles often smaller than they are: each is asked on its own.
    """
    left, right = max(frames[t, FIRST_COLUMN], first), min(frames[t, END_COLUMN], last)
    if left >= right:
        return
    first_row, end = max(frames[t, FIRST_ROW], top), min(frames[t, END_ROW], end)
    while first_row < end and before[first_row - top, left] == before[first_row - top, right]:
        first_row += 1
    if first_row >= end:
        return
    i, j, k = corners[t, 0], corners[t, 1], corners[t, 2]
    ax, ay = np.int64(places[i, 0]), np.int64(places[i, 1])
    bx, by = np.int64(places[j, 0]), np.int64(places[j, 1])
    cx, cy = np.int64(places[k, 0]), np.int64(places[k, 1])
    if (bx - ax) * (cy - ay) < (cx - ax) * (by - ay):
        bx, by, cx, cy = cx, cy, bx, by
    ab, bc, ca = edge(ax, ay, bx, by), edge(bx, by, cx, cy), edge(cx, cy, ax, ay)
    reach_ab, reach_bc, reach_ca = reach(ab), reach(bc), reach(ca)
    origin_x, origin_y = shapes[t, ORIGIN_X], shapes[t, ORIGIN_Y]
    nearness, red = plane(shapes, t, Z), plane(planes, t, group)
    green, blue = plane(planes, t, group + 3), plane(planes, t, group + 6)
    for row in range(first_row, end):
        for n in range(before[row - top, left], before[row - top, right]):
            x, y = np.int64(columns[n]) << 8, np.int64(row) << 8
            in_ab = ab[2] + ab[0] * x + ab[1] * y
            in_bc = bc[2] + bc[0] * x + bc[1] * y
            in_ca = ca[2] + ca[0] * x + ca[1] * y
            if min(min(in_ab + reach_ab, in_bc + reach_bc), in_ca + reach_ca) < 0:
                continue
            for sample in range(4):
                # ``OFFSETS``, which would be looked up: a jump that no processor foresees.
                to_x, to_y = (96 + 128 * sample - 64 * (sample >> 1)) & 255, 32 + 64 * sample
                at_ab = in_ab + ab[0] * to_x + ab[1] * to_y
                at_bc = in_bc + bc[0] * to_x + bc[1] * to_y
                at_ca = in_ca + ca[0] * to_x + ca[1] * to_y
                if min(min(at_ab, at_bc), at_ca) < 0:
                    continue
                dx, dy = float(x + to_x) - origin_x, float(y + to_y) - origin_y
                z = at_sample(nearness, dx, dy)
                if z > depth[n, sample]:
                    dx, dy, scale = np.float32(dx), np.float32(dy), np.float32(1.0) / z
                    r, g, b = at_sample(red, dx, dy), at_sample(green, dx, dy), at_sample(blue, dx, dy)
                    depth[n, sample] = z
                    color[n, sample] = pack(r * scale, g * scale, b * scale, limit)


@kernel()
def average(samples, k):
    """The mean of four samples, each of its four values rounded to the nearest."""
    low = np.uint64(0x0000FFFF0000FFFF)
    even = odd = np.uint64(0x0000000200000002)
    for s in range(4):
        even += samples[k, s] & low
        odd += (samples[k, s] >> np.uint64(16)) & low
    return ((even >> np.uint64(2)) & low) | (((odd >> np.uint64(2)) & low) << np.uint64(16))
