"""A head-like form of any number of triangles that opens its mouth, lifts its brows and turns: what renderers draw."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from peers.setting import Form

Floats = NDArray[np.float64]

FRAMES = 24

GRIDS = {800: (25, 17), 5_000: (50, 51), 50_000: (200, 126)}
"""Triangles -> meridians, and steps from pole to pole: triangles = 2 meridians (steps - 1)."""

RADII_M = (0.082, 0.122, 0.102)

BUMPS = (  # direction, width, height as a share of the radius
    ((0.0, -0.04, 1.0), 0.13, 0.22),  # nose
    ((0.34, 0.24, 0.9), 0.16, -0.10),  # eyes
    ((-0.34, 0.24, 0.9), 0.16, -0.10),
    ((0.0, -0.76, 0.64), 0.20, 0.11),  # chin
    ((0.0, -0.43, 0.9), 0.12, 0.05),  # lips
    ((0.98, 0.0, -0.1), 0.10, 0.18),  # ears
    ((-0.98, 0.0, -0.1), 0.10, 0.18),
)

SKIN, HAIR, LIP, EYE = (0.86, 0.66, 0.55), (0.25, 0.16, 0.10), (0.75, 0.20, 0.20), (0.92, 0.92, 0.95)


def make_form(triangle_count: int) -> Form:
    """The form with one of the numbers of triangles in ``GRIDS``, moving through ``FRAMES`` frames."""
    meridians, steps = GRIDS[triangle_count]
    directions, triangles = _ball(meridians, steps)
    rest = directions * RADII_M
    rest *= 1.0 + sum(high * _near(directions, to, wide) for to, wide, high in BUMPS)[:, None]
    points = np.stack([_posed(directions, rest, k / FRAMES) for k in range(FRAMES)])
    normals = np.stack([_normals(frame, triangles) for frame in points])
    colors = _colors(directions)
    return Form(triangles, colors.astype(np.float32), points.astype(np.float32), normals.astype(np.float32))


def _ball(meridians: int, steps: int) -> tuple[Floats, NDArray[np.int32]]:
    down, around = np.meshgrid(
        np.pi * np.arange(1, steps) / steps, 2.0 * np.pi * np.arange(meridians) / meridians, indexing="ij"
    )
    rings = np.stack([np.sin(down) * np.sin(around), np.cos(down), np.sin(down) * np.cos(around)], axis=2)
    directions = np.concatenate([[[0.0, 1.0, 0.0]], rings.reshape(-1, 3), [[0.0, -1.0, 0.0]]])
    number = 1 + np.arange((steps - 1) * meridians).reshape(steps - 1, meridians)
    beside = np.roll(number, -1, axis=1)
    upper, upper_beside, lower, lower_beside = number[:-1], beside[:-1], number[1:], beside[1:]
    top, bottom = np.zeros(meridians, dtype=int), np.full(meridians, len(directions) - 1)
    triangles = [
        np.stack([top, number[0], beside[0]], axis=1),
        np.stack([upper, lower, lower_beside], axis=2).reshape(-1, 3),
        np.stack([upper, lower_beside, upper_beside], axis=2).reshape(-1, 3),
        np.stack([bottom, beside[-1], number[-1]], axis=1),
    ]
    return directions, np.concatenate(triangles).astype(np.int32)


def _near(directions: Floats, to: tuple[float, float, float], wide: float) -> Floats:
    """(V,) 1 in the direction ``to``, falling to 0 around it."""
    apart = directions - to
    return np.exp(-(apart * apart).sum(axis=1) / (2.0 * wide * wide))


def _posed(directions: Floats, rest: Floats, phase: float) -> Floats:
    """(V, 3) m at a phase of the movement, 0..1."""
    open_mouth, up = 0.5 - 0.5 * np.cos(4.0 * np.pi * phase), np.sin(2.0 * np.pi * phase)
    points = rest.copy()
    jaw = np.clip((-0.25 - directions[:, 1]) / 0.5, 0.0, 1.0) * np.clip(2.0 * directions[:, 2], 0.0, 1.0)
    points[:, 1] -= 0.012 * open_mouth * jaw
    points[:, 2] -= 0.005 * open_mouth * jaw
    points[:, 1] += 0.006 * up * _near(directions, (0.0, 0.45, 0.9), 0.25)
    turn = 0.2 * up
    x, z = points[:, 0].copy(), points[:, 2].copy()
    points[:, 0] = np.cos(turn) * x + np.sin(turn) * z
    points[:, 2] = np.cos(turn) * z - np.sin(turn) * x
    return points


def _normals(points: Floats, triangles: NDArray[np.int32]) -> Floats:
    a, b, c = (points[triangles[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    total = np.zeros_like(points)
    for k in range(3):
        np.add.at(total, triangles[:, k], across)
    return total / np.linalg.norm(total, axis=1)[:, None]


def _colors(directions: Floats) -> Floats:
    x, y, z = directions.T
    colors = np.tile(SKIN, (len(directions), 1))
    colors[(y > 0.62) | ((z < -0.1) & (y > -0.3))] = HAIR
    colors[(np.abs(x) < 0.28) & (np.abs(y + 0.43) < 0.08) & (z > 0.3)] = LIP
    colors[((np.abs(x) - 0.32) ** 2 + (y - 0.24) ** 2 < 0.012) & (z > 0.2)] = EYE
    return colors
