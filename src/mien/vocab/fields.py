"""What a name of a vocabulary does to a face, as displacements of its points."""

from __future__ import annotations

import numpy as np

from mien.core import Drawing, Face, MienError, Pose
from mien.core.mesh import Points

from .posing import pose_from
from .rules import companions


def displacement(vocabulary: str, name: str, face: Face) -> Points:
    """(V, 3) m that a name moves the points of a face at its fullest, beyond what its companions do.

    Raises:
        UnknownNameError: there is no such vocabulary or name.
        MienError: the face has no mesh, or no table for the vocabulary.
    """
    beside = companions(vocabulary, name)
    before = _points(face, pose_from(vocabulary, beside, face))
    return _points(face, pose_from(vocabulary, {**beside, name: 1.0}, face)) - before


def longest_mm(field: Points) -> float:
    """Millimetres that the point moves which moves most, of displacements (V, 3) m."""
    return 1000.0 * float(np.sqrt((field * field).sum(axis=1).max()))


def angle_deg(field: Points, other: Points) -> float:
    """Angle between two fields (V, 3) as vectors of 3 V numbers: 0 where they do the same, 90 where they share nothing.

    A field that moves nothing is at 90 degrees to every other.
    """
    lengths = float(np.linalg.norm(field) * np.linalg.norm(other))
    if lengths == 0.0:
        return 90.0
    return float(np.degrees(np.arccos(np.clip((field * other).sum() / lengths, -1.0, 1.0))))


def _points(face: Face, pose: Pose) -> Points:
    shape = face.shape(pose)
    if isinstance(shape, Drawing):
        raise MienError(f"{face.name}: is a flat drawing and has no points to compare")
    return shape.points
