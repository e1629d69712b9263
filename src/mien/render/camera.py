"""The viewing transform: from the head's frame to the camera's, and on to a raster of 1/256 pixels.

Source: Parke 1972, section on the viewing transformation (camera position, centre of interest, angle of view).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.core import Scene, exact

Floats = NDArray[np.float64]
Vector = tuple[float, float, float]

SUBPIXELS = 256
"""Steps of a screen coordinate within one pixel of the raster. Whole numbers make the edge rule exact."""

NEAR_M = 0.01
"""Nothing nearer to the viewer than this is drawn, metres."""

FAR_OUT = float(2**24)
"""Places farther out than this, in 1/256 pixels, are brought here: they must fit 32 bits and mean nothing anyway."""


@dataclass(frozen=True)
class Camera:
    """A viewer with a raster before him.

    Attributes:
        position: (x, y, z) m.
        right, up, forward: unit vectors of the camera's own axes, in the head's frame.
        scale: pixels of the raster that one metre fills at a distance of one metre.
        width, height: pixels of the raster.
    """

    position: Vector
    right: Vector
    up: Vector
    forward: Vector
    scale: float
    width: int
    height: int

    @classmethod
    def of(cls, scene: Scene) -> Camera:
        """The camera of a scene."""
        forward = _unit(_minus(scene.at, scene.position))
        # Who looks straight up or down has no horizon: then the top of the picture is the back of the head's frame.
        level = abs(forward[0]) + abs(forward[2]) > 1e-6
        right = _unit(_cross(forward, (0.0, 1.0, 0.0) if level else (0.0, 0.0, -1.0)))
        half = math.radians(scene.fov_deg) / 2.0
        focal = float(exact.cos(half)) / float(exact.sin(half))
        width, height = scene.size_px
        scale = focal * min(width, height) / 2.0
        return cls(scene.position, right, _cross(right, forward), forward, scale, width, height)

    def view(self, points: Floats) -> Floats:
        """(V, 3) points in the camera's frame: right, up, forward, metres."""
        x, y, z = (points[:, k] - self.position[k] for k in range(3))
        out = np.empty((len(points), 3))
        for k, axis in enumerate((self.right, self.up, self.forward)):
            out[:, k] = (x * axis[0] + y * axis[1]) + z * axis[2]
        return out

    def project(self, view: Floats) -> tuple[NDArray[np.int32], Floats]:
        """Where points of the camera's frame fall: (V, 2) in 1/256 pixels, x right and y down, and 1 / depth (V,).

        Points nearer than the near plane, and points far outside of the picture, get a place without meaning.
        """
        inverse = 1.0 / np.maximum(view[:, 2], NEAR_M)
        places = np.empty((len(view), 2), dtype=np.int32)
        for k, (sign, side) in enumerate(((self.scale, self.width), (-self.scale, self.height))):
            pixels = side * 0.5 + (view[:, k] * sign) * inverse
            places[:, k] = np.rint(np.clip(pixels * SUBPIXELS, -FAR_OUT, FAR_OUT))
        return places, inverse


def _minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _unit(a: Vector) -> Vector:
    length = math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])
    return (a[0] / length, a[1] / length, a[2] / length)
