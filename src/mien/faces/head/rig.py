"""What of a head moves as a whole: skull, jaw and eyes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mien.core import Joint, Mesh, Pose, Rig
from mien.core.mesh import Ints, Points
from mien.core.rig import find_motion, find_pivot, pick_anchors

from .measured import Floats
from .neck import neck_share
from .parts import Layout

TARGET = ("target.x", "target.y", "target.z")

JOINTS = (  # name, what carries it, parameters that turn it, other parameters that move it
    ("body", None, (), ()),
    ("head", "body", ("head.turn", "head.nod", "head.tilt"), ("head.forward",)),
    ("jaw", "head", ("jaw.rotation",), ("jaw.side", "jaw.forward")),
    *((f"eye.{side}", "head", (f"eye.turn.{side}", f"eye.nod.{side}"), TARGET) for side in ("left", "right")),
)
NAMES = tuple(name for name, *_ in JOINTS)

PROBE_DEG = 10.0
"""A joint is turned by this angle to see what it turns about: whatever this person's proportions, it stays there."""


def head_rig(layout: Layout, measured: Points, pose: Pose, shape: Callable[[Pose], Mesh]) -> Rig:
    """The joints of a head as it is in a pose.

    Args:
        layout: where its parts are.
        measured: (S, 3) m, the skin at rest.
        pose: of its table.
        shape: the head in a pose.
    """
    table = pose.table
    still = pose.replace({name: table[name].default for *_, turns, moves in JOINTS for name in (*turns, *moves)})
    rest = shape(still).points
    joints = []
    for name, parent, turns, moves in JOINTS:
        anchors = pick_anchors(rest, _rigid(layout, name))
        probes = [
            find_motion(np.array([anchors]), rest, shape(still.replace({turn: PROBE_DEG})).points) for turn in turns
        ]
        joints.append(Joint(name, parent, find_pivot(probes), anchors, (*turns, *moves)))
    return Rig(tuple(joints), _shares(layout, measured))


def _rigid(layout: Layout, joint: str) -> Ints:
    """Vertices that nothing but the joint moves."""
    if joint.startswith("eye"):
        return _numbers(layout.span[joint])[-layout.sides :]  # the ring farthest back
    if joint == "body":
        return _numbers(layout.span["collar"])
    lower, depth = layout.lower["teeth"], layout.rest["teeth"][:, 2]
    row = lower if joint == "jaw" else ~lower
    # Lips that press on the front teeth make them give way; nothing presses on the molars.
    return _numbers(layout.span["teeth"])[row & (depth < np.quantile(depth[row], 0.4))]


def _shares(layout: Layout, measured: Points) -> Floats:
    """(V, J) how much of each vertex goes with each joint."""
    shares = np.zeros((layout.topology.vertex_count, len(JOINTS)))
    body, head, jaw, *_ = np.eye(len(JOINTS))
    shares[:] = head
    shares[layout.span["collar"]] = body
    neck = neck_share(measured)[:, None]
    on_neck = neck * head + (1.0 - neck) * body
    shares[layout.span["skin"]] = on_neck[layout.skin]
    shares[layout.span["beard"]] = on_neck[layout.beard.index[:, 0]]
    shares[layout.span["tongue"]] = jaw
    for name in ("teeth", "gums"):
        shares[_numbers(layout.span[name])[layout.lower[name]]] = jaw
    for name, whole in zip(NAMES, np.eye(len(JOINTS)), strict=True):
        if name in layout.span:
            shares[layout.span[name]] = whole
    return shares


def _numbers(run: slice) -> Ints:
    return np.arange(run.start, run.stop)
