"""What a painter fills: the polygons of a mesh that lie in the picture and show themselves, cut where they must be."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.core import Mesh, Scene, exact

from .camera import Camera
from .clip import clip_polygons, outcodes

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Pieces:
    """Polygons, and triangles of those polygons that are twisted or cut by the picture's border.

    Attributes:
        corners: (C, 3) x right and y down in pixels, and 1 / depth: straight edges and planes stay so in this space.
        starts: (n + 1,) the corners of piece k are ``starts[k]:starts[k + 1]``.
        polygon: (n,) polygon of the mesh that each piece shows.
    """

    corners: Floats
    starts: Ints
    polygon: Ints

    @classmethod
    def join(cls, outlines: Sequence[Floats], polygon: Iterable[int]) -> Pieces:
        """The pieces with these corners, (n, 3) each."""
        starts = np.cumsum([0, *(len(outline) for outline in outlines)])
        return cls(np.concatenate([np.zeros((0, 3)), *outlines]), starts, np.array([*polygon], dtype=np.int64))

    def outline(self, number: int) -> Floats:
        """(n, 3) corners of one piece."""
        return self.corners[self.starts[number] : self.starts[number + 1]]


def count_up(counts: Ints) -> Ints:
    """0, 1 ... count - 1 for each count, one after the other."""
    return np.arange(int(counts.sum())) - np.repeat(np.cumsum(counts) - counts, counts)


def cut_pieces(mesh: Mesh, scene: Scene) -> Pieces:
    """Everything of a mesh that lies in the picture and does not turn its back."""
    topology = mesh.topology
    camera = Camera.of(scene)
    view = camera.view(exact.round_points(mesh.points))
    owner, sizes = topology.polygon_of_triangle, np.diff(topology.starts)
    two_sided = np.array([part.material.two_sided for part in topology.parts], dtype=bool)[topology.part_of_polygon]

    side = _side(view[topology.triangles])
    front = np.bincount(owner, side > 0.0, len(sizes))
    back = np.bincount(owner, side < 0.0, len(sizes))
    flat = (sizes >= 3) & ((front == sizes - 2) | ((back == sizes - 2) & two_sided))
    twisted = np.flatnonzero(~flat[owner] & ((side > 0.0) | ((side < 0.0) & two_sided[owner])))

    pieces = [_clip(camera, view[topology.triangles[twisted]], owner[twisted])]
    for size in np.unique(sizes[flat]).tolist():
        polygons = np.flatnonzero(flat & (sizes == size))
        corners = topology.corners[topology.starts[polygons][:, None] + np.arange(size)]
        pieces.append(_clip(camera, view[corners], polygons))
    return Pieces(
        _project(camera, np.concatenate([corners for corners, _, _ in pieces])),
        np.concatenate([[0], *(numbers for _, numbers, _ in pieces)]).cumsum(),
        np.concatenate([polygon for _, _, polygon in pieces]),
    )


def _clip(camera: Camera, polygons: Floats, owner: Ints) -> tuple[Floats, Ints, Ints]:
    """What of polygons (n, m, 3) of the camera's frame is in the picture: corners, how many a piece, whose it is."""
    number, size = polygons.shape[:2]
    codes = outcodes(camera, polygons.reshape(-1, 3)).reshape(number, size)
    crossing = (np.bitwise_or.reduce(codes, axis=1) != 0) & (np.bitwise_and.reduce(codes, axis=1) == 0)
    inside = np.flatnonzero(~codes.any(axis=1))
    clipped, counts = clip_polygons(camera, polygons[crossing])
    counts[counts < 3] = 0
    corners = np.concatenate([polygons[inside].reshape(-1, 3), clipped[np.arange(clipped.shape[1]) < counts[:, None]]])
    left = counts > 0
    sizes = np.concatenate([np.full(len(inside), size), counts[left]])
    return corners, sizes, np.concatenate([owner[inside], owner[crossing][left]])


def cut_pierced(pieces: Pieces, pairs: Iterable[tuple[int, int]]) -> Pieces:
    """The pieces with the first of each pair cut in two along the plane of the second.

    Source: Newell, Newell and Sancha 1972 (what cannot be put in order is cut).
    """
    cutters: dict[int, list[int]] = {}
    for piece, cutter in pairs:
        cutters.setdefault(piece, []).append(cutter)
    outlines, polygon = [], []
    for number in range(len(pieces.polygon)):
        parts = [pieces.outline(number)]
        for cutter in cutters.get(number, ()):
            parts = [half for part in parts for half in _halves(part, pieces.outline(cutter))]
        outlines += parts
        polygon += [int(pieces.polygon[number])] * len(parts)
    return Pieces.join(outlines, polygon)


def _halves(outline: Floats, cutter: Floats) -> list[Floats]:
    """What lies on either side of the plane of another outline: one part, or two."""
    ends = np.roll(cutter, -1, axis=0)
    middle = cutter.sum(axis=0) / len(cutter)
    normal = np.cross(cutter - middle, ends - middle).sum(axis=0)
    offset = outline - middle
    height = (offset[:, 0] * normal[0] + offset[:, 1] * normal[1]) + offset[:, 2] * normal[2]
    halves = [_half(outline, height), _half(outline, -height)]
    kept = [half for half in halves if len(half) >= 3]
    return kept if len(kept) == 2 else [outline]


def _half(outline: Floats, height: Floats) -> Floats:
    """The part of an outline (n, 3) at which ``height`` (n,) is not negative."""
    out = []
    for here, there, a, b in zip(outline, np.roll(outline, -1, axis=0), height, np.roll(height, -1), strict=True):
        if a >= 0.0:
            out.append(here)
        if (a > 0.0 > b) or (a < 0.0 < b):
            out.append(here + (there - here) * (a / (a - b)))
    return np.array(out).reshape(-1, 3) if (height > 0.0).any() else np.zeros((0, 3))


def _side(triangles: Floats) -> Floats:
    """(T,) positive where triangles (T, 3, 3) of the camera's frame show their front, even across the near plane."""
    products = triangles[:, 0] * np.cross(triangles[:, 1], triangles[:, 2])
    side: Floats = (products[:, 0] + products[:, 1]) + products[:, 2]
    return side


def _project(camera: Camera, view: Floats) -> Floats:
    """(n, 3) x right and y down in pixels, 1 / depth, of points (n, 3) that lie before the near plane."""
    inverse = 1.0 / view[:, 2]
    x = camera.width * 0.5 + view[:, 0] * camera.scale * inverse
    y = camera.height * 0.5 - view[:, 1] * camera.scale * inverse
    return np.stack([x, y, inverse], axis=1)
