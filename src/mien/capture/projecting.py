"""Where a camera sees a place, and which way it looks at a pixel."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from mien.capture.records import Camera, Lens
from mien.core.mesh import Points

LENS_TERMS = 8
"""Numbers of a lens in arrays: focal length, principal u and v (px), k1, k2, p1, p2, aspect less 1."""


def lens_array(lens: Lens) -> Points:
    """(8,) numbers of a lens: focal length, principal u and v, k1, k2, p1, p2, aspect less 1."""
    return np.array([lens.focal_px, *lens.principal_px, lens.k1, lens.k2, lens.p1, lens.p2, lens.aspect - 1.0])


def lens_record(terms: Points, freed: tuple[str, ...] = ()) -> Lens:
    """The lens of (8,) numbers."""
    focal, u, v, k1, k2, p1, p2, taller = (float(term) for term in terms)
    return Lens(focal_px=focal, principal_px=(u, v), k1=k1, k2=k2, freed=freed, p1=p1, p2=p2, aspect=1.0 + taller)


def in_frame(camera: Camera, places: Points) -> Points:
    """(N, 3) m in the camera's frame of (N, 3) m in the world."""
    return (np.asarray(places, dtype=np.float64) - camera.place) @ camera.rotation.T


def project(camera: Camera, places: Points) -> Points:
    """(N, 2) px where (N, 3) m places are seen; NaN for those that are not before the camera."""
    frame = in_frame(camera, places)
    with np.errstate(divide="ignore", invalid="ignore"):
        pictures = see(lens_array(camera.lens), frame)
    pictures[frame[:, 2] <= 0.0] = np.nan
    return pictures


def see(lenses: Points, frame: Points) -> Points:
    """(..., 2) px of (..., 3) m in camera frames, by (8,) or (..., 8) lenses.

    Source: Brown 1971.
    """
    directions = frame[..., :2] / frame[..., 2:]
    square = (directions * directions).sum(axis=-1)
    stretch = 1.0 + square * (lenses[..., 3] + square * lenses[..., 4])
    bent = stretch[..., None] * directions + _decentred(directions, lenses[..., 5], lenses[..., 6])
    bent[..., 1] *= 1.0 + lenses[..., 7]
    return lenses[..., 1:3] + lenses[..., :1] * bent


def _decentred(directions: Points, p1: Points, p2: Points) -> Points:
    """(..., 2), by how much decentring moves directions (..., 2)."""
    x, y = directions[..., 0], directions[..., 1]
    square, cross = x * x + y * y, 2.0 * x * y
    return np.stack([p1 * cross + p2 * (square + 2.0 * x * x), p1 * (square + 2.0 * y * y) + p2 * cross], axis=-1)


def see_slopes(lenses: Points, frame: Points) -> tuple[Points, Points, Points]:
    """What ``see`` gives (N, 2), and its slopes by the lens (N, 2, 8) and by the place in the frame (N, 2, 3)."""
    inverse = 1.0 / frame[:, 2]
    directions = frame[:, :2] * inverse[:, None]
    square = (directions * directions).sum(axis=1)
    stretch = 1.0 + square * (lenses[:, 3] + square * lenses[:, 4])
    focal, p1, p2 = lenses[:, 0], lenses[:, 5], lenses[:, 6]
    by_lens = np.zeros((len(frame), 2, LENS_TERMS))
    by_lens[:, :, 0] = directions * stretch[:, None] + _decentred(directions, p1, p2)
    by_lens[:, :, 3] = directions * (focal * square)[:, None]
    by_lens[:, :, 4] = by_lens[:, :, 3] * square[:, None]
    by_lens[:, :, 5] = _decentred(directions, focal, np.zeros_like(focal))
    by_lens[:, :, 6] = _decentred(directions, np.zeros_like(focal), focal)
    bend = 2.0 * (lenses[:, 3] + 2.0 * square * lenses[:, 4])
    by_direction = bend[:, None, None] * directions[:, :, None] * directions[:, None, :]
    by_direction[:, 0, 0] += stretch
    by_direction[:, 1, 1] += stretch
    x, y = directions.T
    by_direction[:, 0, 0] += 2.0 * p1 * y + 6.0 * p2 * x
    by_direction[:, 1, 1] += 6.0 * p1 * y + 2.0 * p2 * x
    by_direction[:, 0, 1] += 2.0 * (p1 * x + p2 * y)
    by_direction[:, 1, 0] += 2.0 * (p1 * x + p2 * y)
    by_frame = np.empty((len(frame), 2, 3))
    by_frame[:, :, :2] = by_direction * (focal * inverse)[:, None, None]
    by_frame[:, :, 2] = -np.einsum("nij,nj->ni", by_frame[:, :, :2], directions)
    by_lens[:, 1, 7] = focal * by_lens[:, 1, 0]
    aspect = 1.0 + lenses[:, 7, None]
    by_lens[:, 1, :7] *= aspect
    by_frame[:, 1] *= aspect
    by_lens[:, 0, 1] = by_lens[:, 1, 2] = 1.0
    return lenses[:, 1:3] + focal[:, None] * by_lens[:, :, 0], by_lens, by_frame


def fold(k1: float, k2: float) -> float:
    """The radius of a direction beyond which radial terms turn the picture back; infinite where they do not."""
    # Of r (1 + k1 r² + k2 r⁴) the slope is 1 + 3 k1 r² + 5 k2 r⁴.
    inside = 9.0 * k1 * k1 - 20.0 * k2
    below = -3.0 * k1 + math.sqrt(inside) if inside >= 0.0 else 0.0
    return math.sqrt(2.0 / below) if below > 1e-12 else math.inf


def undistort(lens: Lens, pictures: Points) -> Points:
    """(N, 2) directions (x/z, y/z) that are seen at (N, 2) px; beyond the ``fold`` those at it."""
    seen = (np.asarray(pictures, dtype=np.float64) - lens.principal_px) / (lens.focal_px * np.array([1.0, lens.aspect]))
    directions = _straightened(lens, seen)
    if lens.p1 or lens.p2:
        for _ in range(20):
            before = directions
            directions = _straightened(lens, seen - _decentred(before, np.array(lens.p1), np.array(lens.p2)))
            if not directions.size or np.abs(directions - before).max() < 1e-14:
                break
    return directions


def _straightened(lens: Lens, seen: Points) -> Points:
    """(N, 2) directions that radial terms move to (N, 2)."""
    wanted = np.hypot(seen[:, 0], seen[:, 1])
    limit = fold(lens.k1, lens.k2)
    radius = np.minimum(wanted, limit)
    for _ in range(30):
        square = radius * radius
        value = radius * (1.0 + square * (lens.k1 + square * lens.k2)) - wanted
        slope = np.maximum(1.0 + square * (3.0 * lens.k1 + 5.0 * square * lens.k2), 1e-3)
        step = value / slope
        radius = np.clip(radius - step, 0.0, limit)
        if not step.size or np.abs(step).max() < 1e-14:
            break
    scale = np.divide(radius, wanted, out=np.ones_like(wanted), where=wanted > 0.0)
    return seen * scale[:, None]


def rays(camera: Camera, pictures: Points) -> Points:
    """(N, 3) directions in the world, of length 1, from the camera's place to what is seen at (N, 2) px."""
    directions = undistort(camera.lens, pictures)
    frame = np.column_stack([directions, np.ones(len(directions))])
    return (frame / np.linalg.norm(frame, axis=1, keepdims=True)) @ camera.rotation


def turn(vectors: Points) -> Points:
    """(..., 3, 3) rotations about (..., 3) vectors by their length in radians.

    Source: Rodrigues' formula.
    """
    vectors = np.asarray(vectors, dtype=np.float64)
    square = (vectors * vectors).sum(axis=-1)[..., None, None]
    angle = np.sqrt(square)
    small = angle < 1e-4
    safe = np.where(small, 1.0, angle)
    first = np.where(small, 1.0 - square / 6.0, np.sin(safe) / safe)
    second = np.where(small, 0.5 - square / 24.0, (1.0 - np.cos(safe)) / (safe * safe))
    cross = cross_matrices(vectors)
    return np.eye(3) + first * cross + second * (cross @ cross)


def turn_slopes(vectors: Points, slopes: Points) -> Points:
    """(N, K, 3) slopes by a turn of vectors (N, 3) about their origin, v × slope, of slopes (N, K, 3) by them."""
    x, y, z = (vectors[:, axis, None] for axis in range(3))
    a, b, c = (slopes[:, :, axis] for axis in range(3))
    return np.stack([y * c - z * b, z * a - x * c, x * b - y * a], axis=2)


def cross_matrices(vectors: Points) -> NDArray[np.float64]:
    """(..., 3, 3) matrices M with M @ w = v × w of (..., 3) vectors v."""
    result = np.zeros((*vectors.shape, 3))
    result[..., 0, 1], result[..., 0, 2] = -vectors[..., 2], vectors[..., 1]
    result[..., 1, 0], result[..., 1, 2] = vectors[..., 2], -vectors[..., 0]
    result[..., 2, 0], result[..., 2, 1] = -vectors[..., 1], vectors[..., 0]
    return result
