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

from .pixels import OFFSETS
from .reference import BEND, HIDDEN_PX
from .spans import (
    END_COLUMN,
    END_ROW,
    FIRST_COLUMN,
    FIRST_ROW,
    LONG_RIGHT,
    ORIGIN_X,
    ORIGIN_Y,
    Z,
    at_sample,
    find_span,
    outline,
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
def draw_samples(shapes, frames, planes, group, t, top, end, first, last, limit, before, columns, depth, color):
    """Draw triangle t into the four samples (4, K) of the pixels that are marked in rows top:end."""
    left, right = max(frames[t, FIRST_COLUMN], first), min(frames[t, END_COLUMN], last)
    if left >= right:
        return
    first_row, end = max(frames[t, FIRST_ROW], top), min(frames[t, END_ROW], end)
    while first_row < end and before[first_row - top, left] == before[first_row - top, right]:
        first_row += 1
    if first_row >= end:
        return
    shape, long_right = outline(shapes, t), frames[t, LONG_RIGHT] == 1
    origin_x, origin_y = shapes[t, ORIGIN_X], shapes[t, ORIGIN_Y]
    nearness, red = plane(shapes, t, Z), plane(planes, t, group)
    green, blue = plane(planes, t, group + 3), plane(planes, t, group + 6)
    dz, dr, dg, db = nearness[3], red[3], green[3], blue[3]
    for row in range(first_row, end):
        found = before[row - top]
        if found[left] == found[right]:
            continue
        for sample in range(4):
            y, offset = float(row * 256 + OFFSETS[sample][1]), OFFSETS[sample][0]
            if y < shape[0] or y >= shape[2]:
                continue
            start, stop = find_span(shape, long_right, y, offset, last)
            if start >= stop or found[start] == found[stop]:
                continue
            dx, dy = float(start * 256 + offset) - origin_x, y - origin_y
            z0, dx, dy = at_sample(nearness, dx, dy), np.float32(dx), np.float32(dy)
            r0, g0, b0 = at_sample(red, dx, dy), at_sample(green, dx, dy), at_sample(blue, dx, dy)
            for k in range(found[start], found[stop]):
                step = np.float32(columns[k] - start)
                z = z0 + dz * step
                if z > depth[sample, k]:
                    scale = np.float32(1.0) / z
                    depth[sample, k] = z
                    r, g, b = (r0 + dr * step) * scale, (g0 + dg * step) * scale, (b0 + db * step) * scale
                    color[sample, k] = pack(r, g, b, limit)


@kernel()
def average(samples, k):
    """The mean of four samples, each of its four values rounded to the nearest."""
    low = np.uint64(0x0000FFFF0000FFFF)
    even = odd = np.uint64(0x0000000200000002)
    for s in range(4):
        even += samples[s, k] & low
        odd += (samples[s, k] >> np.uint64(16)) & low
    return ((even >> np.uint64(2)) & low) | (((odd >> np.uint64(2)) & low) << np.uint64(16))
