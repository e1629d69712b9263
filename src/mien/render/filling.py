"""Filled paths band by band, compiled: each has its own samples, small enough for the processor's cache.

Bands know nothing of one another: any number of threads may share them out and the picture stays the same.
"""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: allow-untyped-defs, allow-untyped-calls, no-check-untyped-defs

from __future__ import annotations

import numpy as np

from mien.compiling import kernel

from .encoding import encode_row, fill
from .pixels import ONE
from .sweeping import END, FIRST, LEFT, RIGHT, list_edges, sweep_row

SHAPE, ALPHA, CLIPS, CLIPS_END = 4, 5, 6, 7
"""Columns of paths behind those of their box; of masks, the first."""

INSIDE, OUTSIDE, UNDER = range(3)
"""What a mask does to a path: it is kept inside or outside of it, or fills up what its edges leave free under it."""

HALF = ONE // 2
BITS = 14
"""ONE is 2 to this power."""


@kernel()
def _blend(sample, color, share):
    """A sample with so much of a colour over it, 0..ONE."""
    low = np.uint64(0x0000FFFF0000FFFF)
    over, under, half = np.uint64(share), np.uint64(ONE - share), np.uint64(HALF | HALF << 32)
    even = (sample & low) * under + (color & low) * over + half
    odd = ((sample >> np.uint64(16)) & low) * under + ((color >> np.uint64(16)) & low) * over + half
    bits = np.uint64(BITS)
    return ((even >> bits) & low) | (((odd >> bits) & low) << np.uint64(16))


@kernel()
def _share(area):
    """An area 0..1 as a whole number 0..ONE."""
    return int(min(max(area, 0.0), 1.0) * ONE + 0.5)


@kernel()
def _paint_run(samples, color, share):
    """Blend one share of a colour over all samples."""
    if share == ONE:
        fill(samples, color)
    elif share > 0:
        for x in range(np.uint64(len(samples))):
            samples[x] = _blend(samples[x], color, share)


@kernel()
def _paint_row(samples, color, alpha, cells, touched, runs, left, right):
    """Blend a colour over columns left:right of a row by what ``cells`` say, and clear them."""
    area, share = 0.0, 0
    x = left
    for k in range(runs):
        first, end = max(x, touched[k, 0]), touched[k, 1]
        _paint_run(samples[x:first], color, share)
        for x in range(first, min(end, right)):
            area += cells[x]
            share = (_share(area) * alpha) >> BITS
            if share > 0:
                samples[x] = _blend(samples[x], color, share)
        for x in range(first, end):
            cells[x] = 0.0
        x = max(first, min(end, right))
    _paint_run(samples[x:right], color, share)


@kernel()
def _mask_row(shares, cells, touched, runs, left, right):
    """Shares 0..ONE of columns left:right of a row by what ``cells`` say, which are cleared."""
    area, share = 0.0, 0
    x = left
    for k in range(runs):
        first, end = max(x, touched[k, 0]), touched[k, 1]
        fill(shares[x:first], np.uint16(share))
        for x in range(first, min(end, right)):
            area += cells[x]
            share = _share(area)
            shares[x] = share
        for x in range(first, end):
            cells[x] = 0.0
        x = max(first, min(end, right))
    fill(shares[x:right], np.uint16(share))


@kernel()
def _clip_row(shares, mask, kind):
    """Change the shares of a path by what a mask has there."""
    one, bits = np.uint32(ONE), np.uint32(BITS)
    if kind == INSIDE:
        for x in range(np.uint64(len(shares))):
            shares[x] = np.uint32(shares[x]) * np.uint32(mask[x]) >> bits
    elif kind == OUTSIDE:
        for x in range(np.uint64(len(shares))):
            shares[x] = np.uint32(shares[x]) * (one - np.uint32(mask[x])) >> bits
    else:
        for x in range(np.uint64(len(shares))):
            if shares[x] > 0:
                shares[x] += (one - np.uint32(shares[x])) * np.uint32(mask[x]) >> bits


@kernel()
def _paint_shares(samples, color, alpha, shares):
    """Blend a colour over all samples, each by its own share."""
    x, width = 0, len(samples)
    while x < width:
        share = shares[x]
        first = x
        while x < width and shares[x] == share:
            x += 1
        _paint_run(samples[first:x], color, np.int64(share) * alpha >> BITS)


@kernel()
def _encode_runs(samples, codes, opaque, out):
    """What ``encode_row`` says, once for all pixels in a row that are alike: a drawing is mostly flat."""
    x, width = 0, len(samples)
    while x < width:
        first, sample = x, samples[x]
        while x < width and samples[x] == sample:
            x += 1
        encode_row(samples[first : first + 1], codes, opaque, out[first : first + 1])
        fill(out[first + 1 : x], out[first])


@kernel()
def _fill_mask(
    edges, ways, starts, nonzero, box, top, bottom, heads, following, active, line, turns, cells, touched, masked
):  # fmt: skip
    """Shares of rows top:bottom of a mask, from its ``box`` and shape, to ``masked`` (band_rows, W)."""
    shape, first, end = box[SHAPE], max(box[FIRST], top), min(box[END], bottom)
    list_edges(edges, starts[shape], starts[shape + 1], first, end, heads, following)
    count = 0
    for row in range(first, end):
        count, runs = sweep_row(
            edges, ways, nonzero[shape], row, box[LEFT], box[RIGHT], heads[row - first], following, active, count, line,
            turns, cells, touched,
        )  # fmt: skip
        _mask_row(masked[row - top], cells, touched, runs, box[LEFT], box[RIGHT])


@kernel()
def _clip_shares(shares, clips, first, end, masks, masked, row, top, left, right):
    """Change the shares of a path in a row by its clips first:end."""
    for c in range(first, end):
        mask = clips[c, 0]
        begin, stop = max(left, masks[mask, LEFT]), min(right, masks[mask, RIGHT])
        if masks[mask, FIRST] <= row and row < masks[mask, END] and begin < stop:
            _clip_row(shares[begin:stop], masked[mask, row - top, begin:stop], clips[c, 1])


@kernel(
    "i8, i8, i8, f8[:,:], i4[:], i8[:], u1[:], i8[:,:], u8[:], i8[:,:], i8[:,:], u8[:], u1[:], "
    "u8[:,:], f8[:], i4[:,:], i4[:], i4[:], i4[:], f8[:,:], i4[:], u2[:], u2[:,:,:], u1[:], u4[:,:]"
)
def fill_bands(
    start, stride, band_rows, edges, ways, starts, nonzero, paths, colors, clips, masks, behind, codes,
    samples, cells, touched, heads, following, active, line, turns, shares, masked, ready, out,
):  # fmt: skip
    """Draw bands start, start + stride, ... into ``out`` (H, W), packed pixels.

    Args:
        start: first band.
        stride: how many threads there are.
        band_rows: rows in a band.
        edges, ways, starts: of every shape, from ``place_edges``.
        nonzero: (S,) 1 where that rule holds for a shape.
        paths: (P, 8) box, shape, alpha 0..ONE, and where the clips of a path start and end.
        colors: (P,) their samples.
        clips: (K, 2) mask, and what it does.
        masks: (M, 5) box and shape.
        behind: (H,) sample behind each row.
        codes: (ONE + 1,) sRGB code of every linear value.
        samples: (band_rows, W) this thread's own, as is what follows.
        cells, touched, heads, following, active, line, turns: of ``sweep_row`` and ``list_edges``.
        shares: (W,) of a path that is clipped.
        masked, ready: (M, band_rows, W) masks of a band, and (M,) whether they are worked out.
        out: filled.
    """
    height = len(out)
    for band in range(start, (height + band_rows - 1) // band_rows, stride):
        top, bottom = band * band_rows, min((band + 1) * band_rows, height)
        for row in range(top, bottom):
            fill(samples[row - top], behind[row])
        fill(ready, np.uint8(0))
        for p in range(len(paths)):
            first, end = max(paths[p, FIRST], top), min(paths[p, END], bottom)
            left, right = paths[p, LEFT], paths[p, RIGHT]
            if first >= end or left >= right:
                continue
            clip, clips_end = paths[p, CLIPS], paths[p, CLIPS_END]
            for c in range(clip, clips_end):
                mask = clips[c, 0]
                if not ready[mask]:
                    ready[mask] = 1
                    _fill_mask(
                        edges, ways, starts, nonzero, masks[mask], top, bottom, heads, following, active, line, turns,
                        cells, touched, masked[mask],
                    )  # fmt: skip
            shape, color, alpha = paths[p, SHAPE], colors[p], paths[p, ALPHA]
            list_edges(edges, starts[shape], starts[shape + 1], first, end, heads, following)
            count = 0
            for row in range(first, end):
                count, runs = sweep_row(
                    edges, ways, nonzero[shape], row, left, right, heads[row - first], following, active, count, line,
                    turns, cells, touched,
                )  # fmt: skip
                if clip == clips_end:
                    _paint_row(samples[row - top], color, alpha, cells, touched, runs, left, right)
                else:
                    _mask_row(shares, cells, touched, runs, left, right)
                    _clip_shares(shares, clips, clip, clips_end, masks, masked, row, top, left, right)
                    _paint_shares(samples[row - top, left:right], color, alpha, shares[left:right])
        for row in range(top, bottom):
            opaque = behind[row] >> np.uint64(48) == np.uint64(ONE)
            _encode_runs(samples[row - top], codes, opaque, out[row])
