"""The fast rasteriser, compiled by Numba: triangles into horizontal bands, spans in each band, pixels at its end.

A band has its own depth and colour rows, small enough for the processor's cache, and bands know nothing of one
another: any number of threads may share them out and the picture stays the same. No ``fastmath``: it would let
the processor decide the last bit. Importing this module costs Numba's start, so that only ``renderer`` does it,
when first drawing.
"""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba
import numpy as np


def _compiled(function: Callable[..., Any]) -> Any:
    return numba.njit(cache=True, nogil=True, error_model="numpy", fastmath=False)(function)


SHORT = 12
"""Spans of fewer pixels take a plain loop: a vector loop would cost more to begin than it saves."""


@_compiled
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


@_compiled
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


@_compiled
def sort_bands(edges, height, band_rows, counts, members):
    """Fill the list that ``count_bands`` measured, triangles in their order."""
    following = counts.copy()
    for t in range(len(edges)):
        top, end = max(edges[t, 0], 0), min(edges[t, 2], height)
        if top < end:
            for b in range(top // band_rows, (end - 1) // band_rows + 1):
                members[following[b]] = t
                following[b] += 1


@_compiled
def _first_centre(numerator, denominator):
    # Both are whole numbers below 2^53, and the quotient is far from any whole number that it does not equal:
    # rounding cannot carry it across, so this is exact.
    quotient = numerator / denominator
    whole = int(quotient)
    return whole + 1 if quotient > whole else whole


@_compiled
def _long_span(depth, red, green, blue, z0, dz, r0, dr, g0, dg, b0, db):
    # Slices from 0 on, and selects instead of branches: only so does the loop become vector code.
    for x in range(len(depth)):
        step = np.float32(np.int32(x))
        z = z0 + dz * step
        scale = np.float32(1.0) / z
        near = z > depth[x]
        red[x] = (r0 + dr * step) * scale if near else red[x]
        green[x] = (g0 + dg * step) * scale if near else green[x]
        blue[x] = (b0 + db * step) * scale if near else blue[x]
        depth[x] = z if near else depth[x]


@_compiled
def _draw_triangle(edge, plane, top, end, width, depth, red, green, blue, reach):
    """Draw rows top:end of one triangle; ``reach`` (rows, 2) keeps the columns that were touched."""
    ax, ay, bx, by, cx, cy = edge[4], edge[5], edge[6], edge[7], edge[8], edge[9]
    origin_x, origin_y = plane[4, 0], plane[4, 1]
    one = np.float32(1.0)
    dz, dr, dg, db = (
        np.float32(plane[0, 1] * 256.0),
        np.float32(plane[1, 1] * 256.0),
        np.float32(plane[2, 1] * 256.0),
        np.float32(plane[3, 1] * 256.0),
    )
    for y in range(max(edge[0], top), min(edge[2], end)):
        centre = y * 256 + 128
        far = _first_centre(float((ax - 128) * (cy - ay) + (centre - ay) * (cx - ax)), float(256 * (cy - ay)))
        if y < edge[1]:
            near = _first_centre(float((ax - 128) * (by - ay) + (centre - ay) * (bx - ax)), float(256 * (by - ay)))
        else:
            near = _first_centre(float((bx - 128) * (cy - by) + (centre - by) * (cx - bx)), float(256 * (cy - by)))
        left, right = (near, far) if edge[3] else (far, near)
        left, right = max(left, 0), min(right, width)
        if left >= right:
            continue
        dx, dy = float(left * 256 + 128) - origin_x, float(centre) - origin_y
        z0 = np.float32((plane[0, 0] + plane[0, 2] * dy) + plane[0, 1] * dx)
        r0 = np.float32((plane[1, 0] + plane[1, 2] * dy) + plane[1, 1] * dx)
        g0 = np.float32((plane[2, 0] + plane[2, 2] * dy) + plane[2, 1] * dx)
        b0 = np.float32((plane[3, 0] + plane[3, 2] * dy) + plane[3, 1] * dx)
        row = y - top
        reach[row, 0] = min(reach[row, 0], left)
        reach[row, 1] = max(reach[row, 1], right)
        if right - left >= SHORT:
            _long_span(
                depth[row, left:right],
                red[row, left:right],
                green[row, left:right],
                blue[row, left:right],
                z0,
                dz,
                r0,
                dr,
                g0,
                dg,
                b0,
                db,
            )
            continue
        for x in range(left, right):
            step = np.float32(np.int32(x - left))
            z = z0 + dz * step
            if z > depth[row, x]:
                scale = one / z
                depth[row, x] = z
                red[row, x] = (r0 + dr * step) * scale
                green[row, x] = (g0 + dg * step) * scale
                blue[row, x] = (b0 + db * step) * scale


@_compiled
def _encode(value, low, borders):
    value = min(max(value, np.float32(0.0)), np.float32(1.0))
    code = low[int(value * np.float32(16384.0))]
    return np.uint8(code + 1) if value >= borders[code] else code


@_compiled
def _resolve_row(depth, red, green, blue, row, n, reach, behind, plain, low, borders, out):
    """One row of pixels out of n rows of samples."""
    first, last = reach[row, 0] // n, (reach[row, 1] + n - 1) // n
    if n == 2:
        first = min(first, reach[row + 1, 0] // n)
        last = max(last, (reach[row + 1, 1] + n - 1) // n)
    if first >= last:
        first = last = 0
    for x in range(first):
        out[x] = plain
    for x in range(last, len(out)):
        out[x] = plain
    nothing, one, quarter = np.float32(0.0), np.float32(1.0), np.float32(0.25)
    total = np.empty(4, dtype=np.float32)
    sample = np.empty((4, 4), dtype=np.float32)
    for x in range(first, last):
        drawn = 0
        for k in range(n * n):
            i, j = row + k // n, x * n + k % n
            if depth[i, j] > nothing:
                drawn += 1
                sample[k, 0], sample[k, 1], sample[k, 2], sample[k, 3] = red[i, j], green[i, j], blue[i, j], one
            else:
                for c in range(4):
                    sample[k, c] = behind[c]
        if drawn == 0:
            out[x] = plain
            continue
        for c in range(4):
            if n == 2:
                total[c] = ((sample[0, c] + sample[1, c]) + (sample[2, c] + sample[3, c])) * quarter
            else:
                total[c] = sample[0, c]
        alpha = total[3]
        for c in range(3):
            value = total[c] / alpha if alpha > nothing else nothing
            out[x, c] = _encode(value, low, borders)
        out[x, 3] = np.uint8(min(alpha, one) * np.float32(255.0) + np.float32(0.5))


@_compiled
def draw_bands(
    start, stride, band_rows, n, edges, planes, counts, members, rows, reach, behind, plain, low, borders, out
):
    """Draw bands start, start + stride, …: ``rows`` (4, band_rows, W n) are this thread's own, ``out`` (H, W, 4)."""
    height, width = out.shape[0] * n, out.shape[1] * n
    depth, red, green, blue = rows[0], rows[1], rows[2], rows[3]
    for b in range(start, len(counts) - 1, stride):
        top, end = b * band_rows, min((b + 1) * band_rows, height)
        depth[:] = np.float32(0.0)
        reach[:, 0] = width
        reach[:, 1] = 0
        for m in range(counts[b], counts[b + 1]):
            t = members[m]
            _draw_triangle(edges[t], planes[t], top, end, width, depth, red, green, blue, reach)
        for y in range(top // n, end // n):
            row = y * n - top
            _resolve_row(depth, red, green, blue, row, n, reach, behind[y], plain[y], low, borders, out[y])
