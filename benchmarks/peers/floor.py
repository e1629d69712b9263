"""The least that any renderer must do for a frame, on one thread: no light, no depth test, no edges, no overdraw.

Clear depth and colour; read every vertex, project it; read every triangle, see which way it turns; write depth and
colour of every covered pixel once; all into a new array. Which pixels those are it is told beforehand.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from .setting import BACKGROUND, SIDE_PX, Bytes, Form, projection_matrix, view_matrix
from .with_mien import Renderer as MienRenderer


@njit(nogil=True)
def touch(points, triangles, matrix, runs, places, depth, picture, behind, color):
    """How many triangles face the viewer, once everything was touched."""
    depth[:] = 0.0
    picture[:] = behind
    for v in range(len(points)):
        x, y, z = points[v, 0], points[v, 1], points[v, 2]
        inverse = np.float32(1.0) / (matrix[3, 0] * x + matrix[3, 1] * y + matrix[3, 2] * z + matrix[3, 3])
        places[v, 0] = (matrix[0, 0] * x + matrix[0, 1] * y + matrix[0, 2] * z + matrix[0, 3]) * inverse
        places[v, 1] = (matrix[1, 0] * x + matrix[1, 1] * y + matrix[1, 2] * z + matrix[1, 3]) * inverse
    seen = 0
    for t in range(len(triangles)):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        ax, ay = places[a, 0], places[a, 1]
        across = (places[b, 0] - ax) * (places[c, 1] - ay) - (places[c, 0] - ax) * (places[b, 1] - ay)
        seen += across > 0.0
    for r in range(len(runs)):
        row, first, last = runs[r, 0], runs[r, 1], runs[r, 2]
        depth[row, first:last] = 1.0
        picture[row, first:last] = color
    return seen


class Renderer:
    """Memory's own speed, in the form of a renderer."""

    def __init__(self, samples: int, threads: int) -> None:
        self.name = "memory floor"
        self._guide = MienRenderer(1, 1)
        self._matrix = projection_matrix() @ view_matrix()
        self._depth = np.empty((SIDE_PX, SIDE_PX), dtype=np.float32)
        self._behind = _packed(np.array([*BACKGROUND, 1.0]))

    def load(self, form: Form) -> None:
        """Which runs of pixels each frame covers."""
        self._form = form
        self._places = np.empty((form.points.shape[1], 2), dtype=np.float32)
        self._guide.load(form)
        background = self._guide.upright(self._guide.draw(0))[0, 0]
        self._runs = []
        for frame in range(len(form.points)):
            covered = (self._guide.upright(self._guide.draw(frame)) != background).any(axis=2)
            self._runs.append(_runs(covered))

    def draw(self, frame: int) -> Bytes:
        """(H, W, 4) RGBA, the form in one colour."""
        form, picture = self._form, np.empty((SIDE_PX, SIDE_PX), dtype=np.uint32)
        touch(
            form.points[frame],
            form.triangles,
            self._matrix,
            self._runs[frame],
            self._places,
            self._depth,
            picture,
            self._behind,
            np.uint32(0xFF8CA8DB),
        )
        return picture.view(np.uint8).reshape(SIDE_PX, SIDE_PX, 4)

    def upright(self, picture: Bytes) -> Bytes:
        """Its colours."""
        return picture[:, :, :3]


def _packed(rgba: np.ndarray) -> np.uint32:
    return np.rint(rgba * 255.0).astype(np.uint8).view(np.uint32)[0]


def _runs(covered: np.ndarray) -> np.ndarray:
    """(R, 3) row, first column, column after the last of every run of covered pixels."""
    bordered = np.zeros((SIDE_PX, SIDE_PX + 2), dtype=np.int8)
    bordered[:, 1:-1] = covered
    change = np.diff(bordered, axis=1)
    (rows, first), (_, last) = np.nonzero(change == 1), np.nonzero(change == -1)
    return np.stack([rows, first, last], axis=1).astype(np.int32)
