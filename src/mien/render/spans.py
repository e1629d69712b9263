"""The fast rasteriser, compiled by Numba: triangles into horizontal bands, spans in each band, pixels at its end.

A band has its own depth and colour rows, small enough for the processor's cache, and bands know nothing of one
another: any number of threads may share them out and the picture stays the same.
"""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

import numpy as np

from .kernels import compiled


@compiled
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


@compiled
def count_bands(edges, height, band_rows, counts):
    """Triangles in each band, as places in one list: band b has entries ``counts[b]:counts[b + 1]``."""
    counts[:] = 0
    for t in range(len(edges)):
        top, end = max(edges[t, 0], 0), min(edges[t, 2], height)
        if top < end:
            for b in range(top // band_rows, (end - 1) // band_rows + 1):
                counts[b + 1] += 1
    for b in range(len(counts) - 1):
        counts[b + 1] += counts[b]


@compiled
def sort_bands(edges, height, band_rows, counts, members):
    """Fill the list that ``count_bands`` measured, triangles in their order."""
    following = counts.copy()
    for t in range(len(edges)):
        top, end = max(edges[t, 0], 0), min(edges[t, 2], height)
        if top < end:
            for b in range(top // band_rows, (end - 1) // band_rows + 1):
                members[following[b]] = t
                following[b] += 1


@compiled
def _first_centre(numerator, denominator):
    # Both are whole numbers below 2^53, and the quotient is far from any whole number that it does not equal:
    # rounding cannot carry it across, so this is exact.
    quotient = numerator / denominator
    whole = int(quotient)
    return whole + 1 if quotient > whole else whole


@compiled
def _draw_triangle(edges, planes, t, top, end, width, depth, red, green, blue, reach):
    """Draw rows top:end of triangle t; ``reach`` (rows, 2) keeps the columns that were touched.

    The sample planes are flat here and their places unsigned: Numba then drops its test for negative indices, and
    only so does the loop over a span become vector code.
    """
    ax, ay, bx = edges[t, 4], edges[t, 5], edges[t, 6]
    by, cx, cy = edges[t, 7], edges[t, 8], edges[t, 9]
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
        centre = y * 256 + 128
        far = _first_centre(float((ax - 128) * (cy - ay) + (centre - ay) * (cx - ax)), float(256 * (cy - ay)))
        if y < middle:
            near = _first_centre(float((ax - 128) * (by - ay) + (centre - ay) * (bx - ax)), float(256 * (by - ay)))
        else:
            near = _first_centre(float((bx - 128) * (cy - by) + (centre - by) * (cx - bx)), float(256 * (cy - by)))
        left, right = (near, far) if long_right else (far, near)
        left, right = max(left, 0), min(right, width)
        if left >= right:
            continue
        dx, dy = float(left * 256 + 128) - origin_x, float(centre) - origin_y
        z0, r0 = np.float32((zv + zy * dy) + zx * dx), np.float32((rv + ry * dy) + rx * dx)
        g0, b0 = np.float32((gv + gy * dy) + gx * dx), np.float32((bv + by_ * dy) + bx_ * dx)
        row = y - top
        reach[row, 0] = min(reach[row, 0], left)
        reach[row, 1] = max(reach[row, 1], right)
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


@compiled
def _encode(value, low, borders):
    value = min(max(value, np.float32(0.0)), np.float32(1.0))
    code = low[int(value * np.float32(16384.0))]
    return np.uint32(code) + np.uint32(value >= borders[code])


@compiled
def _pack(red, green, blue, alpha, low, borders):
    """One pixel, its bytes red, green, blue, alpha, of linear colour multiplied by alpha."""
    one = np.float32(1.0)
    if alpha <= np.float32(0.0):
        return np.uint32(0)
    if alpha != one:
        red, green, blue = red / alpha, green / alpha, blue / alpha
    opacity = np.uint32(np.int32(min(alpha, one) * np.float32(255.0) + np.float32(0.5)))
    low_half = _encode(red, low, borders) | (_encode(green, low, borders) << np.uint32(8))
    return low_half | (_encode(blue, low, borders) << np.uint32(16)) | (opacity << np.uint32(24))


@compiled
def _resolve_single(depth, red, green, blue, behind, plain, low, borders, out):
    """Pixels of a row of samples, one each."""
    one = np.float32(1.0)
    for x in range(len(out)):
        if depth[x] > np.float32(0.0):
            out[x] = _pack(red[x], green[x], blue[x], one, low, borders)
        else:
            out[x] = plain


@compiled
def _average(upper, lower, x, u0, u1, l0, l1, behind):
    """Mean of four samples; those not drawn are what is behind."""
    left = upper[2 * x] if u0 else behind
    right = upper[2 * x + 1] if u1 else behind
    left_below = lower[2 * x] if l0 else behind
    right_below = lower[2 * x + 1] if l1 else behind
    return ((left + right) + (left_below + right_below)) * np.float32(0.25)


@compiled
def _resolve_four(depth, red, green, blue, behind, plain, low, borders, out):
    """Pixels of two rows of samples, four each."""
    nothing, one = np.float32(0.0), np.float32(1.0)
    upper, lower = depth[0], depth[1]
    for x in range(len(out)):
        u0, u1 = upper[2 * x] > nothing, upper[2 * x + 1] > nothing
        l0, l1 = lower[2 * x] > nothing, lower[2 * x + 1] > nothing
        if not (u0 or u1 or l0 or l1):
            out[x] = plain
            continue
        r = _average(red[0], red[1], x, u0, u1, l0, l1, behind[0])
        g = _average(green[0], green[1], x, u0, u1, l0, l1, behind[1])
        b = _average(blue[0], blue[1], x, u0, u1, l0, l1, behind[2])
        a = behind[3]
        alpha = (((one if u0 else a) + (one if u1 else a)) + ((one if l0 else a) + (one if l1 else a))) * np.float32(
            0.25
        )
        out[x] = _pack(r, g, b, alpha, low, borders)


@compiled
def _resolve_row(depth, red, green, blue, row, n, reach, behind, plain, low, borders, out):
    """One row of pixels out of n rows of samples from ``row`` on."""
    first, last = reach[row, 0], reach[row, 1]
    if n == 2:
        first, last = min(first, reach[row + 1, 0]) // 2, (max(last, reach[row + 1, 1]) + 1) // 2
    if first >= last:
        first = last = 0
    out[:first] = plain
    out[last:] = plain
    rows, part = slice(row, row + n), slice(first * n, last * n)
    if n == 2:
        _resolve_four(
            depth[rows, part],
            red[rows, part],
            green[rows, part],
            blue[rows, part],
            behind,
            plain,
            low,
            borders,
            out[first:last],
        )
    else:
        _resolve_single(
            depth[row, part],
            red[row, part],
            green[row, part],
            blue[row, part],
            behind,
            plain,
            low,
            borders,
            out[first:last],
        )


@compiled
def draw_bands(
    start, stride, band_rows, n, edges, planes, counts, members, rows, reach, behind, plain, low, borders, out
):
    """Draw bands start, start + stride, …: ``rows`` (4, band_rows, W n) are this thread's own, ``out`` (H, W) packed."""
    height, width = out.shape[0] * n, out.shape[1] * n
    depth, red, green, blue = rows[0], rows[1], rows[2], rows[3]
    flat = depth.reshape(-1), red.reshape(-1), green.reshape(-1), blue.reshape(-1)
    for b in range(start, len(counts) - 1, stride):
        top, end = b * band_rows, min((b + 1) * band_rows, height)
        depth[:] = np.float32(0.0)
        reach[:, 0] = width
        reach[:, 1] = 0
        for m in range(counts[b], counts[b + 1]):
            _draw_triangle(edges, planes, members[m], top, end, width, flat[0], flat[1], flat[2], flat[3], reach)
        for y in range(top // n, end // n):
            row = y * n - top
            _resolve_row(depth, red, green, blue, row, n, reach, behind[y], plain[y], low, borders, out[y])
