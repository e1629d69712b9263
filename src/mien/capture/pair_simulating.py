"""Pairs of photographs of a known face: for tests, and to see what a pair is worth before one is taken."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mien.core.mesh import Points

from .pair_views import COUNT, NEARNESS, PITCH, SCALE, View, base_of_front, base_of_side
from .records import Camera, Observation, Photograph, Survey


@dataclass(frozen=True)
class PairSetup:
    """How a pair is taken.

    Attributes:
        distances_m: of the front and of the side camera from the middle of the head.
        turns_deg: (pitch, yaw, roll) of the front and of the side camera from exact front and profile.
        sizes_px: of the photographs.
        filled: share of the picture's height that a head of 0.23 m fills, of each.
        offsets: where the middle of the head is seen, from the middle of the picture, shares of its size, of each.
        sigma_px: of clicks.
        side_from: which side of the face the side photograph shows.
        one_lens: both photographs are said to be of one camera.
    """

    distances_m: tuple[float, float] = (1.5, 1.5)
    turns_deg: tuple[tuple[float, float, float], tuple[float, float, float]] = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    sizes_px: tuple[tuple[int, int], tuple[int, int]] = ((3000, 4000), (3000, 4000))
    filled: tuple[float, float] = (0.6, 0.6)
    offsets: tuple[tuple[float, float], tuple[float, float]] = ((0.0, 0.0), (0.0, 0.0))
    sigma_px: float = 1.0
    side_from: str = "left"
    one_lens: bool = False


HEAD_M = 0.23
FRONT_FILE, SIDE_FILE = "front.jpg", "side.jpg"
FACING, OUTLINE = 0.15, -0.1
"""Cosine of the angle to the camera below which a spot on the skin is too slanted to be clicked, and below which a spot
of the profile, which is the outline of the face in the side photograph, lies behind it."""


@dataclass(frozen=True, eq=False)
class Marks:
    """Points marked on a face.

    Attributes:
        places: (3,) m by name, about the middle of the head.
        normals: (3,) by name, outwards.
        midline: names of points in the symmetry plane.
    """

    places: Mapping[str, Points]
    normals: Mapping[str, Points]
    midline: tuple[str, ...]


BACK_M, LOW_M = -0.03, -0.09
"""Marks lie before and above these z and y of the head's frame: forehead, face, ears, throat."""


def marks_of_head(count: int, seed: int = 0, *, both_sides: bool = False) -> Marks:
    """Points of the built-in head, one sixth of them on the midline.

    Args:
        count: of points; those of the right half come on top.
        seed: which ones.
        both_sides: points off the midline are marked in both halves, as ``NAME.left`` and ``NAME.right``.
    """
    from mien.faces.head.measured import archive

    head = archive()
    places = head.measured("surface").points
    outside = head.quads[np.isin(np.array(head.group_names)[head.groups], ["skin", "lips", "lids", "ear"])]
    normals = np.zeros_like(places)
    corners = places[outside]
    np.add.at(normals, outside, np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])[:, None])
    marked = {n for n in np.unique(outside).tolist() if places[n, 1] > LOW_M and places[n, 2] > BACK_M}
    left = sorted(name for name, number in head.vertex.items() if number in marked)
    random = np.random.default_rng(seed)
    left = [left[number] for number in random.permutation(len(left))]
    midline = [name for name in left if head.mirror[head.vertex[name]] == head.vertex[name]][: count // 6]
    off = [name for name in left if head.mirror[head.vertex[name]] != head.vertex[name]][: count - len(midline)]
    numbers = {name: head.vertex[name] for name in midline}
    for name in off:
        numbers[f"{name}.left" if both_sides else name] = head.vertex[name]
        if both_sides:
            numbers[f"{name}.right"] = int(head.mirror[head.vertex[name]])
    middle = np.mean([places[number] for number in numbers.values()], axis=0) * [0.0, 1.0, 1.0]
    return Marks(
        {name: places[number] - middle for name, number in numbers.items()},
        {name: normals[number] / np.linalg.norm(normals[number]) for name, number in numbers.items()},
        tuple(midline),
    )


def cameras_of(setup: PairSetup) -> tuple[View, View]:
    """The true cameras of a pair."""
    views = []
    for number, base in enumerate((base_of_front(), base_of_side(1 if setup.side_from == "left" else -1))):
        values = np.zeros(COUNT)
        values[PITCH : PITCH + 3] = np.radians(setup.turns_deg[number])
        values[3:5] = np.multiply(setup.offsets[number], setup.sizes_px[number])
        values[SCALE] = math.log(setup.filled[number] * setup.sizes_px[number][1] / HEAD_M)
        values[NEARNESS] = -math.log(setup.distances_m[number])
        views.append(View(base, values))
    return views[0], views[1]


def simulate_pair(setup: PairSetup, marks: Marks, seed: int = 0) -> tuple[Survey, dict[str, Camera]]:
    """A survey of a pair, and the true cameras by photograph; a mark turned away from a camera is not clicked there."""
    random = np.random.default_rng(seed)
    observations, photographs, cameras = [], [], {}
    for view, name, size in zip(cameras_of(setup), (FRONT_FILE, SIDE_FILE), setup.sizes_px, strict=True):
        camera = view.camera(size)
        cameras[name] = camera
        photographs.append(Photograph(name, size, "a" if setup.one_lens else name))
        for point, place in marks.places.items():
            ray = camera.place - place
            error = setup.sigma_px * random.normal(size=2)
            least = OUTLINE if point in marks.midline else FACING
            if marks.normals[point] @ ray > least * np.linalg.norm(ray):
                u, v = view.seen(place[None])[0] + 0.5 * np.array(size) + error
                observations.append(Observation(name, point, float(u), float(v), setup.sigma_px))
    return Survey(tuple(photographs), tuple(observations), ()), cameras
