"""Closest points of a surface, as rows of barycentric weights."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.spatial import cKDTree

from mien.core.mesh import Material, Topology, build_topology
from mien.core.subdivision import refine

NEAREST = 48
"""Triangles that are tried for each point: those whose centres are nearest."""
WRONG_SIDE_M = 0.05
"""Distance that is added to a triangle which faces another way than the point's own skin: the other lip, say."""
AGREEING = 0.2
"""Cosine between two normals from which on they face the same way."""


def topology_of(polygons: np.ndarray, vertex_count: int) -> Topology:
    """The topology of polygons (F, 4), triangles padded by -1."""
    padded = np.where(polygons < 0, polygons[:, [0, 1, 2, 2]], polygons)
    return build_topology(vertex_count, [("skin", padded, Material(subdivide=True))])


def refinement(topology: Topology, levels: int) -> tuple[sp.csr_matrix, Topology]:
    """Matrix (V', V) of Catmull-Clark steps, and the topology that they lead to."""
    total = sp.identity(topology.vertex_count, format="csr")
    for _ in range(levels):
        fine = refine(topology)
        weights = (fine.matrix.weights, fine.matrix.columns, fine.matrix.starts)
        total = sp.csr_matrix(weights, shape=fine.matrix.shape) @ total
        topology = fine.topology
    return total, topology


def vertex_normals(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """(V, 3) unit normals, each the mean over its triangles by area."""
    normals = np.zeros_like(points)
    for corner in range(3):
        np.add.at(normals, triangles[:, corner], _cross(points[triangles]))
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)


def bind(points: np.ndarray, normals: np.ndarray, surface: np.ndarray, triangles: np.ndarray) -> sp.csr_matrix:
    """Weights (P, V) that make the point of a surface closest to each point, on a side that faces the same way.

    Args:
        points: (P, 3) m.
        normals: (P, 3) unit normals of the skin that they belong to.
        surface: (V, 3) m.
        triangles: (T, 3) vertices of the surface.
    """
    corners = surface[triangles]
    facing = _cross(corners)
    facing /= np.maximum(np.linalg.norm(facing, axis=1, keepdims=True), 1e-15)
    _, near = cKDTree(corners.mean(axis=1)).query(points, k=NEAREST)
    weights = _closest_weights(points[:, None], corners[near])
    distance = np.linalg.norm(np.einsum("pkc,pkcd->pkd", weights, corners[near]) - points[:, None], axis=2)
    distance += WRONG_SIDE_M * (np.einsum("pkd,pd->pk", facing[near], normals) < AGREEING)
    row = np.arange(len(points))
    best = distance.argmin(axis=1)
    entries = (weights[row, best].ravel(), (np.repeat(row, 3), triangles[near[row, best]].ravel()))
    return sp.csr_matrix(entries, shape=(len(points), len(surface)))


def _cross(corners: np.ndarray) -> np.ndarray:
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def _closest_weights(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """(..., 3) barycentric weights of the point of each triangle (..., 3, 3) closest to a point (..., 3)."""
    inside = _plane_weights(points, corners)
    candidates = [np.where((inside >= 0).all(axis=-1)[..., None], inside, np.nan)]
    for a, b in ((0, 1), (1, 2), (2, 0)):
        edge = corners[..., b, :] - corners[..., a, :]
        length = np.maximum((edge**2).sum(axis=-1), 1e-18)
        along = np.clip(((points - corners[..., a, :]) * edge).sum(axis=-1) / length, 0.0, 1.0)
        weights = np.zeros((*along.shape, 3))
        weights[..., a], weights[..., b] = 1.0 - along, along
        candidates.append(weights)
    stack = np.stack(candidates)
    distance = ((np.einsum("npkc,pkcd->npkd", stack, corners) - points) ** 2).sum(axis=-1)
    best = np.nanargmin(distance, axis=0)
    return np.take_along_axis(stack, best[None, ..., None], axis=0)[0]


def _plane_weights(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """(..., 3) barycentric weights of the foot of the perpendicular to each triangle's plane."""
    u, v = corners[..., 1, :] - corners[..., 0, :], corners[..., 2, :] - corners[..., 0, :]
    w = points - corners[..., 0, :]
    uu, uv, vv = (u * u).sum(-1), (u * v).sum(-1), (v * v).sum(-1)
    wu, wv = (w * u).sum(-1), (w * v).sum(-1)
    size = np.maximum(uu * vv - uv * uv, 1e-24)
    s, t = (vv * wu - uv * wv) / size, (uu * wv - uv * wu) / size
    return np.stack([1.0 - s - t, s, t], axis=-1)
