"""What a name of a vocabulary does to a face, as displacements of its points."""

from __future__ import annotations

import numpy as np

from mien.core import Drawing, Face, Mesh
from mien.core.mesh import Points

from .posing import pose_from
from .rules import companions
from .vocabulary import vocabulary

FULL_DEG = 10.0
"""What counts as the fullest of a name that is counted in degrees: our choice."""


def displacement(vocabulary_name: str, name: str, face: Face) -> Points:
    """(V, 3) m that a name moves the points of a face at its fullest, beyond what its companions do.

    Of a drawing (V, 2) in its own units. An outline that has other points then than at rest, such as a line that
    vanishes, counts as still.

    Args:
        vocabulary_name: the vocabulary.
        name: one of its names.
        face: who plays it.

    Raises:
        UnknownNameError: there is no such vocabulary or name.
        MienError: there is no table for the vocabulary.
    """
    row, beside = vocabulary(vocabulary_name)[name], companions(vocabulary_name, name)
    full = FULL_DEG if row.unit == "deg" else row.high
    before, after = (face.shape(pose_from(vocabulary_name, each, face)) for each in (beside, {**beside, name: full}))
    if isinstance(before, Mesh) and isinstance(after, Mesh):
        return after.points - before.points
    return np.concatenate(
        [
            end - start if rest.shape == start.shape == end.shape else np.zeros(rest.shape)
            for rest, start, end in zip(*map(_outlines, (face.shape(face.neutral), before, after)), strict=True)
        ]
    )


def longest(field: Points) -> float:
    """How far the point moves which moves most: mm of displacements (V, 3) m, drawing units of (V, 2)."""
    way = float(np.sqrt((field * field).sum(axis=1).max()))
    return 1000.0 * way if field.shape[1] == 3 else way


def angle_deg(field: Points, other: Points) -> float:
    """Angle between two fields (V, 3) or (V, 2) as vectors of all their numbers: 0 where they do the same, 90 where
    they share nothing.

    A field that moves nothing is at 90 degrees to every other.
    """
    lengths = float(np.linalg.norm(field) * np.linalg.norm(other))
    if lengths == 0.0:
        return 90.0
    return float(np.degrees(np.arccos(np.clip((field * other).sum() / lengths, -1.0, 1.0))))


def _outlines(shape: Mesh | Drawing) -> list[Points]:
    """(N, 2) points of each path, its contours one after the other."""
    paths = shape.paths if isinstance(shape, Drawing) else ()
    return [np.concatenate([np.zeros((0, 2)), *path.contours]) for path in paths]
