"""The rigid parts of a measured face: the head, and eyes that turn."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mien.core import Joint, Rig
from mien.core.rig import pick_anchors

if TYPE_CHECKING:
    from .face import KeyposeFace

HEAD = ("head.turn", "head.nod", "head.tilt")

STILLEST = 12
"""Of so many vertices that the phases move least, three tell where the head is."""


def keypose_rig(face: KeyposeFace) -> Rig:
    """The joints of a measured face, which turn about the same points in every pose.

    The vertices that say how the head has moved are those that the phases move least: in a glTF file the phases are
    targets, and the head turns beneath them.
    """
    still = np.flatnonzero(face.reach_m <= np.sort(face.reach_m)[min(STILLEST, len(face.reach_m)) - 1])
    rest = face.shape(face.neutral).points
    joints = [Joint("head", None, face.pivot, pick_anchors(rest, still), HEAD)]
    shares = np.zeros((len(rest), 1 + len(face.eyeballs)))
    shares[:, 0] = 1.0
    for number, (side, (vertices, center)) in enumerate(face.eyeballs.items(), start=1):
        names = (f"eye.turn.{side}", f"eye.nod.{side}")
        joints.append(Joint(f"eye.{side}", "head", center, pick_anchors(rest, vertices), names))
        shares[vertices] = np.eye(shares.shape[1])[number]
    return Rig(tuple(joints), shares)
