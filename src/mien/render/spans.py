"""The fast rasteriser, compiled by Numba: triangles into horizontal bands, spans in each band, pixels at its end.

A band has its own depth and colour rows, small enough for the processor's cache, and bands know nothing of one
another: any number of threads may share them out and the picture stays the same.
"""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

import numpy as np

from mien.compiling import kernel

SLACK = 2.0**-33
"""Less than any fraction that the place of an edge can have, more than rounding can add to it."""


@kernel("i4[:,:], f8[:], i4[:,:], f8[:,:], i4[:,:], i8, i8, i8[:,:], f8[:,:,:]")
def set_up(places, inverse, corners, colors, color_of, first, last, edges, planes):
    """Fill for triangles first:last: ``edges`` (T, 10) int64 for the spans, ``planes`` (T, 5, 3) float64.

    An edges row: first row, row where the middle corner lies, end row, whether the long edge is the right one, then
    the three corners from top to bottom. Planes, of 1 / depth and of colour over depth: value at corner a, change by
    x, change by y, in 1/256 pixels; the last row is corner a.
    """
    for t in range(first, last):
        i, j, k = corners[t, 0], corners[t, 1], corners[t, 2]
        iax, iay = np.int64(places[i, 0]), np.int64(places[i, 1])
        ibx, iby = np.int64(places[j, 0]), np.int64(places[j, 1])
        icx, icy = np.int64(places[k, 0]), np.int64(places[k, 1])
        ax, ay, bx, by, cx, cy = float(iax), float(iay), float(ibx), float(iby), float(icx), float(icy)
        area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
        for v in range(4):
            at_a, at_b, at_c = inverse[i], inverse[j], inverse[k]
            if v > 0:
                at_a = colors[color_of[t, 0], v - 1] * at_a
                at_b = colors[color_of[t, 1], v - 1] * at_b
                at_c = colors[color_of[t, 2], v - 1] * at_c
            along, across = at_b - at_a, at_c - at_a
            planes[t, v, 0] = at_a
            planes[t, v, 1] = (along * (cy - ay) - across * (by - ay)) / area
            planes[t, v, 2] = (across * (bx - ax) - along * (cx - ax)) / area
        planes[t, 4, 0], planes[t, 4, 1], planes[t, 4, 2] = ax, ay, 0.0
        if iby < iay:
            iax, iay, ibx, iby = ibx, iby, iax, iay
        if icy < iay:
            iax, iay, icx, icy = icx, icy, iax, iay
        if icy < iby:
            ibx, iby, icx, icy = icx, icy, ibx, iby
        edges[t, 0] = (iay + 127) >> 8
        edges[t, 1] = (iby + 127) >> 8
        edges[t, 2] = (icy + 127) >> 8
        edges[t, 3] = 1 if (ibx - iax) * (icy - iay) < (icx - iax) * (iby - iay) else 0
        edges[t, 4], edges[t, 5], edges[t, 6] = iax, iay, ibx
        edges[t, 7], edges[t, 8], edges[t, 9] = iby, icx, icy


@kernel("i8[:,:], i8, i8, i8[:]")
def count_bands(edges, height, band_rows, counts):
    """Turn zeros into places in one list of triangles: band b has its entries ``counts[b]:counts[b + 1]``."""
    for t in range(len(edges)):
        top, end = max(edges[t, 0], 0), min(edges[t, 2], height)
        if top < end:
            for b in range(top // band_rows, (end - 1) // band_rows + 1):
                counts[b + 1] += 1
    for b in range(len(counts) - 1):
        counts[b + 1] += counts[b]


@kernel("i8[:,:], i8, i8, i8[:], i8[:]")
def sort_bands(edges, height, band_rows, following, members):
    """Fill the list that ``count_bands`` measured, triangles in their order; ``following`` is a copy of the places."""
    for t in range(len(edges)):
        top, end = max(edges[t, 0], 0), min(edges[t, 2], height)
        if top < end:
            for b in range(top // band_rows, (end - 1) // band_rows + 1):
                members[following[b]] = t
                following[b] += 1


@kernel()
def _first_centre(ax, ay, across, inverse, centre):
    """First column whose centre, in the row of that centre, is not left of an edge through a; exact.

    The quotient is q = ((ax - 128) down + (centre - ay) across) / (256 down), all of them whole numbers whose
    products stay below 2^53; ``across`` is the edge's own, ``inverse`` is 1 / (256 down). |q| < 2^15, so that the
    product below is wrong by less than 2^-35; yet a q that is not whole is at least 2^-31 away from one that is.
    """
    return int(np.ceil((centre - ay) * across * inverse + (ax - 128.0) * (1.0 / 256.0) - SLACK))


@kernel()
def _draw_triangle(edges, planes, t, top, end, width, depth, red, green, blue):
    """Draw rows top:end of triangle t.

    The sample planes are flat here and their places unsigned: Numba then drops its test for negative indices.
    """
    ax, ay, bx = float(edges[t, 4]), float(edges[t, 5]), float(edges[t, 6])
    by, cx, cy = float(edges[t, 7]), float(edges[t, 8]), float(edges[t, 9])
    long_inverse, upper_inverse, lower_inverse = 1.0 / (256.0 * (cy - ay)), 0.0, 0.0
    if by > ay:
        upper_inverse = 1.0 / (256.0 * (by - ay))
    if cy > by:
        lower_inverse = 1.0 / (256.0 * (cy - by))
    long_right = edges[t, 3] == 1
    middle = edges[t, 1]
    one = np.float32(1.0)
    origin_x, origin_y = planes[t, 4, 0], planes[t, 4, 1]
    zv, zx, zy = planes[t, 0, 0], planes[t, 0, 1], planes[t, 0, 2]
    rv, rx, ry = planes[t, 1, 0], planes[t, 1, 1], planes[t, 1, 2]
    gv, gx, gy = planes[t, 2, 0], planes[t, 2, 1], planes[t, 2, 2]
    bv, bx_, by_ = planes[t, 3, 0], planes[t, 3, 1], planes[t, 3, 2]
    dz, dr = np.float32(zx * 256.0), np.float32(rx * 256.0)
    dg, db = np.float32(gx * 256.0), np.float32(bx_ * 256.0)
    for y in range(max(edges[t, 0], top), min(edges[t, 2], end)):
        centre = float(y * 256 + 128)
        far = _first_centre(ax, ay, cx - ax, long_inverse, centre)
        if y < middle:
            near = _first_centre(ax, ay, bx - ax, upper_inverse, centre)
        else:
            near = _first_centre(bx, by, cx - bx, lower_inverse, centre)
        left, right = (near, far) if long_right else (far, near)
        left, right = max(left, 0), min(right, width)
        if left >= right:
            continue
        dx, dy = float(left * 256 + 128) - origin_x, centre - origin_y
        z0, r0 = np.float32((zv + zy * dy) + zx * dx), np.float32((rv + ry * dy) + rx * dx)
        g0, b0 = np.float32((gv + gy * dy) + gx * dx), np.float32((bv + by_ * dy) + bx_ * dx)
        row = y - top
        first = np.uint64(row * width + left)
        for x in range(np.uint64(right - left)):
            i = first + np.uint64(x)
            step = np.float32(np.int32(x))
            z = z0 + dz * step
            if z > depth[i]:
                scale = one / z
                depth[i] = z
                red[i] = (r0 + dr * step) * scale
                green[i] = (g0 + dg * step) * scale
                blue[i] = (b0 + db * step) * scale


# Loops where a slice could be assigned: Numba takes ten times as long to compile an assignment to a slice.
@kernel()
def _fill(values, value):
    for x in range(len(values)):
        values[x] = value


@kernel()
def _copy(values, out):
    for x in range(len(out)):
        out[x] = values[x]


@kernel()
def _show_behind(depth, color, behind):
    for x in range(len(color)):
        color[x] = color[x] if depth[x] > np.float32(0.0) else behind


@kernel()
def _average(upper, lower, out):
    for x in range(np.uint64(len(out))):
        i = np.uint64(2) * x
        j = i + np.uint64(1)
        out[x] = ((upper[i] + upper[j]) + (lower[i] + lower[j])) * np.float32(0.25)


@kernel()
def _encode(linear, low, borders, codes):
    for x in range(np.uint64(len(codes))):
        value = min(max(linear[x], np.float32(0.0)), np.float32(1.0))
        code = low[np.uint64(np.int32(value * np.float32(16384.0)))]
        codes[x] = code + (value >= borders[np.uint64(code)])


@kernel()
def _divide(color, alpha):
    for x in range(len(color)):
        color[x] = color[x] / alpha[x] if alpha[x] > np.float32(0.0) else np.float32(0.0)


@kernel()
def _encode_alpha(alpha, codes):
    for x in range(len(codes)):
        value = min(alpha[x], np.float32(1.0)) * np.float32(255.0) + np.float32(0.5)
        codes[x] = np.uint8(np.int32(value))


@kernel()
def _pack(codes, out):
    red, green, blue, alpha = codes[0], codes[1], codes[2], codes[3]
    for x in range(np.uint64(len(out))):
        low_half = np.uint32(red[x]) | (np.uint32(green[x]) << np.uint32(8))
        out[x] = low_half | (np.uint32(blue[x]) << np.uint32(16)) | (np.uint32(alpha[x]) << np.uint32(24))


@kernel()
def _resolve_row(rows, row, width, n, first, last, behind, low, borders, means, codes, out):
    """Pixels first:last of one row, out of the n rows of samples from ``row`` on.

    One short loop after the other over the whole row, each of which becomes vector code, takes a quarter of the time
    of one loop that does everything for a pixel.
    """
    one, count = np.float32(1.0), last - first
    opaque = behind[3] == one
    for v in range(3 if opaque else 4):
        # The depth is no longer needed after the three colours: its rows then hold the alpha.
        plane = rows[(v + 1) % 4]
        for k in range(row, row + n):
            part = plane[k * width + first * n : k * width + last * n]
            if v < 3:
                _show_behind(rows[0, k * width + first * n : k * width + last * n], part, behind[v])
            else:
                for x in range(len(part)):
                    part[x] = one if part[x] > np.float32(0.0) else behind[3]
        if n == 2:
            upper, lower = row * width, (row + 1) * width
            _average(
                plane[upper + first * 2 : upper + last * 2],
                plane[lower + first * 2 : lower + last * 2],
                means[v, :count],
            )
        else:
            _copy(plane[row * width + first : row * width + last], means[v, :count])
    if opaque:
        _fill(codes[3, :count], 255)
    else:
        for v in range(3):
            _divide(means[v, :count], means[3, :count])
        _encode_alpha(means[3, :count], codes[3, :count])
    for v in range(3):
        _encode(means[v, :count], low, borders, codes[v, :count])
    _pack(codes[:, :count], out[first:last])


@kernel(
    "i8, i8, i8, i8, i8[:,:], f8[:,:,:], i8[:], i8[:], f4[:,:], f4[:,:], u1[:,:], f4[:,:], u4[:], u1[:], f4[:], u4[:,:]"
)
def draw_bands(
    start, stride, band_rows, n, edges, planes, counts, members, rows, means, codes, behind, plain, low, borders, out
):
    """Draw bands start, start + stride, … into ``out`` (H, W), packed pixels.

    ``rows`` (4, band_rows W n), ``means`` (4, W) and ``codes`` (4, W) are this thread's own.
    """
    height, width = out.shape[0] * n, out.shape[1] * n
    depth, red, green, blue = rows[0], rows[1], rows[2], rows[3]
    for b in range(start, len(counts) - 1, stride):
        top, end = b * band_rows, min((b + 1) * band_rows, height)
        _fill(depth, 0.0)
        left, right = width << 8, 0
        for m in range(counts[b], counts[b + 1]):
            t = members[m]
            left = min(left, min(edges[t, 4], edges[t, 6], edges[t, 8]))
            right = max(right, max(edges[t, 4], edges[t, 6], edges[t, 8]))
            _draw_triangle(edges, planes, t, top, end, width, depth, red, green, blue)
        # Pixels of this band that no triangle reaches are plain background.
        first, last = max(left >> 8, 0) // n, (min((right >> 8) + 1, width) + n - 1) // n
        for y in range(top // n, end // n):
            row = y * n - top
            if first >= last:
                _fill(out[y], plain[y])
                continue
            _fill(out[y, :first], plain[y])
            _fill(out[y, last:], plain[y])
            _resolve_row(rows, row, width, n, first, last, behind[y], low, borders, means, codes, out[y])
