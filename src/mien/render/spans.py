"""Triangles as spans of samples, compiled: set up once, sorted into horizontal bands, drawn row by row.

A sample is a depth and one number of 64 bits: red, green, blue and coverage, 16 bits each, linear. Two planes instead
of four halve the time of a short span, and a row of pixels needs no more than a look into a table at its end.
"""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: allow-untyped-defs, allow-untyped-calls, no-check-untyped-defs

from __future__ import annotations

import numpy as np

from mien.compiling import kernel

from .pixels import ONE

SLACK = 2.0**-33
"""Less than any fraction that the place of an edge can have, more than rounding can add to it."""

CENTRE = 128
"""Where the middle of a pixel lies in it, 1/256."""

COVERED = ONE << 48
"""What a sample that some triangle covers has besides its colour."""

# Columns of the shapes of triangles: the plane of 1 / depth (value at a corner, change by x, change by y), the place of
# that corner; heights of the three corners from top to bottom; the long edge and the upper one (x at their common upper
# end, change by y), and the lower one (the same).
Z, Z_X, Z_Y, ORIGIN_X, ORIGIN_Y, TOP, MIDDLE, BOTTOM, UPPER_X, LONG_SLOPE, UPPER_SLOPE, LOWER_X, LOWER_SLOPE = range(13)
SHAPE_COLUMNS = 13

# Columns of their frames: the rows of pixels that they touch, the one behind the last, the same of columns, and 1 where
# the long edge is the right one.
FIRST_ROW, END_ROW, FIRST_COLUMN, END_COLUMN, LONG_RIGHT = range(5)
FRAME_COLUMNS = 5


@kernel("i4[:,:], f8[:], i4[:,:], f8[:,:], i4[:,:], i8, i8, f8[:,:], i4[:,:], f4[:,:]")
def set_up(places, inverse, corners, values, value_of, first, last, shapes, frames, planes):
    """Fill ``shapes`` (T, 13), ``frames`` (T, 5), ``planes`` (T, 3 K) for triangles first:last.

    Planes are those of each value over depth, which is linear on the screen where the value is not: at corner a, change
    by x, change by y, in 1/256 pixels;
    single precision is enough for them. Source: Blinn 1992 (perspective-correct interpolation).
    """
    for t in range(first, last):
        i, j, k = corners[t, 0], corners[t, 1], corners[t, 2]
        iax, iay = np.int64(places[i, 0]), np.int64(places[i, 1])
        ibx, iby = np.int64(places[j, 0]), np.int64(places[j, 1])
        icx, icy = np.int64(places[k, 0]), np.int64(places[k, 1])
        ax, ay, bx, by, cx, cy = float(iax), float(iay), float(ibx), float(iby), float(icx), float(icy)
        share = 1.0 / ((bx - ax) * (cy - ay) - (cx - ax) * (by - ay))
        x_of_b, x_of_c = (cy - ay) * share, (by - ay) * share
        y_of_b, y_of_c = (cx - ax) * share, (bx - ax) * share
        at_a, at_b, at_c = inverse[i], inverse[j], inverse[k]
        along, across = at_b - at_a, at_c - at_a
        shapes[t, Z] = at_a
        shapes[t, Z_X] = along * x_of_b - across * x_of_c
        shapes[t, Z_Y] = across * y_of_c - along * y_of_b
        shapes[t, ORIGIN_X], shapes[t, ORIGIN_Y] = ax, ay
        at, bt, ct = value_of[t, 0], value_of[t, 1], value_of[t, 2]
        for v in range(values.shape[1]):
            value = values[at, v] * at_a
            along, across = values[bt, v] * at_b - value, values[ct, v] * at_c - value
            planes[t, 3 * v] = value
            planes[t, 3 * v + 1] = along * x_of_b - across * x_of_c
            planes[t, 3 * v + 2] = across * y_of_c - along * y_of_b
        if iby < iay:
            iax, iay, ibx, iby = ibx, iby, iax, iay
        if icy < iay:
            iax, iay, icx, icy = icx, icy, iax, iay
        if icy < iby:
            ibx, iby, icx, icy = icx, icy, ibx, iby
        ax, ay, bx, by, cx, cy = float(iax), float(iay), float(ibx), float(iby), float(icx), float(icy)
        shapes[t, TOP], shapes[t, MIDDLE], shapes[t, BOTTOM] = ay, by, cy
        shapes[t, UPPER_X], shapes[t, LOWER_X] = ax, bx
        shapes[t, LONG_SLOPE] = (cx - ax) / (256.0 * (cy - ay))
        shapes[t, UPPER_SLOPE] = (bx - ax) / (256.0 * (by - ay)) if by > ay else 0.0
        shapes[t, LOWER_SLOPE] = (cx - bx) / (256.0 * (cy - by)) if cy > by else 0.0
        frames[t, FIRST_ROW], frames[t, END_ROW] = iay >> 8, (icy >> 8) + 1
        frames[t, FIRST_COLUMN] = min(iax, min(ibx, icx)) >> 8
        frames[t, END_COLUMN] = (max(iax, max(ibx, icx)) >> 8) + 1
        frames[t, LONG_RIGHT] = 1 if (ibx - iax) * (icy - iay) < (icx - iax) * (iby - iay) else 0


@kernel("i4[:,:], i8, i8, i8, i8[:]")
def count_bands(frames, height, band_rows, apron, counts):
    """Turn zeros into places in one list of triangles: band b has its entries ``counts[b]:counts[b + 1]``.

    A band also draws ``apron`` rows above and below it.
    """
    for t in range(len(frames)):
        top, end = max(frames[t, FIRST_ROW] - apron, 0), min(frames[t, END_ROW] + apron, height)
        if top < end:
            for b in range(top // band_rows, (end - 1) // band_rows + 1):
                counts[b + 1] += 1
    for b in range(len(counts) - 1):
        counts[b + 1] += counts[b]


@kernel("i4[:,:], i8, i8, i8, i8[:], i4[:]")
def sort_bands(frames, height, band_rows, apron, following, members):
    """Fill the list that ``count_bands`` measured, triangles in their order; ``following`` is a copy of the places."""
    for t in range(len(frames)):
        top, end = max(frames[t, FIRST_ROW] - apron, 0), min(frames[t, END_ROW] + apron, height)
        if top < end:
            for b in range(top // band_rows, (end - 1) // band_rows + 1):
                members[following[b]] = t
                following[b] += 1


@kernel()
def first_sample(x, slope, down, offset):
    """First column whose sample is not left of an edge; exact.

    The edge passes x, ``down`` above the row of the samples, all in 1/256 pixels; samples lie ``offset`` right of the
    left side of their pixel. The quotient is q = ((x - offset) + down across / along) / 256 for whole numbers whose
    products stay below 2^53. |q| < 2^15, so that the sum below is wrong by less than 2^-35; yet a q that is not whole
    is at least 2^-31 away from one that is.
    """
    return int(np.ceil((x - offset) * (1.0 / 256.0) + down * slope - SLACK))


@kernel()
def find_span(shape, long_right, y, offset, width):
    """First column of a span at height y, 1/256 pixels, whose samples lie at ``offset``, and the one behind its last.

    ``shape`` is the part of a triangle's from TOP on.
    """
    top, middle, _, upper_x, long_slope, upper_slope, lower_x, lower_slope = shape
    far = first_sample(upper_x, long_slope, y - top, offset)
    if y < middle:
        near = first_sample(upper_x, upper_slope, y - top, offset)
    else:
        near = first_sample(lower_x, lower_slope, y - middle, offset)
    left, right = (near, far) if long_right else (far, near)
    return max(left, 0), min(right, width)


@kernel()
def outline(shapes, t):
    """The part of a triangle's shape from TOP on, as numbers: where samples are written, arrays are read anew."""
    return (
        shapes[t, TOP], shapes[t, MIDDLE], shapes[t, BOTTOM], shapes[t, UPPER_X], shapes[t, LONG_SLOPE],
        shapes[t, UPPER_SLOPE], shapes[t, LOWER_X], shapes[t, LOWER_SLOPE],
    )  # fmt: skip


@kernel()
def plane(planes, t, v):
    """The plane of a value of a triangle, as numbers: at corner a, change by x, change by y, change by a pixel."""
    return planes[t, v], planes[t, v + 1], planes[t, v + 2], np.float32(planes[t, v + 1] * 256.0)


@kernel()
def at_sample(plane, dx, dy):
    """A value at a distance from corner a, 1/256 pixels."""
    return np.float32((plane[0] + plane[2] * dy) + plane[1] * dx)


@kernel()
def pack(red, green, blue, top):
    """A sample that is covered: three values of 0..top in one number."""
    zero = np.float32(0.0)
    r = np.uint64(np.int32(min(max(red, zero), top)))
    g = np.uint64(np.int32(min(max(green, zero), top)))
    b = np.uint64(np.int32(min(max(blue, zero), top)))
    return r | (g << np.uint64(16)) | (b << np.uint64(32)) | np.uint64(COVERED)


@kernel()
def draw_triangle(shapes, frames, planes, group, t, top, end, width, limit, depth, color):
    """Draw triangle t, with the three values from ``group`` on, into the samples at the centres of rows top:end."""
    shape, long_right = outline(shapes, t), frames[t, LONG_RIGHT] == 1
    origin_x, origin_y = shapes[t, ORIGIN_X], shapes[t, ORIGIN_Y]
    nearness, red = plane(shapes, t, Z), plane(planes, t, group)
    green, blue = plane(planes, t, group + 3), plane(planes, t, group + 6)
    dz, dr, dg, db = nearness[3], red[3], green[3], blue[3]
    for row in range(max(frames[t, FIRST_ROW], top), min(frames[t, END_ROW], end)):
        y = float(row * 256 + CENTRE)
        if y < shape[0] or y >= shape[2]:
            continue
        left, right = find_span(shape, long_right, y, CENTRE, width)
        count = right - left
        if count <= 0:
            continue
        dx, dy = float(left * 256 + CENTRE) - origin_x, y - origin_y
        z0, dx, dy = at_sample(nearness, dx, dy), np.float32(dx), np.float32(dy)
        r0, g0, b0 = at_sample(red, dx, dy), at_sample(green, dx, dy), at_sample(blue, dx, dy)
        first, wanted = np.uint64((row - top) * width + left), np.int32(count)
        # Whole steps of four, the last of them half in vain, are faster than a remainder: there is room behind the end.
        for x in range(np.uint64((count + 3) & ~3)):
            i = first + np.uint64(x)
            step = np.float32(np.int32(x))
            z = z0 + dz * step
            if (np.int32(x) < wanted) & (z > depth[i]):
                scale = np.float32(1.0) / z
                depth[i] = z
                color[i] = pack((r0 + dr * step) * scale, (g0 + dg * step) * scale, (b0 + db * step) * scale, limit)
