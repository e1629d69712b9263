"""The rigid parts of a measured face: the head, and eyes that turn."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mien.core import Joint, Rig
from mien.core.mesh import Ints
from mien.core.rig import pick_anchors

if TYPE_CHECKING:
    from .face import KeyposeFace

HEAD = ("head.turn", "head.nod", "head.tilt")

ANCHORS = 3

STILLEST = 12
"""Of so many vertices that the phases move least, three tell where the head is."""


def keypose_rig(face: KeyposeFace) -> Rig:
    """The joints of a measured face, which turn about the same points in every pose; shoulders stay with the body.

    The vertices that say how the head has moved are those that the phases move least: in a glTF file the phases are
    targets, and the head turns beneath them.
    """
    rest, share = face.shape(face.neutral).points, np.zeros(face.topology.vertex_count) + face.neck_share
    turning, staying = np.flatnonzero(share == 1.0), np.flatnonzero(share == 0.0)
    body = len(staying) >= ANCHORS
    joints = [Joint("body", None, face.pivot, pick_anchors(rest, staying), ())] if body else []
    head = _stillest(turning if len(turning) >= ANCHORS else np.arange(len(rest)), face.reach_m)
    joints.append(Joint("head", "body" if body else None, face.pivot, pick_anchors(rest, head), HEAD))
    shares = np.zeros((len(rest), len(joints) + len(face.eyeballs)))
    shares[:, 0] = 1.0 - share if body else 1.0
    shares[:, len(joints) - 1] = share if body else 1.0
    for number, (side, (vertices, center)) in enumerate(face.eyeballs.items(), start=len(joints)):
        names = (f"eye.turn.{side}", f"eye.nod.{side}")
        joints.append(Joint(f"eye.{side}", "head", center, pick_anchors(rest, vertices), names))
        shares[vertices] = np.eye(shares.shape[1])[number]
    return Rig(tuple(joints), shares)


def _stillest(vertices: Ints, reach_m: NDArray[np.float64]) -> Ints:
    """Those of some vertices that the phases move least."""
    reach = reach_m[vertices]
    return vertices[reach <= np.sort(reach)[min(STILLEST, len(reach)) - 1]]
