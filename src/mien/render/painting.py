"""A mesh as a painter would do it: its visible polygons as filled paths, what lies behind before what lies in front."""

from __future__ import annotations

import heapq
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from mien.core import Drawing, Mesh, MienError, Path, Scene, exact

from .overlaps import Overlaps, find_overlaps
from .pieces import Pieces, cut_pieces, cut_pierced
from .plan import plan_shading
from .shade import light_mesh, polygon_means
from .wire import paper_colors

Floats = NDArray[np.float64]

ROUNDS = 2
"""How often pieces that pierce one another are cut. One round leaves those that are not quite flat."""

LEAST_SAMPLES = 2
"""Fewer samples of a piece in front of another, of which others are behind it, are not worth a cut."""


def paint_mesh(mesh: Mesh, scene: Scene) -> Drawing:
    """The mesh as filled paths in painter's order on a canvas as large as the picture, in its pixels.

    Args:
        mesh: what is painted, as it is; one shade a polygon.
        scene: camera, lights, size; with shading wire all colours are pale, as paper for lines.
    """
    if not (np.isfinite(mesh.points).all() and np.isfinite(mesh.colors).all()):
        raise MienError("a mesh to be painted has a point or a colour that is not a finite number")
    if scene.shading == "wire":
        mesh = replace(mesh, colors=paper_colors(mesh.colors))
    colors = polygon_colors(mesh, scene).tolist()
    names = [part.name for part in mesh.topology.parts]
    part_of = mesh.topology.part_of_polygon
    width, height = (float(side) for side in scene.size_px)
    pieces, overlaps = settle_pieces(cut_pieces(mesh, scene), scene.size_px)
    paths = []
    for number in sort_pieces(pieces, overlaps):
        polygon = int(pieces.polygon[number])
        outline = pieces.outline(number)[:, :2] * (1.0, -1.0) + (0.0, height)
        paths.append(Path(names[part_of[polygon]], (outline,), (*colors[polygon], 1.0)))
    return Drawing((width, height), tuple(paths))


def polygon_colors(mesh: Mesh, scene: Scene) -> Floats:
    """(F, 3) linear RGB of every polygon, lit, as the viewer sees it."""
    plan = plan_shading(mesh.topology, True)
    shades = light_mesh(mesh, exact.round_points(mesh.points), plan, scene)
    own = mesh.colors if mesh.colored_by_polygon else polygon_means(mesh.colors, plan, mesh)
    count = mesh.topology.polygon_count
    shade, back = np.arange(count), count + np.arange(len(plan.back))
    shade[plan.back] = np.where(shades.faces_viewer[plan.back], plan.back, back)
    return own * shades.diffuse[shade] + shades.highlight[shade]


def settle_pieces(pieces: Pieces, size_px: tuple[int, int]) -> tuple[Pieces, Overlaps]:
    """The pieces, those cut that pierce one another, and how they overlap in a picture of that size."""
    overlaps = find_overlaps(pieces, size_px)
    for _ in range(ROUNDS):
        pierced = _pierced(overlaps)
        if not pierced:
            break
        pieces = cut_pierced(pieces, pierced)
        overlaps = find_overlaps(pieces, size_px)
    return pieces, overlaps


def _pierced(overlaps: Overlaps) -> list[tuple[int, int]]:
    """Pairs of pieces that hide one another: the one to be cut, by the other."""
    hidden = overlaps.hidden
    pairs = [
        (a, b) for (a, b), amount in hidden.items() if a < b and min(amount, hidden.get((b, a), 0)) >= LEAST_SAMPLES
    ]
    partners: dict[int, int] = {}
    for pair in pairs:
        for piece in pair:
            partners[piece] = partners.get(piece, 0) + 1
    # A large piece that many small ones pierce stays whole: each of them is cut once.
    return [(a, b) if partners[a] <= partners[b] else (b, a) for a, b in pairs]


def sort_pieces(pieces: Pieces, overlaps: Overlaps) -> list[int]:
    """Numbers of the pieces that are seen, each after those it hides, else the farther ones first.

    Where pieces hide one another in a ring, the next is the one that leaves the fewest samples wrong.
    """
    corners = np.diff(pieces.starts)
    total = np.concatenate([[0.0], np.cumsum(pieces.corners[:, 2])])[pieces.starts]
    nearness = (np.diff(total) / corners).tolist()
    owed = dict.fromkeys(overlaps.seen, 0)
    followers: dict[int, list[tuple[int, int]]] = {piece: [] for piece in owed}
    for (above, below), amount in overlaps.hidden.items():
        back = overlaps.hidden.get((below, above), 0)
        if (amount, above) > (back, below):
            followers[below].append((above, amount))
            owed[above] += amount
    ready = [(nearness[piece], piece) for piece, samples in owed.items() if samples == 0]
    heapq.heapify(ready)
    order: list[int] = []
    while owed:
        if not ready:
            ready.append(min((owed[piece], nearness[piece], piece) for piece in owed)[1:])
        _, piece = heapq.heappop(ready)
        del owed[piece]
        order.append(piece)
        for follower, samples in followers[piece]:
            if follower in owed:
                owed[follower] -= samples
                if owed[follower] == 0:
                    heapq.heappush(ready, (nearness[follower], follower))
    return order
