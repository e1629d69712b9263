"""Polygons of the classic skin that are nearly plane: how far each of its points leaves the reference for that."""

from __future__ import annotations

import sys
from itertools import pairwise
from pathlib import Path

import numpy as np

from mien.faces.head.measured import Archive

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))  # where the measure is that the tests use

from measuring.closest import vertex_normals

from planarity import smooth_quads

ROUNDS = 40
STEP_M = 1e-6
"""For differences."""

ALONG, ACROSS, UNEVEN = 0.7, 1.0, 0.5
"""What a move along the skin costs, one away from it, and one that a neighbour does not share."""

MOST_DEG = 5.5
"""What a smooth polygon may bend; one that bends by more is moved until it bends by this."""

DAMPED = 0.3
"""Share of the way that a round goes."""

FAR_M = 0.001
"""A move as long as that costs as much again."""

BEND_M = 0.1
"""A radian more costs as much as a point this far away."""


def flatten(arrays: dict[str, np.ndarray]) -> np.ndarray:
    """(V, 3) m, symmetric moves of the surface's points that make the polygons where it is smooth nearly plane.

    Ears, lips, lids, nostrils and the inside of the mouth stay as they are: what meets there goes on meeting.
    """
    face = Archive({name: np.asarray(array) for name, array in arrays.items()})
    points, flip = face.floats("surface"), np.array([-1.0, 1.0, 1.0])
    smooth, skin = smooth_quads(face), face.groups == face.group_names.index("skin")
    free = np.zeros(len(points), dtype=bool)
    free[face.quads[smooth]] = True
    free[face.quads[~skin]] = False
    free[face.ints("lid_index")] = False
    columns = np.flatnonzero(np.repeat(free, 3))
    stay = _staying(points, face.quads[skin])[np.ix_(columns, columns)]
    polygons, most = _cut(points, face.quads[smooth]), np.sin(np.radians(MOST_DEG))
    bent, moves = np.zeros(len(polygons), dtype=bool), np.zeros_like(points)
    for _ in range(ROUNDS):
        bends = _sines((points + moves)[polygons])
        bent |= np.abs(bends) > most
        rows = BEND_M * _slopes(points + moves, polygons[bent])[:, columns]
        excess = BEND_M * (bends - np.copysign(most, bends))[bent]
        wanted = rows @ moves.ravel()[columns] - excess
        far = np.repeat((np.linalg.norm(moves, axis=1) / FAR_M) ** 2, 3)[columns]
        found = np.zeros_like(points)
        found.ravel()[columns] = np.linalg.solve(stay + np.diag(far) + rows.T @ rows, rows.T @ wanted)
        moves += DAMPED * (0.5 * (found + found[face.mirror] * flip) - moves)
    return moves


def left_half(arrays: dict[str, np.ndarray]) -> np.ndarray:
    """(K, 4) vertices of the polygons on the left where it is smooth."""
    face = Archive({name: np.asarray(array) for name, array in arrays.items()})
    quads = face.quads[smooth_quads(face)]
    return quads[face.floats("surface")[quads, 0].sum(axis=1) > 0.0]


def _staying(points: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """(3 V, 3 V) quadratic cost of moves as such."""
    normals = vertex_normals(points, np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]]))
    cost = np.zeros((len(points), 3, len(points), 3))
    each = np.arange(len(points))
    across = normals[:, :, None] * normals[:, None, :]
    cost[each, :, each, :] = ALONG**2 * (np.eye(3) - across) + ACROSS**2 * across
    edges = {tuple(sorted(edge)) for row in quads.tolist() for edge in pairwise([*row, row[0]])}
    for a, b in sorted(edges):
        for i, j, sign in ((a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)):
            cost[i, :, j, :] += sign * UNEVEN**2 * np.eye(3)
    return cost.reshape(3 * len(points), 3 * len(points))


def _cut(points: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """The polygons (F, 4), those turned by a corner whose triangles bend less by the other diagonal."""
    bends = np.abs([_sines(points[np.roll(quads, -k, axis=1)]) for k in (0, 1)])
    return np.where((bends[1] < bends[0])[:, None], np.roll(quads, -1, axis=1), quads)


def _slopes(points: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """(F, 3 V) how the sines of polygons grow with the points."""
    corners, slopes = points[quads], np.zeros((len(quads), len(points), 3))
    for corner in range(4):
        for axis in range(3):
            step = np.zeros((4, 3))
            step[corner, axis] = STEP_M
            slope = (_sines(corners + step) - _sines(corners - step)) / (2.0 * STEP_M)
            slopes[np.arange(len(quads)), quads[:, corner], axis] = slope
    return slopes.reshape(len(quads), -1)


def _sines(corners: np.ndarray) -> np.ndarray:
    """(F,) sine of the angle between the triangles on both sides of the diagonal from the first corner (F, 4, 3)."""
    b, c, d = (corners[:, k] - corners[:, 0] for k in (1, 2, 3))
    first, second = np.cross(b, c), np.cross(c, d)
    size = np.linalg.norm(first, axis=1) * np.linalg.norm(second, axis=1)
    return (np.cross(first, second) * c).sum(axis=1) / (size * np.linalg.norm(c, axis=1))
