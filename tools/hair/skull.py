"""The skull without ears as distances from a point inside it, and as distances from the head's upright axis."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import distance_transform_edt, gaussian_filter, map_coordinates

from mien.faces.head.measured import Archive

CENTRE = np.array([0.0, 0.025, 0.002])
AZIMUTHS, ELEVATIONS, HEIGHTS = 120, 75, 100
LOWEST, HIGHEST = -0.26, 0.11


def directions(azimuth: np.ndarray, elevation: np.ndarray) -> np.ndarray:
    """(..., 3) unit vectors: azimuth from straight ahead to the own left, elevation upwards, radians."""
    azimuth, elevation = np.broadcast_arrays(azimuth, elevation)
    flat = np.cos(elevation)
    return np.stack([np.sin(azimuth) * flat, np.sin(elevation), np.cos(azimuth) * flat], axis=-1)


class Skull:
    """Distances of the skin, looked up by direction or by height."""

    def __init__(self, archive: Archive) -> None:
        points, ear = archive.floats("surface"), archive.group_names.index("ear")
        quads = archive.quads[(archive.groups != ear) & (archive.groups != archive.group_names.index("mouth"))]
        skin = points[_triangles(quads)]
        collar = archive.floats("collar_points")[_triangles(archive.ints("collar_quads"))]
        azimuth = np.arange(AZIMUTHS) * 2.0 * np.pi / AZIMUTHS
        elevation = np.linspace(-np.pi / 2, np.pi / 2, ELEVATIONS)
        grid = directions(azimuth[:, None], elevation[None]).reshape(-1, 3)
        self._radial = _fill(_hits(np.broadcast_to(CENTRE, grid.shape), grid, skin).reshape(AZIMUTHS, ELEVATIONS))
        heights = np.linspace(LOWEST, HIGHEST, HEIGHTS)
        origins = np.zeros((AZIMUTHS, HEIGHTS, 3))
        origins[..., 1], origins[..., 2] = heights, CENTRE[2]
        flat = np.broadcast_to(directions(azimuth, np.zeros(AZIMUTHS))[:, None], origins.shape).reshape(-1, 3)
        both = _hits(origins.reshape(-1, 3), flat, np.concatenate([skin, collar])).reshape(AZIMUTHS, HEIGHTS)
        self._axial = _fill(both)

    def radius(self, azimuth: np.ndarray, elevation: np.ndarray) -> np.ndarray:
        """Distance of the skin from ``CENTRE``, m."""
        row = (elevation + np.pi / 2) / np.pi * (ELEVATIONS - 1)
        return _look_up(self._radial, azimuth, row)

    def reach(self, azimuth: np.ndarray, height: np.ndarray) -> np.ndarray:
        """Distance of skin or garment from the upright axis through ``CENTRE``, m."""
        row = (height - LOWEST) / (HIGHEST - LOWEST) * (HEIGHTS - 1)
        return _look_up(self._axial, azimuth, row)


def _triangles(quads: np.ndarray) -> np.ndarray:
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def _look_up(table: np.ndarray, azimuth: np.ndarray, row: np.ndarray) -> np.ndarray:
    column = np.mod(azimuth, 2.0 * np.pi) / (2.0 * np.pi) * AZIMUTHS
    wrapped = np.concatenate([table, table[:2]])
    rows = np.clip(row, 0, table.shape[1] - 1)
    return map_coordinates(wrapped, [np.broadcast_to(column, rows.shape), rows], order=1, mode="nearest")


def _hits(origins: np.ndarray, ways: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """(N,) farthest distance at which each ray meets the triangles (T, 3, 3), nan where it meets none."""
    a, e1, e2 = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    out = np.full(len(ways), np.nan)
    for n, (origin, way) in enumerate(zip(origins, ways, strict=True)):
        p = np.cross(way, e2)
        det = (e1 * p).sum(axis=1)
        det = np.where(np.abs(det) < 1e-15, np.inf, det)
        s = origin - a
        u = (s * p).sum(axis=1) / det
        q = np.cross(s, e1)
        v = (q @ way) / det
        t = (e2 * q).sum(axis=1) / det
        met = t[(u >= -1e-6) & (v >= -1e-6) & (u + v <= 1 + 1e-6) & (t > 1e-4)]
        if len(met):
            out[n] = met.max()
    return out


def _fill(table: np.ndarray) -> np.ndarray:
    """A periodic table whose nan are the nearest known, all a little smoothed."""
    wide = np.concatenate([table, table, table])
    near = distance_transform_edt(np.isnan(wide), return_distances=False, return_indices=True)
    filled = gaussian_filter(wide[tuple(near)], 1.0, mode="nearest")
    return filled[len(table) : 2 * len(table)]
