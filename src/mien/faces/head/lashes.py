"""Lashes, and the pink corner of the eye that fills what lids and ball leave open."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.core.mesh import Ints, Points

from .brows import bind
from .eyes import Eye
from .measured import Archive, Floats
from .vectors import cross, unit


@dataclass(frozen=True, eq=False)
class Lashes:
    """Spikes and a dark line bound to the lid margins.

    Attributes:
        index, weight: left and right (N, K), what of the posed skin a vertex sits on.
        reach: left and right (N, 4): length m, upwards, sideways, 1 where the vertex is a tip.
        quads: (Q, 4); lower: (Q,) whether a polygon belongs to the lower lid.
    """

    index: tuple[Ints, Ints]
    weight: tuple[Floats, Floats]
    reach: tuple[Floats, Floats]
    quads: Ints
    lower: np.ndarray[tuple[int], np.dtype[np.bool_]]


def lashes(archive: Archive) -> Lashes:
    """The lashes of the data file."""
    return Lashes(
        (archive.ints("lash_left_index"), archive.ints("lash_right_index")),
        (archive.floats("lash_left_weight"), archive.floats("lash_right_weight")),
        (archive.floats("lash_left_tip"), archive.floats("lash_right_tip")),
        archive.ints("lash_quads"),
        archive.ints("lash_lower").astype(bool),
    )


def lash_points(lashes: Lashes, skin: Points, eye: Eye, side: str) -> Points:
    """(N, 3) m of one eye's lashes on posed skin: they stand off the ball, upwards and outwards."""
    number = 0 if side == "left" else 1
    reach = lashes.reach[number]
    root = bind(lashes.index[number], lashes.weight[number], skin)
    radial = unit(root - eye.centre)
    up = -radial * radial[:, 1:2]
    up[:, 1] += 1.0
    up = unit(up)
    aside = cross(up, radial)
    sign = 1.0 if number == 0 else -1.0
    direction = unit(radial + up * reach[:, 1:2] + sign * aside * reach[:, 2:3])
    return np.where(reach[:, 3:] > 0.0, root + direction * reach[:, :1], root + radial * 0.00012)


CARUNCLE_QUADS = np.array([[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 5, 6]])
CARUNCLE_MIRROR = (0, 3, 6, 1, 4, 5, 2)
"""Vertex that each becomes in the mirror: upper and lower change places, so that the polygons still face outwards."""


def caruncle(skin: Points, eye: Eye, side: str, archive: Archive) -> Points:
    """(7, 3) m, three polygons between the inner corner of the lids and the ball."""

    def vertex(name: str) -> Points:
        number = archive.vertex[name]
        return skin[number if side == "left" else int(archive.mirror[number])]

    centre, radius = eye.centre, eye.radius
    corner = centre + (vertex("e0_0") - centre) * 0.985
    above, below = (centre + (vertex(name) - centre) * 0.99 for name in ("ei_1", "ei_11"))
    middle = unit((above + below) * 0.5 - centre)
    ball = centre + middle * (radius - 0.0005)
    upper, lower = (centre + (vertex(name) * 0.4 + vertex("e0_0") * 0.6 - centre) * 0.985 for name in ("e0_1", "e0_11"))
    bulge = (corner + upper + lower + ball) * 0.25 + np.array([0.0, 0.0, 0.0005])
    points = np.stack([corner, upper, above, lower, bulge, ball, below])
    return points if side == "left" else points[list(CARUNCLE_MIRROR)]
