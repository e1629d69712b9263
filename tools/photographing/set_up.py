"""The cube of strings and beads, four cameras, and a head that is held a little differently each time."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product

import cv2
import numpy as np

from mien.core import Light, Scene
from mien.render.camera import Camera as View

CUBE_M, CUBE_CENTRE = 0.42, np.array([0.0, -0.03, 0.0])
BEAD_M, STRING_M = 0.0028, 0.0005
SIZE_PX, MARGIN_PX = 2400, 48
FOCAL_PX = 5520.0
TURN_DEG, SHIFT_M = 1.6, 0.004
"""Standard deviations of how the head is held."""

LIGHTS = tuple(
    Light(place, (level,) * 3, 1.0)
    for place, level in (((1.5, 1.5, 2.5), 0.24), ((-1.5, 1.2, 2.5), 0.16), ((3.0, 0.6, -1.0), 0.18))
)
AMBIENT = ((0.50,) * 3, (0.62,) * 3)
"""Soft light from all sides, with which a surface is nearly as bright as its colour is."""


@dataclass(frozen=True, eq=False)
class Station:
    """A camera on its tripod.

    Attributes:
        name: of the camera.
        scene: what a lens without faults would take, on a larger picture.
        focal_px, principal_px, k1: of its lens.
    """

    name: str
    scene: Scene
    focal_px: float
    principal_px: tuple[float, float]
    k1: float

    @property
    def view(self) -> View:
        """Position and axes."""
        return View.of(self.scene)

    def project(self, points: np.ndarray) -> np.ndarray:
        """(N, 2) px where points (N, 3) m of the room are seen."""
        x, y, z = self.view.view(points).T
        x, y = x / z, -y / z
        bent = self.focal_px * (1.0 + self.k1 * (x * x + y * y))
        return np.stack([self.principal_px[0] + bent * x, self.principal_px[1] + bent * y], axis=1)

    def develop(self, picture: np.ndarray) -> np.ndarray:
        """(SIZE_PX, SIZE_PX, C) photograph, of a picture that a lens without faults took."""
        return cv2.remap(picture, *self._sources, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)

    @cached_property
    def _sources(self) -> np.ndarray:
        """(2, SIZE_PX, SIZE_PX) pixel of the faultless picture that each pixel of the photograph shows."""
        v, u = np.mgrid[0:SIZE_PX, 0:SIZE_PX] + 0.5
        seen = np.stack([u - self.principal_px[0], v - self.principal_px[1]]) / self.focal_px
        straight = seen.copy()
        for _ in range(8):
            straight = seen / (1.0 + self.k1 * (straight * straight).sum(axis=0))
        return (self.scene.size_px[0] / 2.0 + self.focal_px * straight - 0.5).astype(np.float32)


def stations(rng: np.random.Generator) -> tuple[Station, ...]:
    """Four cameras around the left half: before it, at its side, and behind it."""
    out = []
    rows = (("a", 3.0, -9.0, 1.62), ("b", 42.0, 13.0, 1.70), ("c", 88.0, -7.0, 1.66), ("d", 142.0, 15.0, 1.72))
    for name, around, up, distance in rows:
        around, up = around + rng.normal(0, 1.0), up + rng.normal(0, 1.0)
        focal = FOCAL_PX * (1.0 + 0.02 * rng.standard_normal())
        principal = SIZE_PX / 2.0 + rng.normal(0.0, 12.0, 2)
        side = SIZE_PX + 2 * MARGIN_PX
        scene = Scene(
            at=tuple(CUBE_CENTRE.tolist()),
            fov_deg=float(np.degrees(2.0 * np.arctan(side / 2.0 / focal))),
            size_px=(side, side),
            lights=LIGHTS,
            ambient=AMBIENT,
            background=((0.16, 0.18, 0.20, 1.0), (0.42, 0.45, 0.48, 1.0)),
            subdivide=0,
        ).turned(around, up, distance)
        scale = View.of(scene).scale
        out.append(
            Station(
                name,
                scene,
                scale,
                (float(principal[0]), float(principal[1])),
                float(-0.13 + 0.02 * rng.standard_normal()),
            )
        )
    return tuple(out)


def hold(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Turn (3, 3) and shift (3,) m of a head that cannot be kept still."""
    turn, _ = cv2.Rodrigues(np.radians(rng.normal(0.0, TURN_DEG, 3)))
    return turn, rng.normal(0.0, SHIFT_M, 3)


def beads() -> dict[str, np.ndarray]:
    """Name -> (3,) m: the corners of the cube and the middles of its edges."""
    out = {}
    for steps in product((-1, 0, 1), repeat=3):
        if steps.count(0) <= 1:
            out["bead_" + "".join("-0+"[step + 1] for step in steps)] = CUBE_CENTRE + 0.5 * CUBE_M * np.array(steps)
    return out


def strings() -> tuple[np.ndarray, np.ndarray]:
    """Points (N, 3) m and triangles (F, 3) of the twelve strings."""
    points, faces = [], []
    for axis in range(3):
        for a, b in product((-1, 1), repeat=2):
            ends = (
                np.insert(np.array([[a, b], [a, b]], dtype=float), axis, [-1, 1], axis=1) * 0.5 * CUBE_M + CUBE_CENTRE
            )
            _tube(ends, axis, points, faces)
    return np.array(points), np.array(faces)


def _tube(ends: np.ndarray, axis: int, points: list[np.ndarray], faces: list[tuple[int, int, int]]) -> None:
    first, sides = len(points), 5
    for end in ends:
        for k in range(sides):
            angle = 2.0 * np.pi * k / sides
            points.append(end + STRING_M * np.insert([np.cos(angle), np.sin(angle)], axis, 0.0))
    for k, n in pairwise([*range(sides), 0]):
        a, b, c, d = first + k, first + n, first + sides + n, first + sides + k
        faces += [(a, b, c), (a, c, d)]


def ball(centre: np.ndarray, radius: float) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles of a bead: an octahedron refined once."""
    corners = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]], dtype=float)
    faces = []
    for signs in product((1, -1), repeat=3):
        triangle = [corners[k if sign > 0 else k + 3] for k, sign in enumerate(signs)]
        if np.prod(signs) < 0:
            triangle = triangle[::-1]
        a, b, c = triangle
        ab, bc, ca = (each / np.linalg.norm(each) for each in (a + b, b + c, c + a))
        faces += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    points = np.array(faces).reshape(-1, 3)
    return centre + radius * points, np.arange(len(points)).reshape(-1, 3)
