"""Light on every pixel (shading ``smooth+``): what is interpolated is the surface, and the light is worked out on it.

Source: Phong 1975 (normals interpolated).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mien.core import Scene

from .camera import SUBPIXELS, Camera
from .pixels import ONE, POWER_STEP, WHOLE, Samples
from .shade import group_powers, light_places, normalised

Floats32 = NDArray[np.float32]


def light_surface(groups: Samples, depth: Floats32, offset: tuple[int, int], camera: Camera, scene: Scene) -> Samples:
    """(H, W, 4) samples as they are seen, of three groups (3, H, W, 4): own colour, normal, material.

    Args:
        groups: in the order of ``values.surface_values``.
        depth: (H, W) 1 / depth, 1/m.
        offset: where in its pixel a sample lies, 1/256.
        camera: whose raster.
        scene: viewer and lamps.
    """
    rows, columns = np.nonzero(depth)
    own, normal, material = (group[rows, columns, :3] for group in groups)
    distance = 1.0 / depth[rows, columns].astype(np.float64)
    across = (columns + offset[0] / SUBPIXELS - camera.width * 0.5) / camera.scale * distance
    above = (camera.height * 0.5 - (rows + offset[1] / SUBPIXELS)) / camera.scale * distance
    x, y, z = (
        (camera.position[k] + (camera.right[k] * across + camera.up[k] * above)) + camera.forward[k] * distance
        for k in range(3)
    )
    a, b, c = (normal[:, k] * (2.0 / WHOLE) - 1.0 for k in range(3))
    gloss, power, lit = material[:, 0] / WHOLE, (material[:, 1] + POWER_STEP // 2) // POWER_STEP, material[:, 2] > 0
    diffuse, highlight = light_places((x, y, z), normalised((a, b, c)), gloss, group_powers(lit, gloss, power), scene)
    diffuse[~lit] = 1.0
    color = own * diffuse + highlight * ONE
    seen = groups[0].copy()
    seen[rows, columns, :3] = np.clip(color.astype(np.float32), 0.0, ONE).astype(np.int64)
    return seen
