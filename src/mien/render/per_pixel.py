"""What ``surface.light_surface`` says, compiled: the same formulas in the same order, so every number is the same."""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: allow-untyped-defs, allow-untyped-calls, no-check-untyped-defs

from __future__ import annotations

import numpy as np

from mien.compiling import kernel

from .lighting import light_at, unit_scale
from .pixels import ONE, POWER_STEP, WHOLE
from .spans import pack


@kernel()
def lane(sample, place):
    """One of the values of a sample."""
    return np.int64((sample >> np.uint64(16 * place)) & np.uint64(0xFFFF))


@kernel()
def light_sample(samples, i, nearness, x, y, viewer, lamps, ambient):
    """Replace sample i of group 0 of ``samples`` (3, n) by what is seen of it.

    Args:
        samples: groups of values.
        i: which.
        nearness: its 1 / depth.
        x, y: where it lies in the picture, pixels.
        viewer: (17,) place; axes right, up, forward; pixels a metre at 1 m; half the width and height; gloss of the
            scene and power of its cosine.
        lamps: of ``lighting.light_at``.
        ambient: of the same.
    """
    if nearness <= np.float32(0.0):
        return
    distance = 1.0 / float(nearness)
    across, above = (x - viewer[13]) / viewer[12] * distance, (viewer[14] - y) / viewer[12] * distance
    px = (viewer[0] + (viewer[3] * across + viewer[6] * above)) + viewer[9] * distance
    py = (viewer[1] + (viewer[4] * across + viewer[7] * above)) + viewer[10] * distance
    pz = (viewer[2] + (viewer[5] * across + viewer[8] * above)) + viewer[11] * distance
    own, normal, material = samples[0, i], samples[1, i], samples[2, i]
    nx, ny = lane(normal, 0) * (2.0 / WHOLE) - 1.0, lane(normal, 1) * (2.0 / WHOLE) - 1.0
    nz = lane(normal, 2) * (2.0 / WHOLE) - 1.0
    scale = unit_scale(nx, ny, nz)
    nx, ny, nz = nx * scale, ny * scale, nz * scale
    dr, dg, db, hr, hg, hb = 1.0, 1.0, 1.0, 0.0, 0.0, 0.0
    if lane(material, 2) > 0:
        strength, power = lane(material, 0) / WHOLE * viewer[15], (lane(material, 1) + POWER_STEP // 2) // POWER_STEP
        ex, ey, ez = viewer[0] - px, viewer[1] - py, viewer[2] - pz
        dr, dg, db, hr, hg, hb = light_at(
            px, py, pz, nx, ny, nz, ex, ey, ez, strength, power, lamps, ambient, int(viewer[16])
        )
    samples[0, i] = pack(
        np.float32(lane(own, 0) * dr + hr * ONE),
        np.float32(lane(own, 1) * dg + hg * ONE),
        np.float32(lane(own, 2) * db + hb * ONE),
        np.float32(ONE),
    )
