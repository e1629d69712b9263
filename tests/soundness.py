"""How far a head in a pose is from breaking: measures in millimetres, degrees or counts."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from scipy.spatial import ConvexHull, cKDTree

from mien.core import Mesh, Pose, Scene
from mien.core.mesh import Ints, Points
from mien.core.subdivision import refine
from mien.faces.head import Head
from mien.faces.head.measured import LID_RINGS, archive
from mien.faces.head.teeth import RINGS, SIDES
from mien.render import Renderer

MM = 1000.0
HIDDEN_GROUPS = ("mouth", "nostril", "lidin")
INWARDS = ("mk", "mj", "mi", "m0"), ("ei", "ej", "e0")
"""Rings of the lips and of the lids from inside to the edge: what stands before these need not have come through."""

RIGID = ("head.turn", "head.nod", "head.tilt", "head.forward")
"""Moves of the whole head on its neck: measures are taken without them."""


AXIS_BACK_M = 0.050
"""How far the middle of the mouth lies behind the foremost tooth."""

NEIGHBOURS = 12
"""Refined vertices around which a point's way is followed."""

CROWN = RINGS * SIDES + 1
"""Vertices of a tooth."""

TRIANGLES = (0, 1, 2), (0, 2, 3)


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
        return _refiner(1).refine(self.mesh).points

    @cached_property
    def finest(self) -> Points:
        """(V'', 3) m of the skin refined twice."""
        return _refiner(2).refine(self.mesh).points

    def nearest_skin(self, points: Points, count: int = 1) -> Ints:
        """(N, count) refined vertices of the skin, nearest first."""
        return skin_rows(self.head)[self._tree.query(points, np.arange(1, count + 1))[1]]

    @cached_property
    def _tree(self) -> cKDTree:
        return cKDTree(self.fine[skin_rows(self.head)], balanced_tree=False, compact_nodes=False)

    def part(self, name: str) -> Points:
        """(N, 3) m, the points of a part."""
        return self.mesh.points[part_rows(self.head, name)]


@cache
def _refiner(steps: int) -> Renderer:
    return Renderer(Scene(subdivide=steps))


@cache
def part_rows(head: Head, name: str) -> Ints:
    part, topology = head.topology.part(name), head.topology
    return np.unique(topology.corners[topology.starts[part.first] : topology.starts[part.last]])


@cache
def skin_quads(head: Head) -> Ints:
    """(4 F, 4) polygons of the refined skin: four of each."""
    fine = refine(head.topology).topology
    part = fine.part("skin")
    return fine.corners[fine.starts[part.first] : fine.starts[part.last]].reshape(-1, 4)


@cache
def quads_within(rings: tuple[str, ...]) -> np.ndarray:
    """(F,) whether all corners of a polygon of the skin lie on some rings."""
    left = {number for name, number in archive().vertex.items() if name.split("_")[0] in rings}
    wanted = left | {int(archive().mirror[v]) for v in left}
    return np.array([set(row) <= wanted for row in archive().quads.tolist()])


@cache
def hidden_quads() -> np.ndarray:
    """(F,) whether a polygon of the skin lies in mouth, nostrils or under a lid."""
    hidden = [archive().group_names.index(name) for name in HIDDEN_GROUPS]
    return np.isin(archive().groups, hidden)


@cache
def inner_quads() -> np.ndarray:
    """(F,) whether a polygon of the skin is hidden, or lies behind the line where lips or lids meet."""
    return hidden_quads() | quads_within(INWARDS[0]) | quads_within(INWARDS[1])


@cache
def skin_rows(head: Head) -> Ints:
    """Refined vertices of the skin."""
    return np.unique(skin_quads(head))


@cache
def is_outside(head: Head) -> np.ndarray:
    """(V',) whether a refined vertex has nothing but outer skin around it."""
    quads, rows = skin_quads(head), np.repeat(inner_quads(), 4)
    out = np.zeros(refine(head.topology).topology.vertex_count, dtype=bool)
    out[quads[~rows]] = True
    out[quads[rows]] = False
    return out


@cache
def outer_quads_at(head: Head) -> Ints:
    """(V', K) polygons of outer skin around each refined vertex, -1 where there are no more."""
    quads = skin_quads(head)
    outer = np.flatnonzero(~np.repeat(inner_quads(), 4))
    vertices, polygons = quads[outer].ravel(), np.repeat(outer, 4)
    order = np.argsort(vertices, kind="stable")
    counts = np.bincount(vertices, minlength=refine(head.topology).topology.vertex_count)
    column = np.arange(len(order)) - np.repeat(np.cumsum(counts) - counts, counts)
    out = np.full((len(counts), counts.max()), -1, dtype=np.int64)
    out[vertices[order], column] = polygons[order]
    return out


# ---------------------------------------------------------------- what comes through


def through_skin_mm(posed: Posed, *parts: str) -> float:
    """How deep outer skin lies behind any point of the parts, on its level way to the middle of the mouth.

    A tooth that shows in an open mouth has none behind it, however near the lip beside it is.
    """
    points = np.concatenate([posed.part(name) for name in parts])
    back = np.minimum(points[:, 2].max() - AXIS_BACK_M - points[:, 2], 0.0)
    ways = np.stack([-points[:, 0], np.zeros(len(points)), back], axis=1)
    ways /= np.maximum(np.linalg.norm(ways, axis=1), 1e-9)[:, None]
    around = outer_quads_at(posed.head)[posed.nearest_skin(points, NEIGHBOURS)].reshape(len(points), -1)
    rows = np.repeat(np.arange(len(points)), around.shape[1])
    pairs = np.unique(np.stack([rows, around.ravel()], axis=1)[around.ravel() >= 0], axis=0)
    at, quads = pairs[:, 0], skin_quads(posed.head)[pairs[:, 1]]
    depths = [_depths(points[at], ways[at], *(posed.fine[quads[:, k]] for k in corners)) for corners in TRIANGLES]
    return MM * float(np.max(depths, initial=-np.inf))


def _depths(points: Points, ways: Points, a: Points, b: Points, c: Points) -> np.ndarray:
    """(N,) m from a point down to the plane of a triangle that its way enters; none where it enters it nowhere.

    Source: Moeller and Trumbore 1997, Fast, minimum storage ray/triangle intersection.
    """
    first, second, away = b - a, c - a, points - a
    across, along, normal = np.cross(ways, second), np.cross(away, first), np.cross(first, second)
    size = (first * across).sum(axis=1)
    size = np.where(np.abs(size) > 1e-18, size, np.inf)
    u, v = (away * across).sum(axis=1) / size, (ways * along).sum(axis=1) / size
    far, facing = (second * along).sum(axis=1) / size, (normal * ways).sum(axis=1)
    met = (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0) & (far > 0.0) & (facing < 0.0)
    return np.where(met, far * -facing / np.maximum(np.linalg.norm(normal, axis=1), 1e-15), -np.inf)


def skin_into_balls_mm(posed: Posed) -> float:
    """How deep any refined skin outside the lids' inner sides lies in an eyeball: as far as that comes through."""
    rows, scale = np.flatnonzero(is_outside(posed.head)), posed_scale(posed)
    return max(_into_ball_mm(posed.fine[rows] / scale, ball(posed, side)) for side in ("left", "right"))


def lids_into_balls_mm(posed: Posed) -> float:
    """How deep a lid's refined margin or the skin before the ball cuts into an eyeball."""
    scale = posed_scale(posed)
    sides = ("left", "right")
    return max(_into_ball_mm(posed.fine[lid_rows(posed.head, side)] / scale, ball(posed, side)) for side in sides)


def _into_ball_mm(points: Points, sphere: tuple[Points, float]) -> float:
    away = points - sphere[0]
    return MM * (sphere[1] - float(np.sqrt((away * away).sum(axis=1)).min()))


def posed_scale(posed: Posed) -> np.ndarray:
    """(3,) how much the whole head is scaled."""
    return np.array([posed.pose[f"head.scale.{axis}"] for axis in ("width", "height", "depth")])


def ball(posed: Posed, side: str) -> tuple[Points, float]:
    """Centre and radius m of an eyeball before the head was scaled: through its points, by least squares."""
    points = posed.part(f"eye.{side}") / posed_scale(posed)
    system = np.concatenate([2.0 * points, np.ones((len(points), 1))], axis=1)
    solved = np.linalg.lstsq(system, (points * points).sum(axis=1), rcond=None)[0]
    centre = solved[:3]
    return centre, float(np.sqrt(solved[3] + centre @ centre))


@cache
def lid_rows(head: Head, side: str) -> Ints:
    """Refined vertices between margin and fold of an eye's lids."""
    lids, sign = archive().measured("cage").lids, 1 if side == "left" else -1
    rings = [LID_RINGS.index(name) for name in ("margin", "lip", "crease", "fold")]
    coarse = set(lids.index[(lids.side == sign) & np.isin(lids.ring, rings)].tolist())
    wanted = np.array([set(row) <= coarse for row in archive().quads.tolist()])
    return np.unique(skin_quads(head)[np.repeat(wanted, 4)])


def tongue_in_teeth_mm(posed: Posed) -> float:
    """How deep a point of the tongue, or the middle of one of its polygons, lies in a crown."""
    part, topology = posed.head.topology.part("tongue"), posed.head.topology
    starts = topology.starts[part.first : part.last + 1]
    sums = np.add.reduceat(posed.mesh.points[topology.corners[: starts[-1]]], starts[:-1])
    points = np.concatenate([posed.part("tongue"), sums / np.diff(starts)[:, None]])
    deepest = 0.0
    for crown in posed.part("teeth").reshape(-1, CROWN, 3):
        low, high = crown.min(axis=0), crown.max(axis=0)
        near = points[((points > low) & (points < high)).all(axis=1)]
        if len(near):
            planes = ConvexHull(crown).equations
            deepest = max(deepest, float((-(near @ planes[:, :3].T + planes[:, 3])).min(axis=1).max()))
    return MM * deepest


# ---------------------------------------------------------------- the skin itself


def flipped_polygons(posed: Posed) -> Ints:
    """Polygons of the refined visible skin that face against all their neighbours.

    What lies behind the line where lips or lids meet folds by itself when they shut, where nobody sees it.
    """
    quads = skin_quads(posed.head)
    normals = quad_normals(posed.fine, quads)
    size = np.linalg.norm(normals, axis=1)
    normals = normals / np.maximum(size, 1e-15)[:, None]
    around = spread(normals, quads, len(posed.fine))[quads].sum(axis=1) - 4.0 * normals
    agree = (around * normals).sum(axis=1) / np.maximum(np.linalg.norm(around, axis=1), 1e-15)
    return np.flatnonzero(~np.repeat(inner_quads(), 4) & (agree < -0.35) & (size > 2e-8))


def bends_deg(points: Points, quads: Ints) -> np.ndarray:
    """(F,) angle between the normals of the two triangles of a quadrilateral, by whichever diagonal it is less."""
    p = points[quads]
    angles = []
    for k in (0, 1):
        a, b, c, d = (p[:, (k + i) % 4] for i in range(4))
        first, second = np.cross(b - a, c - a), np.cross(c - a, d - a)
        size = np.linalg.norm(first, axis=1) * np.linalg.norm(second, axis=1)
        cosine = (first * second).sum(axis=1) / np.maximum(size, 1e-20)
        angles.append(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))
    return np.minimum(*angles)


def spread(values: Points, quads: Ints, count: int) -> Points:
    """(count, 3) sum at each vertex of the values (F, 3) of the polygons around it."""
    rows = quads.ravel()
    return np.stack([np.bincount(rows, np.repeat(column, 4), count) for column in values.T], axis=1)


def quad_normals(points: Points, quads: Ints) -> Points:
    """(F, 3) normals of quadrilaterals, as long as twice their area, m^2."""
    p = points[quads]
    (ax, ay, az), (bx, by, bz) = (p[:, 2] - p[:, 0]).T, (p[:, 3] - p[:, 1]).T
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=1)
