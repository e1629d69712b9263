"""First guesses by linear algebra: a camera from points of known places, a place from cameras."""

from __future__ import annotations

import numpy as np

from mien.capture.records import Camera, Lens
from mien.core.errors import MienError
from mien.core.mesh import Points

FEWEST = 6
"""Points of known place that a camera of 11 unknowns needs (five and a half)."""


def homogeneous_matrix(places: Points, pictures: Points) -> Points:
    """(3, 4) matrix that takes places (N, 3) as columns (x, y, z, 1) to multiples of pictures (N, 2) as (u, v, 1).

    Both are moved and scaled first so that every column of the equations weighs alike. No entry is taken for 1: the
    origin may lie anywhere.

    Raises:
        MienError: fewer than six points, or points on one plane, where the matrix is not to be told.

    Source: Hartley and Zisserman 2004, algorithm 7.1.
    """
    places, pictures = np.asarray(places, dtype=np.float64), np.asarray(pictures, dtype=np.float64)
    if len(places) < FEWEST:
        raise MienError(
            f"a camera from points of known places: six or more are wanted, got {len(places)}"
            " — click more references in this photograph"
        )
    move_place, move_picture = _normalising(places), _normalising(pictures)
    near = np.column_stack([places, np.ones(len(places))]) @ move_place.T
    seen = np.column_stack([pictures, np.ones(len(pictures))]) @ move_picture.T
    zero = np.zeros_like(near)
    rows = np.concatenate([np.hstack([near, zero, -seen[:, :1] * near]), np.hstack([zero, near, -seen[:, 1:2] * near])])
    _, strengths, directions = np.linalg.svd(rows, full_matrices=False)
    if strengths[10] < 1e-9 * strengths[0]:
        raise MienError(
            "a camera from points of known places: these lie on one plane (or on a curve with the camera)"
            " — click references off that plane too"
        )
    return np.linalg.inv(move_picture) @ directions[11].reshape(3, 4) @ move_place


def _normalising(points: Points) -> Points:
    """(D + 1, D + 1) matrix that takes (N, D) points about the origin at a mean distance of √D."""
    count = points.shape[1]
    centre = points.mean(axis=0)
    spread = np.linalg.norm(points - centre, axis=1).mean()
    scale = np.sqrt(count) / spread if spread > 0.0 else 1.0
    matrix = np.eye(count + 1)
    matrix[:count, :count] *= scale
    matrix[:count, count] = -scale * centre
    return matrix


def metric_camera(matrix: Points, places: Points) -> Camera | None:
    """The camera of square pixels nearest to a (3, 4) matrix, before which places (N, 3) lie; None if there is none.

    The one focal length is the geometric mean of the two that the matrix tells; its skew is left out.

    Source: Hartley and Zisserman 2004, section 6.2.4.
    """
    left = matrix[:, :3]
    if abs(np.linalg.det(left)) < 1e-14 * np.linalg.norm(left) ** 3:
        return None
    depths = places @ matrix[2, :3] + matrix[2, 3]
    if np.median(depths) < 0.0:
        matrix, left = -matrix, -left
    place = -np.linalg.solve(left, matrix[:, 3])
    upper, rotation = _upper_times_rotation(left)
    if np.linalg.det(rotation) < 0.0:
        return None
    upper = upper / upper[2, 2]
    lens = Lens(
        focal_px=float(np.sqrt(upper[0, 0] * upper[1, 1])), principal_px=(float(upper[0, 2]), float(upper[1, 2]))
    )
    return Camera(lens=lens, rotation=rotation, place=np.asarray(place, dtype=np.float64))


def _upper_times_rotation(matrix: Points) -> tuple[Points, Points]:
    """An upper triangular matrix of positive diagonal and an orthogonal one, whose product is ``matrix``."""
    flip = np.eye(3)[::-1]
    orthogonal, triangular = np.linalg.qr((flip @ matrix).T)
    upper, rotation = flip @ triangular.T @ flip, flip @ orthogonal.T
    signs = np.where(np.diag(upper) < 0.0, -1.0, 1.0)
    return upper * signs, signs[:, None] * rotation


def nearest_to_rays(origins: Points, directions: Points) -> Points | None:
    """(3,) m nearest to n rays from origins (n, 3) m along directions (n, 3) of length 1; None where behind one.

    Squares of distances from the rays are weighed by the inverse square of how far the point is, as clicks count.
    """
    across = np.eye(3) - directions[:, :, None] * directions[:, None, :]
    weights = np.ones(len(origins))
    place = origins.mean(axis=0)
    for _ in range(2):
        weighed = across * weights[:, None, None]
        normal = weighed.sum(axis=0)
        values = np.linalg.eigvalsh(normal)
        if values[0] < 1e-10 * values[2]:
            return None
        place = np.linalg.solve(normal, np.einsum("nij,nj->i", weighed, origins))
        depths = ((place - origins) * directions).sum(axis=1)
        if (depths <= 0.0).any():
            return None
        weights = 1.0 / (depths * depths)
    return place
