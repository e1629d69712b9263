"""What of eyes and mouth shows between lids and lips: counts of pixels in pictures of flat colours."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import cache

import numpy as np

from mien.core import Mesh, Scene, Topology
from mien.core.mesh import Part, Points
from mien.core.subdivision import refine
from mien.faces.head import Head
from mien.faces.head.measured import archive
from mien.render import Renderer
from soundness import Posed, ball, posed_scale

BALL, TOOTH, CAVITY = 0, 1, 2
CHANNELS = {"eye": BALL, "spot": BALL, "teeth": TOOTH, "gums": TOOTH, "tongue": CAVITY}
"""Channel of the picture in which each part shines; all others are black, but the inside of the mouth."""

DISTANCE_M = 1.1
PIXELS_A_M = 3000.0
"""As fine as the default picture of 1024 pixels."""

REACH_M = {"eye": 0.022, "mouth": 0.048}
"""Half the side of a picture of an eye and of the mouth."""

CUT_M = {"eye": 0.12, "mouth": 0.15}
"""What lies farther from an eye or the mouth at rest is not drawn."""

WAYS = {
    "eye": ((0.0, 0.0, 1.0), (0.6, 0.0, 0.8), (-0.6, 0.0, 0.8), (0.0, -0.5, 0.87), (0.0, 0.4, 0.92)),
    "mouth": ((0.0, 0.0, 1.0), (0.6, 0.0, 0.8), (-0.6, 0.0, 0.8), (0.0, -0.5, 0.87)),
}
"""Where the viewer stands: ahead, at either side, below, above."""


def eye_pixels(posed: Posed, side: str, ways: Iterable[tuple[float, float, float]] = WAYS["eye"]) -> int:
    """Most pixels of an eyeball or its reflection in any of the views."""
    at = ball(posed, side)[0] * posed_scale(posed)
    return max(int(picture(posed, at, f"eye.{side}", way)[..., BALL].sum()) for way in ways)


def mouth_pixels(posed: Posed, ways: Iterable[tuple[float, float, float]] = WAYS["mouth"]) -> tuple[int, int]:
    """Most pixels of teeth and gums, and of tongue and cavity, in any of the views."""
    seen = [picture(posed, lips_middle(posed), "mouth", way) for way in ways]
    return max(int(s[..., TOOTH].sum()) for s in seen), max(int(s[..., CAVITY].sum()) for s in seen)


def picture(posed: Posed, at: Points, what: str, way: tuple[float, float, float]) -> np.ndarray:
    """(H, W, 3) booleans: where a channel shines in a view of an eye (``eye.left``) or of the mouth around a place."""
    reach = REACH_M[what.split(".")[0]]
    size = int(2.0 * reach * PIXELS_A_M)
    topology, colors = flat_cut(posed.head, what)
    scene = Scene(
        position=tuple((at + DISTANCE_M * np.array(way)).tolist()),
        at=tuple(at.tolist()),
        fov_deg=2.0 * float(np.degrees(np.arctan(reach / DISTANCE_M))),
        size_px=(size, size),
        background=((0.0, 0.0, 0.0, 1.0),) * 2,
    )
    return Renderer(scene, samples=1).draw_mesh(Mesh(topology, posed.finest, colors))[..., :3] > 127


@cache
def flat_cut(head: Head, what: str) -> tuple[Topology, Points]:
    """What is near an eye or the mouth of the twice refined head, without light, and a colour a polygon."""
    first = refine(head.topology)
    second = refine(first.topology)
    of, parent = second.topology, first.polygon_parent[second.polygon_parent]
    keep = near(head, what)[parent]
    starts = np.concatenate([[0], np.cumsum(np.diff(of.starts)[keep])])
    parts, runs = [], 0
    for part in of.parts:
        count = int(keep[part.first : part.last].sum())
        if count:
            material = replace(part.material, lit=False, gloss=0.0, round=False)
            parts.append(Part(part.name, runs, runs + count, material))
        runs += count
    corners = of.corners[keep[of.polygon_of_corner]]
    return Topology(of.vertex_count, corners, starts, tuple(parts)), flat_colors(head)[parent[keep]]


def near(head: Head, what: str) -> np.ndarray:
    """(F,) whether a polygon lies near an eye or the mouth of the resting head."""
    rest, topology = Posed(head, head.neutral), head.topology
    name, _, side = what.partition(".")
    at = ball(rest, side)[0] if side else lips_middle(rest)
    sums = np.add.reduceat(rest.mesh.points[topology.corners], topology.starts[:-1])
    away = np.linalg.norm(sums / np.diff(topology.starts)[:, None] - at, axis=1)
    kept = away < CUT_M[name]
    for part in topology.parts:
        if part.name.split(".")[0] in ("lash", "brow", "hair", "collar"):
            kept[part.first : part.last] = False
    return kept


def lips_middle(posed: Posed) -> Points:
    """(3,) m, between the lips."""
    return posed.mesh.points[[archive().vertex[name] for name in ("m0_0", "m0_9")]].mean(axis=0)


@cache
def flat_colors(head: Head) -> Points:
    """(F, 3) a colour a polygon of the head."""
    topology = head.topology
    colors = np.zeros((topology.polygon_count, 3))
    for part in topology.parts:
        if (name := part.name.split(".")[0]) in CHANNELS:
            colors[part.first : part.last, CHANNELS[name]] = 1.0
    skin = topology.part("skin")
    colors[skin.first : skin.last, CAVITY] = archive().groups == archive().group_names.index("mouth")
    return colors
