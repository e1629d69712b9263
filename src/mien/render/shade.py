"""Light on nodes: normals, then ambient, diffuse and highlight, all in linear light and in a fixed order of sums."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.core import Light, Mesh, MienError, Scene

from .plan import Plan

Floats = NDArray[np.float64]
Columns = tuple[Floats, Floats, Floats]


@dataclass(frozen=True, eq=False)
class Shades:
    """Light on every shade of a plan: colour seen = own colour x ``diffuse`` + ``highlight``.

    Attributes:
        diffuse: (N + M, 3) linear RGB.
        highlight: (N + M, 3) linear RGB.
        faces_viewer: (F,) whether a polygon turns its front to the viewer.
    """

    diffuse: Floats
    highlight: Floats
    faces_viewer: NDArray[np.bool_]


def polygon_normals(points: Floats, plan: Plan, polygon_count: int) -> Floats:
    """(F, 3) normals, each as long as twice its polygon's area."""
    out = np.zeros((polygon_count, 3))
    for inside, corners in plan.by_size:
        if corners.shape[1] < 3:
            continue
        if corners.shape[1] == 4:
            # Half the work of the fan below, and equal to it: the diagonals span twice the area of a quad.
            first = points[corners[:, 2]] - points[corners[:, 0]]
            second = points[corners[:, 3]] - points[corners[:, 1]]
            out[inside] = _cross(first, second)
            continue
        origin = points[corners[:, 0]]
        total = np.zeros((len(inside), 3))
        for k in range(1, corners.shape[1] - 1):
            total += _cross(points[corners[:, k]] - origin, points[corners[:, k + 1]] - origin)
        out[inside] = total
    return out


def light_mesh(mesh: Mesh, points: Floats, plan: Plan, scene: Scene) -> Shades:
    """The light on a mesh whose points, rounded, are ``points`` (V, 3) m."""
    normals = polygon_normals(points, plan, mesh.topology.polygon_count)
    places = _node_places(points, plan, mesh)
    if len(plan.back):
        places = _three(np.concatenate([p, p[plan.back]]) for p in places)
    diffuse, highlight = light_places(
        places, shade_normals(mesh, normals, plan), plan.gloss, group_powers(plan.lit, plan.gloss, plan.power), scene
    )
    diffuse[~plan.lit] = 1.0
    return Shades(diffuse, highlight, facing_viewer(mesh, points, normals, scene))


def facing_viewer(mesh: Mesh, points: Floats, normals: Floats, scene: Scene) -> NDArray[np.bool_]:
    """(F,) whether polygons with these normals turn their fronts to the viewer."""
    first = points[mesh.topology.corners[mesh.topology.starts[:-1]]]
    towards = [scene.position[k] - first[:, k] for k in range(3)]
    return _dot(towards, _columns(normals)) > 0.0


def shade_normals(mesh: Mesh, normals: Floats, plan: Plan) -> Columns:
    """Unit normals of all shades, three columns (N + M,), from those of the polygons (F, 3)."""
    directions = _columns(plan.normal_sum.apply(normals))
    if len(plan.round):
        own = own_normals(mesh)
        for k in range(3):
            directions[k][plan.round] = own[plan.vertex[plan.round], k]
    directions = normalised(directions)
    return _three(np.concatenate([d, -d[plan.back]]) for d in directions) if len(plan.back) else directions


def node_colors(mesh: Mesh, plan: Plan) -> Floats:
    """(N + M, 3) own colour of every shade of a mesh whose colours belong to its vertices."""
    own = mesh.colors[plan.vertex]
    in_polygons = np.flatnonzero(plan.vertex < 0)
    if len(in_polygons):
        own[in_polygons] = polygon_means(mesh.colors, plan, mesh)[plan.polygon[in_polygons]]
    return np.concatenate([own, own[plan.back]])


def group_powers(
    lit: NDArray[np.bool_], gloss: Floats, power: NDArray[np.int64]
) -> tuple[tuple[int, NDArray[np.int64]], ...]:
    """Sharpness of highlights, each with the numbers of what has it."""
    glossy = (gloss > 0.0) & lit
    return tuple((int(p), np.flatnonzero(glossy & (power == p))) for p in np.flatnonzero(np.bincount(power[glossy])))


def own_normals(mesh: Mesh) -> Floats:
    """(V, 3) normals of a mesh with round parts."""
    if mesh.normals is None:
        raise MienError("a part of this mesh is round, but the mesh brings no normals — give Mesh(normals=...)")
    return mesh.normals


def light_places(
    places: Columns,
    normals: Columns,
    gloss: Floats,
    powers: tuple[tuple[int, NDArray[np.int64]], ...],
    scene: Scene,
) -> tuple[Floats, Floats]:
    """(N, 3) diffuse light and (N, 3) highlights at places with unit normals, both given as three columns.

    Args:
        places: m.
        normals: of length 1.
        gloss: (N,) strength of highlights.
        powers: their sharpness, from ``group_powers``.
        scene: viewer and lamps.

    Source: Parke 1974, section 3.5 (diffuse factor, cosine power); Blinn 1977 (half vector).
    """
    up = (normals[1] + 1.0) * 0.5
    low, high = scene.ambient
    diffuse = [low[c] + (high[c] - low[c]) * up for c in range(3)]
    highlight = np.zeros((len(up), 3))
    viewer = [_pick(_towards(places, scene.position), numbers) for _, numbers in powers]
    for light in scene.lamps:
        towards = _towards(places, light.position)
        cosine = _dot(normals, towards)
        amount = np.maximum((cosine + light.wrap) * (1.0 / (1.0 + light.wrap)), 0.0)
        amount = whole_power(amount, scene.cosine_power)
        for c in range(3):
            diffuse[c] += light.color[c] * amount
        if scene.gloss > 0.0:
            for (power, numbers), eye in zip(powers, viewer, strict=True):
                shine = _shine(_pick(normals, numbers), _pick(towards, numbers), eye, cosine[numbers], power)
                shine *= gloss[numbers] * scene.gloss
                _add_colored(highlight, numbers, shine, light)
    return np.stack(diffuse, axis=1), highlight


def _shine(normals: Columns, towards: Columns, viewer: Columns, cosine: Floats, power: int) -> Floats:
    half = normalised(_three(a + b for a, b in zip(towards, viewer, strict=True)))
    return np.where(cosine > 0.0, whole_power(np.maximum(_dot(normals, half), 0.0), power), 0.0)


def _add_colored(total: Floats, numbers: NDArray[np.int64], amount: Floats, light: Light) -> None:
    for c in range(3):
        total[numbers, c] += light.color[c] * amount


def whole_power(base: Floats, power: int) -> Floats:
    """Base to a whole power >= 1, by multiplications alone: a library's ``pow`` differs between machines."""
    result: Floats | None = None
    while True:
        if power & 1:
            result = base if result is None else result * base
        power >>= 1
        if not power:
            return base if result is None else result
        base = base * base


def _node_places(points: Floats, plan: Plan, mesh: Mesh) -> Columns:
    places = np.empty((len(plan.vertex), 3))
    at_vertex = plan.vertex >= 0
    places[at_vertex] = points[plan.vertex[at_vertex]]
    if not at_vertex.all():
        places[~at_vertex] = polygon_means(points, plan, mesh)[plan.polygon[~at_vertex]]
    return _columns(places)


def polygon_means(values: Floats, plan: Plan, mesh: Mesh) -> Floats:
    """(F, 3) means of what belongs to the corners of each polygon; values (V, 3)."""
    out = np.zeros((mesh.topology.polygon_count, 3))
    for inside, corners in plan.by_size:
        total = values[corners[:, 0]].copy()
        for k in range(1, corners.shape[1]):
            total += values[corners[:, k]]
        out[inside] = total / float(corners.shape[1])
    return out


def _columns(rows: Floats) -> Columns:
    return _three(np.ascontiguousarray(rows[:, k]) for k in range(3))


def _three(values: Sequence[Floats] | object) -> Columns:
    x, y, z = values  # type: ignore[misc]
    return x, y, z


def _pick(columns: Columns, numbers: NDArray[np.int64]) -> Columns:
    return columns[0][numbers], columns[1][numbers], columns[2][numbers]


def _dot(a: Sequence[Floats], b: Sequence[Floats]) -> Floats:
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]


def _towards(places: Columns, target: tuple[float, float, float]) -> Columns:
    return normalised(_three(target[k] - places[k] for k in range(3)))


def normalised(a: Columns) -> Columns:
    """Vectors of length 1; those without length stay as they are."""
    # The smallest normal number: a vector without length stays the zero vector, and so gets no light.
    scale = 1.0 / np.sqrt(np.maximum(_dot(a, a), 2.2250738585072014e-308))
    return a[0] * scale, a[1] * scale, a[2] * scale


def _cross(a: Floats, b: Floats) -> Floats:
    out = np.empty_like(a)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        out[:, k] = a[:, i] * b[:, j] - a[:, j] * b[:, i]
    return out
