"""A camera of the pair, by parameters that stay tame when it stands far away."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mien.core.mesh import Points

from .records import Camera, Lens

PITCH, YAW, ROLL, RIGHTWARDS, DOWNWARDS, SCALE, NEARNESS = range(7)
"""Parameters of a view: three turns about the camera's x, y and z (rad), where the face's origin is seen (px from the
middle of the picture), ln of px per metre there, and ln of one over the distance from there (1/m). The focal length is
the scale times the distance: a picture of a face tells its scale well, its perspective a little, and their product no
better than the perspective. At
``FLAT`` the view is orthographic."""

COUNT = 7
FLAT = -math.inf
FAR_M = 1e4
"""Where an orthographic camera is said to stand: perspective is then less than a hundred-thousandth of the face."""


@dataclass(frozen=True, eq=False)
class View:
    """A camera before the face.

    Attributes:
        base: (3, 3) rows are its axes in the frame of the head when it is not turned.
        values: (7,) parameters.
    """

    base: Points
    values: Points

    @property
    def rotation(self) -> Points:
        """(3, 3) rows are the axes of the camera in the frame of the head."""
        return rotation_about(self.values[:3]) @ self.base

    @property
    def scale(self) -> float:
        """Px per metre at the origin."""
        return math.exp(self.values[SCALE])

    @property
    def nearness(self) -> float:
        """One over the distance from the origin, 1/m; 0 without perspective."""
        return math.exp(self.values[NEARNESS])

    def seen(self, places: Points) -> Points:
        """(N, 2) px from the middle of the picture, of places (N, 3)."""
        turned = places @ self.rotation.T
        return (self.values[RIGHTWARDS : DOWNWARDS + 1] + self.scale * turned[:, :2]) / self._recession(turned)

    def slopes(self, places: Points) -> Points:
        """(N, 2, 3) px per metre: how the pictures of places move with them."""
        rotation = self.rotation
        turned = places @ rotation.T
        away = self._recession(turned)[:, :, None]
        to_depth = self.nearness * self.seen(places)[:, :, None] * rotation[2]
        return (self.scale * rotation[:2] - to_depth) / away

    def depths(self, places: Points) -> Points:
        """(N,) m, how far places lie behind the origin, along the optical axis."""
        return places @ self.rotation[2]

    def towards(self) -> Points:
        """(3,) from the origin to the camera, of a length near one."""
        offset = self.values[RIGHTWARDS : DOWNWARDS + 1] * self.nearness / self.scale
        return -np.array([*offset, 1.0]) @ self.rotation

    def _recession(self, turned: Points) -> Points:
        return 1.0 + self.nearness * turned[:, 2:]

    def camera(self, size_px: tuple[int, int]) -> Camera:
        """The same as a record, its optical axis through the middle of the picture."""
        distance = 1.0 / max(self.nearness, 1.0 / FAR_M)
        offset = self.values[RIGHTWARDS : DOWNWARDS + 1] / self.scale
        lens = Lens(self.scale * distance, (0.5 * size_px[0], 0.5 * size_px[1]), freed=("focal",))
        return Camera(lens, self.rotation, -np.array([*offset, distance]) @ self.rotation)


def base_of_front() -> Points:
    """(3, 3) axes of a camera straight before the face: the face's own left is on the right of the picture."""
    return np.diag([1.0, -1.0, -1.0])


def base_of_side(sign: int) -> Points:
    """(3, 3) axes of a camera at the face's own left (1) or right (-1)."""
    return np.array([[0.0, 0.0, -sign], [0.0, -1.0, 0.0], [-sign, 0.0, 0.0]])


def rotation_about(turn: Points) -> Points:
    """(3, 3) rotation about ``turn`` (3,) by its length in radians.

    Source: Rodrigues' formula.
    """
    angle = float(np.linalg.norm(turn))
    cross = np.array([[0.0, -turn[2], turn[1]], [turn[2], 0.0, -turn[0]], [-turn[1], turn[0], 0.0]])
    return np.eye(3) + np.sinc(angle / np.pi) * cross + 0.5 * np.sinc(0.5 * angle / np.pi) ** 2 * (cross @ cross)
