"""What must hold for a head in any pose: measures of how far it is from breaking, in millimetres or in counts."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np

from mien.core import Mesh, Pose
from mien.core.mesh import Ints, Points
from mien.core.subdivision import refine
from mien.faces.head import Head
from mien.faces.head.measured import LID_RINGS, archive

MM = 1000.0
UPPER, LOWER = range(0, 6), range(5, 10)
OUTER_RINGS = ("m0", "mh", "m1", "mb", "m2")
HIDDEN_GROUPS = ("mouth", "nostril")


@dataclass(frozen=True, eq=False)
class Posed:
    """A head in one pose, and its skin after one step of subdivision."""

    head: Head
    pose: Pose

    @cached_property
    def mesh(self) -> Mesh:
        return self.head.shape(self.pose)

    @cached_property
    def fine(self) -> Points:
        """(V', 3) m of the refined skin."""
        return refined(self.head).matrix.apply(self.mesh.points)

    def part(self, name: str) -> Points:
        """(N, 3) m, the points of a part."""
        return self.mesh.points[part_rows(self.head, name)]


@cache
def refined(head: Head):
    return refine(head.topology)


@cache
def part_rows(head: Head, name: str) -> Ints:
    part, topology = head.topology.part(name), head.topology
    return np.unique(topology.corners[topology.starts[part.first] : topology.starts[part.last]])


@cache
def skin_quads(head: Head) -> tuple[Ints, Ints]:
    """(F', 4) polygons of the refined skin, and the group of each."""
    fine = refined(head).topology
    part = fine.part("skin")
    quads = fine.corners[fine.starts[part.first] : fine.starts[part.last]].reshape(-1, 4)
    return quads, np.repeat(archive().groups, 4)


@cache
def lip_triangles(head: Head, upper: bool) -> Ints:
    """(T, 3) of the refined outside of one lip and of the skin around it."""
    stations = UPPER if upper else LOWER
    left = {archive().vertex[f"{ring}_{s}"] for ring in OUTER_RINGS for s in stations}
    wanted = left | {int(archive().mirror[v]) for v in left}
    coarse = np.array([set(row) <= wanted for row in archive().quads.tolist()])
    quads, _ = skin_quads(head)
    quads = quads[np.repeat(coarse, 4)]
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def depth_behind(points: Points, triangles: Points) -> float:
    """mm by which points (N, 3) stand in front (z) of triangles (T, 3, 3), at most; -inf where none lies behind any."""
    a, b, c = (triangles[:, k] for k in range(3))
    area = _cross(b - a, c - a)
    front = area > 1e-10
    a, b, c, area = a[front], b[front], c[front], area[front]
    worst = -np.inf
    for point in points:
        u, v = _cross(b - point, c - point) / area, _cross(c - point, a - point) / area
        inside = (u >= 0) & (v >= 0) & (u + v <= 1)
        if inside.any():
            z = (u * a[:, 2] + v * b[:, 2] + (1 - u - v) * c[:, 2])[inside]
            worst = max(worst, float((point[2] - z).max()))
    return worst * MM


def _cross(first: Points, second: Points) -> Points:
    return first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]


def teeth_through_lips_mm(posed: Posed) -> float:
    """How far a tooth stands in front of its own lip."""
    teeth, lower = posed.part("teeth"), archive().ints("teeth_lower").astype(bool)
    front = np.abs(archive().floats("teeth_points")[:, 0]) < 0.024
    worst = -np.inf
    for own, upper in ((~lower, True), (lower, False)):
        triangles = posed.fine[lip_triangles(posed.head, upper)]
        worst = max(worst, depth_behind(teeth[own & front], triangles))
    return worst


def lids_into_balls_mm(posed: Posed) -> float:
    """How deep a lid's refined margin or the skin before the ball cuts into an eyeball."""
    worst = -np.inf
    for side in ("left", "right"):
        centre, radius = ball(posed, side)
        away = (posed.fine[: len(posed.fine)][lid_rows(posed.head, side)] - centre) / posed_scale(posed)
        worst = max(worst, float((radius - np.sqrt((away * away).sum(axis=1))).max()))
    return worst * MM


def posed_scale(posed: Posed) -> np.ndarray:
    return np.array([posed.pose[f"head.scale.{axis}"] for axis in ("width", "height", "depth")])


def ball(posed: Posed, side: str) -> tuple[Points, float]:
    """Centre and radius m of an eyeball before the head was scaled: through its points, by least squares."""
    scale = posed_scale(posed)
    points = posed.part(f"eye.{side}") / scale
    system = np.concatenate([2.0 * points, np.ones((len(points), 1))], axis=1)
    solved = np.linalg.lstsq(system, (points * points).sum(axis=1), rcond=None)[0]
    centre = solved[:3]
    return centre * scale, float(np.sqrt(solved[3] + centre @ centre))


@cache
def lid_rows(head: Head, side: str) -> Ints:
    """Refined vertices between margin and fold of an eye's lids."""
    lids, sign = archive().measured("cage").lids, 1 if side == "left" else -1
    rings = [LID_RINGS.index(name) for name in ("margin", "lip", "crease", "fold")]
    coarse = set(lids.index[(lids.side == sign) & np.isin(lids.ring, rings)].tolist())
    wanted = np.array([set(row) <= coarse for row in archive().quads.tolist()])
    quads, _ = skin_quads(head)
    return np.unique(quads[np.repeat(wanted, 4)])


def flipped_polygons(posed: Posed) -> int:
    """Polygons of the refined visible skin that face against all their neighbours."""
    quads, groups = skin_quads(posed.head)
    seen = ~np.isin(groups, [archive().group_names.index(name) for name in HIDDEN_GROUPS])
    p = posed.fine[quads]
    normals = np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1])
    size = np.linalg.norm(normals, axis=1)
    normals = normals / np.maximum(size, 1e-15)[:, None]
    total = np.zeros((len(posed.fine), 3))
    for corner in range(4):
        np.add.at(total, quads[:, corner], normals)
    around = total[quads].sum(axis=1) - 4.0 * normals
    agree = (around * normals).sum(axis=1) / np.maximum(np.linalg.norm(around, axis=1), 1e-15)
    return int((seen & (agree < -0.35) & (size > 2e-8)).sum())


def lips_gap_mm(posed: Posed) -> float:
    """Greatest height between the refined edges of the lips, corner left out."""
    height = {name: posed.fine[number, 1] for name, number in archive().vertex.items()}
    pairs = ((0, 9), (1, 8), (2, 7), (3, 6))
    return MM * max(height[f"m0_{up}"] - height[f"m0_{low}"] for up, low in pairs)
