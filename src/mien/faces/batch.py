"""Points of many poses at once, of any face."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from mien.core import Drawing, Face, MienError, Pose, RangeError

Floats = NDArray[np.float64]


@runtime_checkable
class BatchFace(Protocol):
    """A face with a faster way than one pose after the other."""

    def shapes(self, values: Floats, threads: int = 1) -> Floats:
        """(N, V, 3) m, the points of poses (N, P): those of ``shape`` to rounding."""


def shapes(face: Face, values: Floats, threads: int = 1) -> Floats:
    """The points of many poses of a face, to rounding those of ``shape``: (N, V, 3) m, or (N, V, 2) of a drawing.

    A head's take some 150 KB a pose.

    Args:
        face: any.
        values: (N, P), a pose of its table a row.
        threads: how many share the poses out, where the face has a batch form of its own.

    Raises:
        MienError: the values do not fit the table.
        RangeError: so many threads cannot be had.
    """
    if not 1 <= threads <= 256:
        raise RangeError(f"{threads} threads cannot be had — it is 1 to 256")
    values = np.ascontiguousarray(values, dtype=np.float64)
    if values.ndim != 2 or values.shape[1] != len(face.parameters):
        wanted = f"wanted (N, {len(face.parameters)})"
        raise MienError(f"values of shape {values.shape} are no poses of {face.name}, {wanted}")
    if isinstance(face, BatchFace):
        return face.shapes(values, threads)
    # The neutral pose says how many points there are, even where no pose is asked for.
    out = np.empty((len(values), *_points(face, face.neutral).shape))
    for points, row in zip(out, values, strict=True):
        points[:] = _points(face, Pose(face.parameters, row))
    return out


def _points(face: Face, pose: Pose) -> Floats:
    """(V, 3) or (V, 2): a drawing's contours one after the other."""
    shape = face.shape(pose)
    if isinstance(shape, Drawing):
        return np.concatenate([contour for path in shape.paths for contour in path.contours])
    return shape.points
