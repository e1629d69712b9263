"""What all renderers agree on: picture, camera, light, and a form whose points change from frame to frame."""

from __future__ import annotations

from dataclasses import dataclass, fields
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Bytes = NDArray[np.uint8]

SIDE_PX = 1024

EYE = np.array([0.13, 0.07, 1.10])
FOV_DEG = 17.2
NEAR_M, FAR_M = 0.5, 2.0
"""The camera stands at EYE and looks at the origin, metres; y is up."""

LIGHT = np.array([0.4, 0.5, 0.76811457])
"""Unit vector towards the only light, far away."""

AMBIENT, DIFFUSE, SPECULAR, POWER = 0.15, 0.75, 0.25, 16
BACKGROUND = (0.20, 0.30, 0.60)
"""Display values, as the form's own colours."""


@dataclass(frozen=True, eq=False)
class Form:
    """A closed form and how it moves.

    Attributes:
        triangles: (T, 3) vertices, anticlockwise seen from outside.
        colors: (V, 3) display values 0..1.
        points: (N, V, 3) m, frame by frame.
        normals: (N, V, 3) unit normals of them.
    """

    triangles: NDArray[np.int32]
    colors: Floats
    points: Floats
    normals: Floats

    def write(self, path: Path) -> None:
        """Keep it as an .npz file."""
        np.savez(path, **{row.name: getattr(self, row.name) for row in fields(self)})

    @classmethod
    def read(cls, path: Path) -> Form:
        """What ``write`` kept."""
        with np.load(path) as arrays:
            return cls(**{row.name: arrays[row.name] for row in fields(cls)})


class Peer(Protocol):
    """A renderer at work; modules of this package have one, called ``Renderer``.

    Attributes:
        name: what it is, with its version and what it runs on.
    """

    name: str

    def __init__(self, samples: int, threads: int) -> None: ...

    def load(self, form: Form) -> None:
        """Get ready to draw this form; not part of the time of a frame."""

    def draw(self, frame: int) -> Bytes:
        """The picture of a frame, from new points to pixels in NumPy, in whatever order they come."""

    def upright(self, picture: Bytes) -> Bytes:
        """(H, W, 3) RGB, first row on top, of what ``draw`` gave."""


def view_matrix() -> Floats:
    """(4, 4) from the world to the camera's frame, which looks along -z."""
    back = EYE / np.linalg.norm(EYE)
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(back, right), back])
    matrix = np.eye(4, dtype=np.float32)
    matrix[:3, :3], matrix[:3, 3] = axes, -axes @ EYE
    return matrix


def projection_matrix(*, zero_to_one: bool = False) -> Floats:
    """(4, 4) perspective of OpenGL, depth -1..1, or with depth 0..1."""
    focal = 1.0 / np.tan(np.radians(FOV_DEG) / 2.0)
    near, far = NEAR_M, FAR_M
    matrix = np.zeros((4, 4), dtype=np.float32)
    matrix[0, 0] = matrix[1, 1] = focal
    matrix[2, 2] = (far if zero_to_one else far + near) / (near - far)
    matrix[2, 3] = (far * near if zero_to_one else 2.0 * far * near) / (near - far)
    matrix[3, 2] = -1.0
    return matrix


def light_vertices(points: Floats, normals: Floats, colors: Floats) -> Floats:
    """(V, 3) lit colours, for a renderer that knows no light."""
    light = LIGHT.astype(np.float32)
    towards = EYE.astype(np.float32) - points
    half = towards / np.sqrt(np.einsum("vk,vk->v", towards, towards))[:, None] + light
    half /= np.sqrt(np.einsum("vk,vk->v", half, half))[:, None]
    cosine = normals @ light
    shine = np.maximum(np.einsum("vk,vk->v", normals, half), np.float32(0.0)) ** POWER * (cosine > 0.0)
    lit = AMBIENT + DIFFUSE * np.maximum(cosine, 0.0)
    return np.minimum(colors * lit[:, None] + SPECULAR * shine[:, None], np.float32(1.0))
