"""The light of ``shade``, compiled: the same formulas in the same order, so that every number is the same."""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: allow-untyped-defs, allow-untyped-calls, no-check-untyped-defs

from __future__ import annotations

import numpy as np

from mien.compiling import kernel

from .pixels import ONE

_TINY = 2.2250738585072014e-308


@kernel("f8[:,:], i8[:], i8[:], i8, i8, f8[:,:], b1[:], f8[:]")
def sum_normals(points, corners, starts, first, last, normals, facing, viewer):
    """Fill ``normals`` (F, 3), twice a polygon's area long, and ``facing`` (F,) for polygons first:last."""
    for f in range(first, last):
        start, size = starts[f], starts[f + 1] - starts[f]
        a, b = corners[start], corners[start + 1]
        nx, ny, nz = 0.0, 0.0, 0.0
        if size == 4:
            c, d = corners[start + 2], corners[start + 3]
            ux, uy, uz = points[c, 0] - points[a, 0], points[c, 1] - points[a, 1], points[c, 2] - points[a, 2]
            wx, wy, wz = points[d, 0] - points[b, 0], points[d, 1] - points[b, 1], points[d, 2] - points[b, 2]
            nx, ny, nz = uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx
        else:
            for k in range(1, size - 1):
                c, d = corners[start + k], corners[start + k + 1]
                ux, uy, uz = points[c, 0] - points[a, 0], points[c, 1] - points[a, 1], points[c, 2] - points[a, 2]
                wx, wy, wz = points[d, 0] - points[a, 0], points[d, 1] - points[a, 1], points[d, 2] - points[a, 2]
                nx += uy * wz - uz * wy
                ny += uz * wx - ux * wz
                nz += ux * wy - uy * wx
        normals[f, 0], normals[f, 1], normals[f, 2] = nx, ny, nz
        tx, ty, tz = viewer[0] - points[a, 0], viewer[1] - points[a, 1], viewer[2] - points[a, 2]
        facing[f] = (tx * nx + ty * ny) + tz * nz > 0.0


@kernel()
def unit_scale(x, y, z):
    """What makes a vector one of length 1; a vector without length stays as it is."""
    return 1.0 / np.sqrt(max((x * x + y * y) + z * z, _TINY))


@kernel()
def _whole_power(base, power):
    result = 1.0
    while power > 0:
        if power & 1:
            result *= base
        power >>= 1
        base *= base
    return result


@kernel()
def light_at(x, y, z, nx, ny, nz, ex, ey, ez, strength, power, lamps, ambient, cosine_power):
    """Diffuse light and highlight, RGB each, at a place with a unit normal, seen from the direction e.

    Args:
        x, y, z: m.
        nx, ny, nz: of length 1.
        ex, ey, ez: towards the viewer, of any length.
        strength: of the highlight.
        power: its sharpness.
        lamps: (L, 8) place, colour, wrap, 1 / (1 + wrap).
        ambient: (2, 3) light from below and from above.
        cosine_power: whole power of the diffuse term.
    """
    up = (ny + 1.0) * 0.5
    dr = ambient[0, 0] + (ambient[1, 0] - ambient[0, 0]) * up
    dg = ambient[0, 1] + (ambient[1, 1] - ambient[0, 1]) * up
    db = ambient[0, 2] + (ambient[1, 2] - ambient[0, 2]) * up
    hr, hg, hb = 0.0, 0.0, 0.0
    if strength > 0.0:
        scale = unit_scale(ex, ey, ez)
        ex, ey, ez = ex * scale, ey * scale, ez * scale
    for i in range(len(lamps)):
        lx, ly, lz = lamps[i, 0] - x, lamps[i, 1] - y, lamps[i, 2] - z
        scale = unit_scale(lx, ly, lz)
        lx, ly, lz = lx * scale, ly * scale, lz * scale
        cosine = (nx * lx + ny * ly) + nz * lz
        amount = max((cosine + lamps[i, 6]) * lamps[i, 7], 0.0)
        if cosine_power > 1:
            amount = _whole_power(amount, cosine_power)
        dr += lamps[i, 3] * amount
        dg += lamps[i, 4] * amount
        db += lamps[i, 5] * amount
        if strength > 0.0 and cosine > 0.0:
            mx, my, mz = lx + ex, ly + ey, lz + ez
            scale = unit_scale(mx, my, mz)
            shine = (nx * (mx * scale) + ny * (my * scale)) + nz * (mz * scale)
            shine = _whole_power(max(shine, 0.0), power) * strength
            hr += lamps[i, 3] * shine
            hg += lamps[i, 4] * shine
            hb += lamps[i, 5] * shine
    return dr, dg, db, hr, hg, hb


@kernel("i8[:], i8[:], b1[:], i4[:,:], i4[:,:], i8, i8, i4[:,:], u1[:]")
def choose_shades(triangles, polygon_of_triangle, facing, front, back, first, last, shade_of, needed):
    """Fill ``shade_of`` (n, 3) first:last, and set ``needed`` (N + M,) where a shade is one of them."""
    for n in range(first, last):
        t = triangles[n]
        shows_front = facing[polygon_of_triangle[t]]
        for k in range(3):
            shade = front[t, k] if shows_front else back[t, k]
            shade_of[n, k] = shade
            needed[shade] = 1


@kernel(
    "f8[:,:], i8[:], i8[:], f8[:,:], f8[:,:], f8[:,:], f8[:,:], f8[:], i8, i8[:], i8[:], i8[:], b1[:], b1[:], f8[:], "
    "i8[:], i8[:], i8[:], u1[:], i8, i8, f8[:,:], f8[:,:]"
)
def light_nodes(
    points, corners, starts, normals, own_normals, lamps, ambient, viewer, cosine_power,
    vertex, polygon, back, lit, own, gloss, power, sum_starts, sum_columns, needed, first, last, diffuse, highlight,
):  # fmt: skip
    """Fill ``diffuse`` and ``highlight`` (N + M, 3) for nodes first:last and their backs, where they are needed.

    Args:
        points: (V, 3) m, of the polygons with ``corners`` and ``starts``.
        corners: as in the topology.
        starts: as in the topology.
        normals: (F, 3) from ``sum_normals``.
        own_normals: (V, 3) normals of round parts.
        lamps: of ``light_at``.
        ambient: of ``light_at``.
        viewer: (4,) viewer's place and strength of all highlights.
        cosine_power: of ``light_at``.
        vertex, polygon, back, lit, own, gloss, power: ``Plan.columns``.
        sum_starts, sum_columns: of the plan's ``normal_sum``.
        needed: (N + M,) from ``choose_shades``.
        first: first node.
        last: behind the last node.
        diffuse: filled.
        highlight: filled.
    """
    for n in range(first, last):
        behind = back[n]
        if not (needed[n] or (behind >= 0 and needed[behind])):
            continue
        x, y, z = 0.0, 0.0, 0.0
        nx, ny, nz = 0.0, 0.0, 0.0
        v = vertex[n]
        if v >= 0:
            x, y, z = points[v, 0], points[v, 1], points[v, 2]
        else:
            start, end = starts[polygon[n]], starts[polygon[n] + 1]
            x, y, z = points[corners[start], 0], points[corners[start], 1], points[corners[start], 2]
            for c in range(start + 1, end):
                x += points[corners[c], 0]
                y += points[corners[c], 1]
                z += points[corners[c], 2]
            size = float(end - start)
            x, y, z = x / size, y / size, z / size
        if own[n]:
            nx, ny, nz = own_normals[v, 0], own_normals[v, 1], own_normals[v, 2]
        else:
            for k in range(sum_starts[n], sum_starts[n + 1]):
                f = sum_columns[k]
                nx += normals[f, 0]
                ny += normals[f, 1]
                nz += normals[f, 2]
        scale = unit_scale(nx, ny, nz)
        nx, ny, nz = nx * scale, ny * scale, nz * scale
        ex, ey, ez = viewer[0] - x, viewer[1] - y, viewer[2] - z
        for side in range(2):
            target = n
            if side == 1:
                target = behind
                nx, ny, nz = -nx, -ny, -nz
            if target < 0 or not needed[target]:
                continue
            dr, dg, db, hr, hg, hb = 1.0, 1.0, 1.0, 0.0, 0.0, 0.0
            if lit[n]:
                dr, dg, db, hr, hg, hb = light_at(
                    x, y, z, nx, ny, nz, ex, ey, ez, gloss[n] * viewer[3], power[n], lamps, ambient, cosine_power
                )
            diffuse[target, 0], diffuse[target, 1], diffuse[target, 2] = dr, dg, db
            highlight[target, 0], highlight[target, 1], highlight[target, 2] = hr, hg, hb


@kernel("f8[:,:], i8[:], i8[:], i8[:], i8[:], i8[:], u1[:], i8, i8, f8[:,:], f8[:,:], f8[:,:]")
def tint_nodes(colors, corners, starts, vertex, polygon, back, needed, first, last, diffuse, highlight, values):
    """Fill ``values`` (N + M, 3), own colour x diffuse + highlight, for nodes first:last, where they are needed."""
    for n in range(first, last):
        behind = back[n]
        if not (needed[n] or (behind >= 0 and needed[behind])):
            continue
        for c in range(3):
            if vertex[n] >= 0:
                own = colors[vertex[n], c]
            else:
                start, end = starts[polygon[n]], starts[polygon[n] + 1]
                own = colors[corners[start], c]
                for k in range(start + 1, end):
                    own += colors[corners[k], c]
                own /= float(end - start)
            values[n, c] = (own * diffuse[n, c] + highlight[n, c]) * ONE
            if behind >= 0:
                values[behind, c] = (own * diffuse[behind, c] + highlight[behind, c]) * ONE
