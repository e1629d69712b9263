"""A picture band by band, compiled: each has its own samples, small enough for the processor's cache.

Bands know nothing of one another: any number of threads may share them out and the picture stays the same.
"""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: allow-untyped-defs, allow-untyped-calls, no-check-untyped-defs

from __future__ import annotations

import numpy as np

from mien.compiling import kernel

from .encoding import encode_row, fill
from .per_pixel import light_sample
from .pixels import OFFSETS, ONE
from .smoothing import average, draw_samples, list_marks, mark_edges, mark_kinks
from .spans import END_COLUMN, FIRST_COLUMN, draw_triangle


@kernel()
def _smooth(
    places, inverse, corners, borders, shapes, frames, planes, members, begin, stop, top, end, first, last, first_row,
    limit, behind, viewer, lamps, ambient, depth, color, marks, before, columns, fine_depth, fine_color,
):  # fmt: skip
    """Give the marked pixels of rows top:end and columns first:last of a band the mean of four samples."""
    width, scale = marks.shape[1], viewer[12]
    offset = (top - first_row) * width
    # The outermost pixels are looked at too, which takes a neighbour on each side.
    left, size = max(first - 1, 0), min(last + 1, width) - max(first - 1, 0)
    for row in range(top, end):
        if row > 0 and row + 1 < len(behind):
            here = offset + (row - top) * width + left
            mark_kinks(
                depth[here - width : here - width + size], depth[here : here + size],
                depth[here + width : here + width + size], np.float32(scale), marks[row - top, left : left + size],
            )  # fmt: skip
    for m in range(begin, stop):
        if borders[members[m]]:
            mark_edges(places, inverse, corners, borders, members[m], top, end, scale, depth[offset:], marks)
    count = list_marks(marks, end - top, first, last, columns, before)
    if count == 0:
        return
    for group in range(len(color)):
        for row in range(top, end):
            for k in range(before[row - top, first], before[row - top, last]):
                for sample in range(4):
                    fine_depth[k, sample] = np.float32(0.0)
                    fine_color[group, k, sample] = behind[row]
        for m in range(begin, stop):
            draw_samples(
                places, corners, shapes, frames, planes, 9 * group, members[m], top, end, first, last, limit[group],
                before, columns, fine_depth, fine_color[group],
            )  # fmt: skip
    for row in range(top, end):
        for k in range(before[row - top, first], before[row - top, last]):
            if len(color) > 1:
                for sample in range(4):
                    x, y = columns[k] + OFFSETS[sample][0] / 256.0, row + OFFSETS[sample][1] / 256.0
                    light_sample(fine_color[:, :, sample], k, fine_depth[k, sample], x, y, viewer, lamps, ambient)
            color[0, (row - first_row) * width + columns[k]] = average(fine_color[0], k)


@kernel(
    "i8, i8, i8, i8, i4[:,:], f8[:], i4[:,:], u1[:], f8[:,:], i4[:,:], f4[:,:], i8[:], i4[:], f4[:], "
    "u8[:], u4[:], f8[:], f8[:,:], f8[:,:], u1[:], f4[:], u8[:,:], u1[:,:], i4[:,:], i4[:], f4[:,:], u8[:,:,:], u4[:,:]"
)
def draw_bands(
    start, stride, band_rows, apron, places, inverse, corners, borders, shapes, frames, planes, counts, members, limit,
    behind, plain, viewer, lamps, ambient, codes, depth, color, marks, before, columns, fine_depth, fine_color, out,
):  # fmt: skip
    """Draw bands start, start + stride, ... into ``out`` (H, W), packed pixels.

    Args:
        start: first band.
        stride: how many threads there are.
        band_rows: rows in a band.
        apron: 1 where edges are smoothed: a band then knows the depths of the rows above and below it.
        places, inverse, corners, borders: of the triangles, as in ``Triangles``.
        shapes, frames, planes: from ``set_up``.
        counts, members: from ``sort_bands``.
        limit: (G,) largest value of each group of three.
        behind: (H,) sample behind each row.
        plain: (H,) pixel behind each row.
        viewer, lamps, ambient: of ``light_sample``.
        codes: (ONE + 1,) sRGB code of every linear value.
        depth, color: this thread's own samples: (n,) and (G, n), with room for one step behind the end.
        marks, before, columns, fine_depth, fine_color: this thread's own, of smooth edges.
        out: filled.
    """
    height, width = out.shape
    for b in range(start, len(counts) - 1, stride):
        top, end = b * band_rows, min((b + 1) * band_rows, height)
        begin, stop = counts[b], counts[b + 1]
        first, last = width, 0
        for m in range(begin, stop):
            first = min(first, frames[members[m], FIRST_COLUMN])
            last = max(last, frames[members[m], END_COLUMN])
        first, last = max(first, 0), min(last, width)
        if first >= last:
            for row in range(top, end):
                fill(out[row], plain[row])
            continue
        first_row, end_row = max(top - apron, 0), min(end + apron, height)
        for group in range(len(color)):
            fill(depth[: (end_row - first_row) * width], np.float32(0.0))
            for row in range(first_row, end_row):
                place = (row - first_row) * width
                fill(color[group, place + first : place + last], behind[row])
            for m in range(begin, stop):
                draw_triangle(
                    shapes, frames, planes, 9 * group, members[m], first_row, end_row, width, limit[group], depth,
                    color[group],
                )  # fmt: skip
        if len(color) > 1:
            for row in range(top, end):
                for x in range(first, last):
                    i = (row - first_row) * width + x
                    light_sample(color, i, depth[i], x + 0.5, row + 0.5, viewer, lamps, ambient)
        if apron:
            _smooth(
                places, inverse, corners, borders, shapes, frames, planes, members, begin, stop, top, end, first, last,
                first_row, limit, behind, viewer, lamps, ambient, depth, color, marks, before, columns, fine_depth,
                fine_color,
            )  # fmt: skip
        for row in range(top, end):
            place = (row - first_row) * width
            fill(out[row, :first], plain[row])
            samples = color[0, place + first : place + last]
            encode_row(samples, codes, behind[row] >> np.uint64(48) == np.uint64(ONE), out[row, first:last])
            fill(out[row, last:], plain[row])
