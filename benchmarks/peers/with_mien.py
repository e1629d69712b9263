"""Ours. It makes its own normals, lights in linear light and encodes to sRGB; the others do none of this."""

from __future__ import annotations

from importlib.metadata import version

import numpy as np

from mien.core import Light, Material, Mesh, Scene, build_topology
from mien.render import Renderer as MienRenderer

from .setting import AMBIENT, BACKGROUND, DIFFUSE, EYE, FOV_DEG, LIGHT, POWER, SIDE_PX, SPECULAR, Bytes, Form


def linear(display: Bytes | object) -> np.ndarray:
    """Linear light of display values 0..1.

    Source: IEC 61966-2-1 (sRGB).
    """
    value = np.asarray(display, dtype=np.float64)
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


def scene() -> Scene:
    """The setting as a scene of ours."""
    behind = (*(float(c) for c in linear(BACKGROUND)), 1.0)
    x, y, z = (float(c) for c in 100.0 * LIGHT)
    return Scene(
        position=(float(EYE[0]), float(EYE[1]), float(EYE[2])),
        at=(0.0, 0.0, 0.0),
        fov_deg=FOV_DEG,
        size_px=(SIDE_PX, SIDE_PX),
        background=(behind, behind),
        lights=(Light((x, y, z), (DIFFUSE,) * 3),),
        ambient=((AMBIENT,) * 3, (AMBIENT,) * 3),
    )


class Renderer:
    """mien's own."""

    def __init__(self, samples: int, threads: int) -> None:
        self.name = f"mien {version('mien')}"
        self._renderer = MienRenderer(scene(), threads, samples=samples)

    def load(self, form: Form) -> None:
        """Points in double precision, as faces give them."""
        skin = Material(gloss=SPECULAR / DIFFUSE, gloss_power=POWER)
        self._points = [np.ascontiguousarray(points, dtype=np.float64) for points in form.points]
        topology = build_topology(form.points.shape[1], [("form", form.triangles, skin)])
        self._mesh = Mesh(topology, self._points[0], linear(form.colors))

    def draw(self, frame: int) -> Bytes:
        """(H, W, 4) RGBA."""
        return self._renderer.draw_mesh(self._mesh.moved(self._points[frame]))

    def upright(self, picture: Bytes) -> Bytes:
        """Its colours."""
        return picture[:, :, :3]
