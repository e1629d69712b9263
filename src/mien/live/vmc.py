"""What trackers and avatar programs say by VMC (OSC), as messages for a session.

Source: VMC protocol 3.1, what is sent to a Marionette; bones in Unity's axes: x to the own right, y up, z forward.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from mien.core import Face, MienError, Pose
from mien.vocab import load_remap, next_step, pose_from, vocabulary

from .fields import show
from .osc import Argument
from .slices import count_slices
from .turning import Angles, Quaternion, compose, to_angles

PREFIX = "/VMC/"
VALUE, APPLY, BONE = "/VMC/Ext/Blend/Val", "/VMC/Ext/Blend/Apply", "/VMC/Ext/Bone/Pos"

VOCABULARIES = ("vrm", "arkit")
"""Whose names are understood, in whatever capitals. They share none."""

HOLD_S = 2.0
LET_GO_MS = 500.0
"""A face stays so long where a tracker that fell silent has left it, and goes back to its own life in this time."""

HEAD_BONES = ("Neck", "Head")
"""From the trunk upwards."""

EYE_BONES = ("LeftEye", "RightEye")

_AXES: Mapping[str, tuple[str, ...]] = {
    "Head": ("head_turn", "head_nod", "head_tilt"),
    "LeftEye": ("PLH", "PLV"),
    "RightEye": ("PRH", "PRV"),
}
"""Channels and motor codes that turn, nod and tilt on every face; Neck and Head are one there."""

_MIRRORED = ("PLH", "PRH")
"""Codes that count to the left as one sees the picture: the own right."""

Axis = tuple[int, str, float]
"""Which of turn, nod and tilt, the parameter that does it, and how many of its units a degree is."""


class VmcReceiver:
    """A tracker, or several that tell different things.

    Values of expressions count from ``Apply`` on, and until they are told anew; bones at once. The parameters that
    told names reach are held in the layer ``direct``: idle life goes on in all others. After ``HOLD_S`` without news
    they are let go.

    Args:
        face: who plays it.
        loop_s: length of a loop, seconds.
        rest: the pose that all of it is on top of; None is neutral.
    """

    def __init__(self, face: Face, loop_s: float, rest: Pose | None = None) -> None:
        self.face, self.rest = face, rest or face.neutral
        self._hold = count_slices(HOLD_S, loop_s)
        self._known = {
            spelling.lower(): (name, vocabulary(name).resolve(spelling)[0])
            for name in VOCABULARIES
            for spelling in (*vocabulary(name).names, *vocabulary(name).aliases)
        }
        self._reach = {name: reach(name, face) for name in VOCABULARIES}
        self._axes = bone_axes(face)
        self._values: dict[tuple[str, str], float] = {}
        self._applied: dict[tuple[str, str], float] = {}
        self._bones: dict[str, Quaternion] = {}
        self._held: dict[str, None] = {}
        self._news, self._heard = False, 0

    def take(self, address: str, arguments: Sequence[Argument]) -> None:
        """Hear one call; addresses that mean nothing to a face are passed over.

        Raises:
            MienError: the arguments do not suit, or an expression is unknown.
        """
        if address == VALUE:
            name, (value,) = _read(address, arguments, 1)
            if name.lower() not in self._known:
                raise MienError(f"{VALUE}: {show(name)} is no expression of VRM and none of ARKit's")
            self._values[self._known[name.lower()]] = min(max(value, 0.0), 1.0)
        elif address == APPLY:
            self._applied = dict(self._values)
            self._news = True
        elif address == BONE:
            name, numbers = _read(address, arguments, 7)
            if name in (*HEAD_BONES, *EYE_BONES):
                self._bones[name] = _unit(numbers[3:])
                self._news = True

    def messages(self, loop: int) -> list[dict[str, Any]]:
        """What a session has to be told at a loop: where the face is now, or that nobody holds it any more."""
        if self._news:
            self._news, self._heard = False, loop
            values = self.values()
            self._held |= dict.fromkeys(values)
            return [{"kind": "move", "values": values}] if values else []
        if self._held and loop - self._heard >= self._hold:
            names = list(self._held)
            self._forget()
            return [{"kind": "stop", "layer": "direct", "names": names, "over_ms": LET_GO_MS}]
        return []

    def values(self) -> dict[str, float]:
        """The parameters of the face that names and bones reach, by what has been applied."""
        pose, reached = self.rest, dict[str, None]()
        for name in VOCABULARIES:
            given = {each: value for (known, each), value in self._applied.items() if known == name}
            pose = pose_from(name, given, self.face, pose) if given else pose
            for each in given:
                reached |= dict.fromkeys(self._reach[name].get(each, ()))
        found = {parameter: float(pose[parameter]) for parameter in reached}
        for bone, angles in self._angles():
            for number, parameter, gain in self._axes[bone]:
                row = self.face.parameters[parameter]
                value = found.get(parameter, self.rest[parameter]) + gain * angles[number]
                found[parameter] = min(max(value, row.low), row.high)
        return found

    def _angles(self) -> list[tuple[str, Angles]]:
        found = [(bone, to_angles(self._bones[bone])) for bone in EYE_BONES if bone in self._bones]
        turned = [self._bones[bone] for bone in HEAD_BONES if bone in self._bones]
        return [*found, ("Head", to_angles(compose(turned)))] if turned else found

    def _forget(self) -> None:
        for told in (self._values, self._applied, self._bones, self._held):
            told.clear()


def reach(name: str, face: Face) -> dict[str, tuple[str, ...]]:
    """The parameters of a face that each name of a vocabulary moves, without names that move nothing."""
    step = next_step(name, face.family)
    remap = load_remap(name, step)
    own = step == face.family
    below = {} if own else reach(step, face)
    found: dict[str, dict[str, None]] = {}
    for link in remap.on(face.parameters).links if own else remap.links:
        if link.gain:
            moved = (link.parameter,) if own else below.get(link.parameter, ())
            found.setdefault(link.name, {}).update(dict.fromkeys(moved))
    return {each: tuple(moved) for each, moved in found.items() if moved}


def bone_axes(face: Face) -> dict[str, tuple[Axis, ...]]:
    """What turns, nods and tilts the head and the eyes of a face, by bone; strict drawings tilt nothing."""
    found = {}
    for bone, codes in _AXES.items():
        links = {
            link.name: link
            for vocabulary_name in ("channels", "toonface")
            for link in load_remap(vocabulary_name, face.family).on(face.parameters).links
        }
        found[bone] = tuple(
            (number, links[code].parameter, links[code].gain * (-1.0 if code in _MIRRORED else 1.0))
            for number, code in enumerate(codes)
            if code in links
        )
    return found


def _read(address: str, arguments: Sequence[Argument], count: int) -> tuple[str, tuple[float, ...]]:
    """The name and so many finite numbers behind it; more arguments than that are passed over.

    Raises:
        MienError: there are too few, or others.
    """
    name, numbers = arguments[0] if arguments else None, arguments[1 : 1 + count]
    fine = [
        float(each)
        for each in numbers
        if isinstance(each, int | float) and not isinstance(each, bool) and math.isfinite(each)
    ]
    if not isinstance(name, str) or len(fine) < count:
        raise MienError(f"{address}: want a name and {count} numbers")
    return name, tuple(fine)


def _unit(numbers: tuple[float, ...]) -> Quaternion:
    x, y, z, w = numbers
    length = math.sqrt(x * x + y * y + z * z + w * w)
    if not 0.5 < length < 2.0:
        raise MienError(f"{BONE}: a rotation of length {length:.3g} — want 1")
    return x / length, y / length, z / length, w / length
