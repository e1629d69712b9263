"""How far the polygons of the classic skin are from plane."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import pairwise
from unittest.mock import patch

import numpy as np

from mien.faces.head import Head
from mien.faces.head.creases import crease_edges
from mien.faces.head.measured import Archive, archive
from mien.faces.head.planing import planes_of
from soundness import Posed, bends_deg, quad_normals

SMOOTH_DEG = 20.0
"""A polygon is where the skin is smooth if it turns by less to all its neighbours at rest."""

RINGS = ("ei", "ej", "e0", "em", "e1", "e2", "e3", "m0", "mh", "m1", "mb", "m2", "m3")
"""Lids to the rim of the eye's socket, lips to the fold from the nose past the corner of the mouth."""

PLANE_DEG = 6.0
"""What a polygon may bend."""


@cache
def smooth_quads(face: Archive) -> np.ndarray:
    """(F,) whether a polygon of the skin lies where the measured face is smooth.

    It is skin (no ear, lip, nostril, mouth), beyond the rings around the eyes and the rings around the mouth, no edge
    of it is one of Parke's creases, and it turns by less than ``SMOOTH_DEG`` to each polygon it shares an edge with.
    Told by the reference, not by what is drawn: a polygon does not leave the measure by bending.
    """
    normals = quad_normals(face.floats("surface"), face.quads)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    around: dict[frozenset[int], list[int]] = {}
    for number, row in enumerate(face.quads.tolist()):
        for edge in pairwise([*row, row[0]]):
            around.setdefault(frozenset(edge), []).append(number)
    left = {number for name, number in face.vertex.items() if name.split("_")[0] in RINGS}
    ringed = np.zeros(len(face.mirror), dtype=bool)
    ringed[list(left | {int(face.mirror[vertex]) for vertex in left})] = True
    smooth = (face.groups == face.group_names.index("skin")) & ~ringed[face.quads].any(axis=1)
    creases = {frozenset(edge) for edge in crease_edges(face)}
    for edge, sides in around.items():
        turned = len(sides) == 2 and normals[sides[0]] @ normals[sides[1]] < np.cos(np.radians(SMOOTH_DEG))
        if turned or edge in creases:
            smooth[sides] = False
    return smooth


def smooth_bends_deg(posed: Posed) -> np.ndarray:
    """(S,) what each polygon bends that lies where the skin is smooth; of a head of kind surface."""
    return bends_deg(posed.mesh.points, archive().quads[smooth_quads(archive())])


def bent_share(posed: Posed) -> float:
    """Share 0..1 of the polygons of the smooth skin that bend by more than ``PLANE_DEG``."""
    return float((smooth_bends_deg(posed) > PLANE_DEG).mean())


def bent_head(head: Head) -> Head:
    """The head with its polygons as its moves and its shape bend them."""
    bent = replace(head)
    with patch("mien.faces.head.poser.planes_of", lambda archive, kind: planes_of(archive, "cage")):
        bent.shape(bent.neutral)  # which makes its constants
    return bent
