"""raylib with its software renderer rlsw. It knows no light, so colours are lit in NumPy before."""

from __future__ import annotations

import os
from importlib.metadata import version

import numpy as np

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
from raylib import ffi, rl

from .setting import (
    BACKGROUND,
    EYE,
    FAR_M,
    FOV_DEG,
    NEAR_M,
    SIDE_PX,
    Bytes,
    Form,
    light_vertices,
)

PERSPECTIVE = 0


class Renderer:
    """rlsw has no anti-aliasing."""

    def __init__(self, samples: int, threads: int) -> None:
        self.name = f"raylib_software {version('raylib_software')}"
        rl.SetTraceLogLevel(7)
        rl.InitWindow(SIDE_PX, SIDE_PX, b"picture")
        if not rl.IsWindowReady():
            raise RuntimeError("raylib opened no window, not even SDL's dummy")
        rl.rlSetClipPlanes(NEAR_M, FAR_M)
        rl.rlEnableBackfaceCulling()
        self._camera = ffi.new("Camera3D *", [list(EYE), [0.0, 0.0, 0.0], [0.0, 1.0, 0.0], FOV_DEG, PERSPECTIVE])[0]
        self._behind = [*(round(255 * c) for c in BACKGROUND), 255]
        self._surface = rl.LoadMaterialDefault()
        self._place = ffi.new("Matrix *")[0]
        for k in ("m0", "m5", "m10", "m15"):
            setattr(self._place, k, 1.0)

    def load(self, form: Form) -> None:
        """A mesh whose arrays are NumPy's."""
        self._form = form
        self._colors = np.full((form.points.shape[1], 4), 255, dtype=np.uint8)
        self._points = form.points[0].copy()
        self._triangles = form.triangles.astype(np.uint16)
        mesh = ffi.new("Mesh *")
        mesh.vertexCount, mesh.triangleCount = len(self._points), len(self._triangles)
        mesh.vertices = ffi.cast("float *", self._points.ctypes.data)
        mesh.colors = ffi.cast("unsigned char *", self._colors.ctypes.data)
        mesh.indices = ffi.cast("unsigned short *", self._triangles.ctypes.data)
        self._mesh = mesh

    def draw(self, frame: int) -> Bytes:
        """(H, W, 4) BGRA, last row first."""
        form = self._form
        np.copyto(self._points, form.points[frame])
        lit = light_vertices(form.points[frame], form.normals[frame], form.colors)
        self._colors[:, :3] = lit * np.float32(255.0)
        rl.ClearBackground(self._behind)
        rl.BeginMode3D(self._camera)
        rl.DrawMesh(self._mesh[0], self._surface, self._place)
        rl.EndMode3D()
        pixels = rl.rlReadScreenPixels(SIDE_PX, SIDE_PX)
        picture = np.empty((SIDE_PX, SIDE_PX, 4), dtype=np.uint8)
        ffi.memmove(picture, pixels, picture.nbytes)
        rl.MemFree(pixels)
        return picture

    def upright(self, picture: Bytes) -> Bytes:
        """Turned over, red first."""
        return picture[::-1, :, 2::-1]
