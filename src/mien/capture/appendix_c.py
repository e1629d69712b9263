"""Measuring as Appendix C of the thesis has it: a matrix each photograph, a place from several, by normal equations.

Source: Parke 1974, Appendix C. Numbers in brackets are those of his equations.
"""

from __future__ import annotations

import numpy as np

from mien.core.errors import MienError
from mien.core.mesh import Points

FEWEST = 6
SINGULAR = 1e-11
"""Pivot, over the largest number of its row, below which a system has no one solution."""


def transformation(places: Points, pictures: Points) -> Points:
    """(4, 3) matrix T with [x y z 1] T = w [u v 1] (1), from N places (N, 3) and where they are seen (N, 2).

    T43 is set to 1, so that the origin must not lie in the plane through the camera that is parallel to the picture:
    let it be amid the references.

    Raises:
        MienError: fewer than six points, points on one plane, or an origin in that plane.
    """
    places, pictures = np.asarray(places, dtype=np.float64), np.asarray(pictures, dtype=np.float64)
    if len(places) < FEWEST:
        raise MienError(
            f"Appendix C: 11 unknowns want five and a half reference points, got {len(places)}"
            " — click six or more in this photograph"
        )
    matrix, right = transformation_system(places, pictures)
    unknowns = solve_system(
        matrix.T @ matrix,
        matrix.T @ right,
        "Appendix C: the reference points do not tell the camera — they lie on one plane, or the origin lies in the"
        " plane of the camera (T43 = 0): click points off that plane, or move the origin amid the references",
    )
    return np.append(unknowns, 1.0).reshape(3, 4).T


def transformation_system(places: Points, pictures: Points) -> tuple[Points, Points]:
    """(2N, 11) and (2N,): the equations (7), first all of u, then all of v."""
    ones, zeros = np.ones((len(places), 1)), np.zeros((len(places), 4))
    near = np.hstack([places, ones])
    u, v = pictures[:, :1], pictures[:, 1:]
    matrix = np.vstack([np.hstack([near, zeros, -u * places]), np.hstack([zeros, near, -v * places])])
    return matrix, pictures.T.reshape(-1)


def picture(matrix: Points, places: Points) -> Points:
    """(N, 2) where a matrix (4, 3) sees places (N, 3), by (1)."""
    seen = np.column_stack([places, np.ones(len(places))]) @ matrix
    return seen[:, :2] / seen[:, 2:]


def location_system(matrices: Points, pictures: Points) -> tuple[Points, Points]:
    """(2n, 3) and (2n,): the planes (3), (5) of one point in n views, matrices (n, 4, 3) and pictures (n, 2)."""
    planes = matrices[:, :, :2] - matrices[:, :, 2:] * pictures[:, None, :]
    return planes[:, :3].transpose(0, 2, 1).reshape(-1, 3), -planes[:, 3].reshape(-1)


def locate(matrices: Points, pictures: Points) -> Points:
    """(3,) place of a point seen at (n, 2) in n views of matrices (n, 4, 3), by (5) and (6).

    Raises:
        MienError: one view, or views from which it is seen along one line.
    """
    matrices, pictures = np.asarray(matrices, dtype=np.float64), np.asarray(pictures, dtype=np.float64)
    if len(matrices) < 2:
        raise MienError("Appendix C: a point must be seen in two views, got one — click it in another photograph")
    planes, right = location_system(matrices, pictures)
    return solve_system(
        planes.T @ planes,
        planes.T @ right,
        "Appendix C: the views see the point along one line — photograph it from another side",
    )


def solve_system(matrix: Points, right: Points, trouble: str) -> Points:
    """(n,) solution of n equations by Gaussian elimination with partial pivoting, as he advises.

    Raises:
        MienError: there is not one solution; ``trouble`` says why.
    """
    rows = np.column_stack([matrix, right]).astype(np.float64)
    count = len(rows)
    # Rows and columns are scaled first, so that a small pivot tells trouble and not a unit.
    scale = np.sqrt(np.abs(np.diag(matrix)))
    if not (np.isfinite(rows).all() and (scale > 0.0).all()):
        raise MienError(trouble)
    rows[:, :count] /= scale[:, None] * scale[None, :]
    rows[:, count] /= scale
    for column in range(count):
        pivot = column + int(np.argmax(np.abs(rows[column:, column])))
        if abs(rows[pivot, column]) < SINGULAR:
            raise MienError(trouble)
        rows[[column, pivot]] = rows[[pivot, column]]
        below = rows[column + 1 :]
        below -= (below[:, column] / rows[column, column])[:, None] * rows[column]
    solution = np.zeros(count)
    for row in reversed(range(count)):
        solution[row] = (rows[row, count] - rows[row, row + 1 : count] @ solution[row + 1 :]) / rows[row, row]
    return solution / scale
