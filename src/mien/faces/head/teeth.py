"""Size and shape of the teeth: moves of their crowns.

Source: Parke 1974, section 5.1 (wished for there).
"""

from __future__ import annotations

import numpy as np

from mien.core.mesh import Points

from .vectors import length

TEETH_FIELDS = ("length", "width", "taper")

RINGS, SIDES = 4, 8
"""Rings of a crown from the gum to the edge, and the vertices around each; one vertex more closes the edge."""

TAPER = 0.5
"""Share of its width that the edge of a crown loses at the end of the range."""


def teeth_field(teeth: Points, name: str) -> Points:
    """(T, 3) m, the moves of teeth (T, 3) m, crown by crown, for one unit of one of ``TEETH_FIELDS``."""
    crowns = teeth.reshape(-1, RINGS * SIDES + 1, 3)
    rings = crowns[:, :-1].reshape(len(crowns), RINGS, SIDES, 3)
    # Means as sums in order, so that no library decides a bit.
    middles = np.add.accumulate(rings, axis=2)[:, :, -1] / SIDES
    root, edge = middles[:, 0, None], middles[:, -1, None]
    along = (edge - root) / length(edge - root)[..., None]
    if name == "length":
        moves = _component(crowns - root, along)
    else:
        across = rings[:, :1, 2] - rings[:, :1, 0]
        across = across / length(across)[..., None]
        moves = _component(crowns - 0.5 * (root + edge), across)
        if name == "taper":
            depth = (crowns - root) * along
            down = (depth[..., 0] + depth[..., 1] + depth[..., 2]) / length(edge - root)
            moves *= -2.0 * TAPER * np.clip(down, 0.0, 1.0)[..., None]
    return moves.reshape(-1, 3)


def _component(vectors: Points, axis: Points) -> Points:
    """The part of vectors (..., 3) along unit vectors."""
    product = vectors * axis
    return np.asarray((product[..., 0] + product[..., 1] + product[..., 2])[..., None] * axis)
