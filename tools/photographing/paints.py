"""Colours that people are photographed in: of polygons by what they are drafted as, and of the scanned skin."""

from __future__ import annotations

import numpy as np
from measuring.closest import bind, topology_of, vertex_normals

from mien.core import Material, Pose
from mien.faces.head.measured import archive
from mien.faces.head.palettes import palettes
from mien.faces.head.people import make_head

from .subject import Scan

MATERIALS = {
    "skin": Material(gloss=0.055, gloss_power=14, subdivide=True),
    "eyes": Material(gloss=0.1, gloss_power=60),
    "caruncle": Material(gloss=0.03),
    "lash": Material(two_sided=True),
    "brow": Material(gloss=0.015),
    "teeth": Material(gloss=0.2, gloss_power=36, two_sided=True),
    "tongue": Material(gloss=0.06, gloss_power=24, subdivide=True),
    "collar": Material(gloss=0.01, two_sided=True, subdivide=True),
    "hair": Material(gloss=0.07, gloss_power=18, subdivide=True),
}
"""How the parts of a half take the light."""


def paints(palette: str) -> dict[str, np.ndarray]:
    """What a polygon is drafted as -> (3,) linear RGB."""
    own = {name: np.array(rgb) for name, rgb in palettes()[palette].items()}
    skin, blush, lip = own["skin"], own["blush"], own["lip"]
    return own | {
        "brow": 0.85 * own["eyebrow"] + 0.15 * skin,
        "lash": 0.3 * own["eyebrow"],
        "blush": 0.5 * (blush + skin),
        "lip": lip,
        "cavity": np.array([0.055, 0.014, 0.014]),
        "nostril": 0.05 * blush,
        "rim": 0.6 * blush + 0.4 * np.array([0.60, 0.21, 0.20]),
        "pupil": np.full(3, 0.005),
        "fringe": 0.25 * own["iris"],
        "white": np.array([0.80, 0.78, 0.76]),
        "spot": np.ones(3),
        "caruncle": 0.5 * blush + 0.5 * np.array([0.57, 0.15, 0.13]),
        "tongue": np.array([0.36, 0.09, 0.085]),
        "tooth": np.array([0.78, 0.72, 0.60]),
        "band": 0.8 * own["garment"],
    }


def skin_paint(scan: Scan, palette: str) -> np.ndarray:
    """(V, 3) linear RGB of the scanned skin: that of the shipped head's nearest skin, dark inside of the mouth."""
    layer = make_head("painted", {"hair": "bald", "beard": "none", "glasses": "none", "palette": palette,
                                  "jaw": "fitted", "doc": ""}, {})  # fmt: skip
    colors = layer.shape(Pose.neutral(layer.parameters)).colors[: len(archive().mirror)]
    head = archive()
    outer = head.quads[np.isin(head.groups, [k for k, name in enumerate(head.group_names) if name != "mouth"])]
    surface = topology_of(outer, len(colors))
    ours = head.floats("surface")
    points = scan.reference.scans.points
    quads = scan.polygons("face", "head_neck", "mouth_socket")
    normals = vertex_normals(points, topology_of(quads, len(points)).triangles)
    out = np.tile(paints(palette)["cavity"], (len(points), 1))
    skin = scan.vertices("face", "head_neck")
    out[skin] = bind(points[skin], normals[skin], ours, surface.triangles) @ colors
    return out
