"""The exact area of outlines in the pixels of a row, compiled.

A row of pixels is cut into slabs where an outline has a corner or two of its edges cross: within a slab edges are
straight and keep their order, so that what is inside is a row of trapezoids, by either rule and however the outline
winds. The area of a trapezoid in a pixel is that to the right of its left edge less that to the right of its right one;
it is noted as the change from one pixel to the next, so that pixels far from any edge cost nothing.

Source: Catmull 1978 (exact area in a pixel); Levien 2016, font-rs (changes from pixel to pixel).
"""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: allow-untyped-defs, allow-untyped-calls, no-check-untyped-defs

from __future__ import annotations

import math

import numpy as np

from mien.compiling import kernel

TOP, BOTTOM, X, SLOPE = range(4)
"""Columns of edges: first and last place downwards, pixels; place across at the first; change across a pixel down."""

LEFT, FIRST, RIGHT, END = range(4)
"""Columns of boxes: first column and row, and those behind the last."""

STEPS = 65536.0
"""Places downwards are rounded to this part of a pixel: no slope is without bounds."""

FAR = 1e100
"""Places farther away are as good as this far."""

LEAST = 1.0 / 256.0
"""Height of the lowest slab that a crossing makes. What is wrong there is wrong by less than a thousandth."""

MANY = 64
"""Where more edges of one outline run through a row, hatching or a scribble, it is cut into even slabs."""

LINE = 1.0 / 16.0
"""Height of these: what is inside is found on a line through the middle of each."""

SLACK = 2.0**-20
"""Edges that change places by less have not crossed: they lie upon one another."""


@kernel("f8[:,:], i8[:], i8[:], f8, f8, f8, i8, i8, f8[:,:], i4[:], i8[:], i8[:,:]")
def place_edges(points, contours, shapes, scale, left, bottom, width, height, edges, ways, starts, boxes):
    """Fill edges, the ``ways`` they run (1 down, -1 up), where those of each shape start, and its box in the picture.

    Args:
        points: (N, 2) of all contours, y up.
        contours: (C + 1,) where each of them starts.
        shapes: (S + 1,) where the contours of each shape start.
        scale, left, bottom: pixels a unit, and where the origin lies.
        width, height: of the picture.
        edges, ways: (N, 4) and (N,), filled as far as needed.
        starts: (S + 1,) filled.
        boxes: (S, 4) filled; empty where nothing of a shape lies in the picture.
    """
    count = 0
    for shape in range(len(boxes)):
        starts[shape] = count
        low_x, low_y, high_x, high_y = FAR, FAR, -FAR, -FAR
        for contour in range(shapes[shape], shapes[shape + 1]):
            first, last = contours[contour], contours[contour + 1]
            for k in range(first, last):
                before = k - 1 if k > first else last - 1
                ax = min(max(left + points[before, 0] * scale, -FAR), FAR)
                ay = min(max(bottom - points[before, 1] * scale, -FAR), FAR)
                bx = min(max(left + points[k, 0] * scale, -FAR), FAR)
                by = min(max(bottom - points[k, 1] * scale, -FAR), FAR)
                ay, by = np.floor(ay * STEPS + 0.5) / STEPS, np.floor(by * STEPS + 0.5) / STEPS
                if ay == by:
                    continue
                way = 1
                if ay > by:
                    ax, ay, bx, by, way = bx, by, ax, ay, -1
                edges[count, TOP], edges[count, BOTTOM] = ay, by
                edges[count, X], edges[count, SLOPE] = ax, (bx - ax) / (by - ay)
                ways[count] = way
                count += 1
                low_x, high_x = min(low_x, min(ax, bx)), max(high_x, max(ax, bx))
                low_y, high_y = min(low_y, ay), max(high_y, by)
        boxes[shape, LEFT] = math.floor(min(max(low_x, 0.0), float(width)))
        boxes[shape, RIGHT] = math.ceil(min(max(high_x, 0.0), float(width)))
        boxes[shape, FIRST] = math.floor(min(max(low_y, 0.0), float(height)))
        boxes[shape, END] = math.ceil(min(max(high_y, 0.0), float(height)))
    starts[len(boxes)] = count


@kernel()
def list_edges(edges, begin, stop, first, end, heads, following):
    """For rows first:end the edges among begin:stop that begin there, or above the first: ``heads``, ``following``."""
    for row in range(end - first):
        heads[row] = -1
    for e in range(stop - 1, begin - 1, -1):
        if edges[e, TOP] < end and edges[e, BOTTOM] > first:
            row = int(max(edges[e, TOP], float(first))) - first
            following[e] = heads[row]
            heads[row] = e


@kernel()
def _touch(touched, run, runs, first, end):
    """Widen a run of cells to first:end; how many runs there are then.

    A run is of the first border of an area in a row, of the second, and so on: they begin in order in every slab.
    """
    if run < runs:
        touched[run, 0], touched[run, 1] = min(touched[run, 0], first), max(touched[run, 1], end)
        return runs
    touched[run, 0], touched[run, 1] = first, end
    return run + 1


@kernel()
def _add_edge(cells, left, right, a, z, height):
    """Note the area to the right of an edge from a to z across; the cells that may have changed.

    ``height`` is negative where an area ends.
    """
    if a > z:
        a, z = z, a
    if a >= right:
        return right, right
    if z <= left:
        cells[left] += height
        return left, left + 1
    start = int(max(a, float(left)))
    if a < left:
        share = (left - a) / (z - a)
        cells[left] += height * share
        height, a = height * (1.0 - share), float(left)
    if z > right:
        height, z = height * ((right - a) / (z - a)), float(right)
    last = int(z)
    if start == last:
        inside = (a + z) * 0.5 - start
        cells[start] += height * (1.0 - inside)
        cells[start + 1] += height * inside
    else:
        each = height / (z - a)
        part = start + 1 - a
        cells[start] += each * part * part * 0.5
        cells[start + 1] += each * part * (1.0 - part * 0.5)
        for x in range(start + 1, last):
            cells[x] += each * 0.5
            cells[x + 1] += each * 0.5
        part = z - last
        cells[last] += each * part * (1.0 - part * 0.5)
        cells[last + 1] += each * part * part * 0.5
    return start, last + 2


@kernel()
def _order(active, count, line, turns, gap):
    """Sort the active edges by their places at the top of a slab, then at its bottom.

    Source: Shell 1959; the gaps are Knuth's, and with a gap of 1 it is plain insertion, best for what is nearly sorted.
    """
    while gap > 0:
        for k in range(gap, count):
            a, z, e, turn = line[k, 0], line[k, 1], active[k], turns[k]
            m = k
            while m >= gap and (a < line[m - gap, 0] or (a == line[m - gap, 0] and z < line[m - gap, 1])):
                line[m, 0], line[m, 1] = line[m - gap, 0], line[m - gap, 1]
                active[m], turns[m] = active[m - gap], turns[m - gap]
                m -= gap
            line[m, 0], line[m, 1], active[m], turns[m] = a, z, e, turn
        gap //= 3


@kernel()
def _cross_line(edges, ways, active, count, known, y, line, turns):
    """Put the active edges in their order across a line at y, as if they were upright there.

    Those that are ``known`` lie in the order of another line not far away.
    """
    for k in range(count):
        e = active[k]
        live = edges[e, TOP] <= y and edges[e, BOTTOM] > y
        turns[k] = ways[e] if live else 0
        line[k, 0] = edges[e, X] + ((y - edges[e, TOP]) * edges[e, SLOPE] if live else 0.0)
        line[k, 1] = line[k, 0]
    gap = 1
    while known < count and 3 * gap + 1 < count:
        gap = 3 * gap + 1
    _order(active, count, line, turns, gap)


@kernel()
def _cross_slab(edges, ways, active, count, y, end, line, turns):
    """Put the active edges in their order across a slab; how far down it no two of them cross, 0..1.

    Their places at its top and bottom go to ``line``, and their ways to ``turns``: 0 of those that are not in it.
    """
    for k in range(count):
        e = active[k]
        top = edges[e, TOP]
        a = z = edges[e, X]
        turns[k] = 0
        if top <= y and edges[e, BOTTOM] > y:
            turns[k] = ways[e]
            a, z = a + (y - top) * edges[e, SLOPE], a + (end - top) * edges[e, SLOPE]
        line[k, 0], line[k, 1] = a, z
    _order(active, count, line, turns, 1)
    reach, before = 1.0, -1
    for k in range(count):
        if turns[k] != 0:
            if before >= 0 and line[before, 1] - line[k, 1] > SLACK:
                apart = line[k, 0] - line[before, 0]
                reach = min(reach, apart / (apart + (line[before, 1] - line[k, 1])))
            before = k
    return reach


@kernel()
def sweep_row(edges, ways, nonzero, row, left, right, head, following, active, count, line, turns, cells, touched):
    """Note in ``cells`` how the area inside changes from pixel to pixel of a row; how many edges go on, runs of cells.

    Args:
        edges, ways: from ``place_edges``.
        nonzero: whether that rule holds, and not evenodd.
        row: of the picture.
        left, right: columns that count; what lies to the left of them counts for their border.
        head, following: edges that begin in the row, from ``list_edges``.
        active, count: edges that come from above; those that go on below are left in it.
        line, turns: room for every edge.
        cells: (width + 2,) all 0 before; whoever reads them makes them so again.
        touched: (E, 2) filled with the runs of cells that may not be 0, in the order in which they begin.
    """
    known = count
    while head >= 0:
        active[count] = head
        count += 1
        head = following[head]
    runs, coarse = 0, count > MANY
    y, floor = float(row), row + 1.0
    while y < floor and count > 0:
        if coarse:
            end = y + LINE
            _cross_line(edges, ways, active, count, known, y + 0.5 * LINE, line, turns)
            known = count
        else:
            end = floor
            for k in range(count):
                top, bottom = edges[active[k], TOP], edges[active[k], BOTTOM]
                if top > y:
                    end = min(end, top)
                elif bottom > y:
                    end = min(end, bottom)
            reach = _cross_slab(edges, ways, active, count, y, end, line, turns)
            if reach < 1.0 and end - y > LEAST:
                end = min(end, y + max((end - y) * reach, LEAST))
                _cross_slab(edges, ways, active, count, y, end, line, turns)
        winding = run = 0
        for k in range(count):
            if turns[k] != 0:
                before = winding
                winding += turns[k]
                if nonzero:
                    was_inside, is_inside = before != 0, winding != 0
                else:
                    was_inside, is_inside = before & 1 != 0, winding & 1 != 0
                if was_inside != is_inside:
                    height = end - y if is_inside else y - end
                    first, behind = _add_edge(cells, left, right, line[k, 0], line[k, 1], height)
                    runs = _touch(touched, run, runs, first, behind)
                    run += 1
        y = end
    # Edges that cross in the lowest of slabs may have begun one before the other.
    for run in range(runs - 1, 0, -1):
        touched[run - 1, 0] = min(touched[run - 1, 0], touched[run, 0])
    kept = 0
    for k in range(count):
        if edges[active[k], BOTTOM] > floor:
            active[kept] = active[k]
            kept += 1
    return kept, runs
