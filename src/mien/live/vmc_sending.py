"""A face as packets of VMC (OSC), for avatar programs.

Source: VMC protocol 3.1, what is sent to a Marionette.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from mien.core import Face, Pose, UnknownNameError
from mien.vocab import vocabulary
from mien.vocab.inverse import Inverse

from .osc import encode_bundles, encode_call
from .turning import Quaternion, from_angles, halve
from .vmc import APPLY, BONE, VALUE, bone_axes

NAMES: Mapping[str, tuple[str, bool]] = MappingProxyType(
    {"vrm0": ("vrm", True), "vrm1": ("vrm", False), "arkit": ("arkit", False), "perfect-sync": ("arkit", True)}
)
"""Sets of names: which vocabulary, and whether in its first other spelling (``Joy``, ``EyeBlinkLeft``)."""

BY_BONES = ("gaze", "eye")
"""Groups of names that say what the bones of the eyes say already: they are sent as 0, or eyes would turn twice."""

TWICE = ("blink",)
"""What two other names say together."""

LONGEST = 1400
"""Bytes of a packet, so that it travels in one piece."""

OK, TIME = "/VMC/Ext/OK", "/VMC/Ext/T"

READY = (1, 3, 0, 1)
"""Loaded, calibrated, in the usual mode, tracking."""

NOWHERE = (0.0, 0.0, 0.0)
"""The position of every bone: we do not know the avatar's. Programs that take it in have an option against it."""


class VmcEncoder:
    """Makes packets of poses of a face.

    Args:
        face: whose poses.
        names: one of ``NAMES``.

    Raises:
        UnknownNameError: there is no such set of names.
        MienError: the face cannot play it.
    """

    def __init__(self, face: Face, names: str = "vrm0") -> None:
        if names not in NAMES:
            raise UnknownNameError("set of VMC names", names, NAMES)
        vocabulary_name, respelled = NAMES[names]
        table = vocabulary(vocabulary_name)
        spelled = {name: alias for alias, name in reversed(tuple(table.aliases.items()))} if respelled else {}
        self._spelling = {name: spelled.get(name, name) for name in table.names}
        self._inverse = Inverse(
            vocabulary_name, face, [row.name for row in table if row.group in BY_BONES or row.name in TWICE]
        )
        self._axes = bone_axes(face)
        self._face = face

    def encode(self, pose: Pose, time_s: float) -> list[bytes]:
        """Packets of at most ``LONGEST`` bytes that say all of a pose.

        Args:
            pose: of the face.
            time_s: on a clock of ours.
        """
        return list(encode_bundles(self._calls(pose, time_s), LONGEST))

    def _calls(self, pose: Pose, time_s: float) -> Iterator[bytes]:
        yield encode_call(OK, *READY)
        yield encode_call(TIME, time_s)
        for bone, rotation in self._bones(pose).items():
            yield encode_call(BONE, bone, *NOWHERE, *rotation)
        for name, value in self._inverse.find(pose).items():
            yield encode_call(VALUE, self._spelling[name], value)
        yield encode_call(APPLY)

    def _bones(self, pose: Pose) -> dict[str, Quaternion]:
        found = {}
        for bone, axes in self._axes.items():
            angles = [0.0, 0.0, 0.0]
            for number, parameter, gain in axes:
                angles[number] = (pose[parameter] - self._face.parameters[parameter].default) / gain
            found[bone] = from_angles(*angles)
        # Half of a turn is the neck's, as people turn; together they make all of it.
        return {**found, "Neck": halve(found["Head"]), "Head": halve(found["Head"])}
