"""Faces that other programs can play, as glTF 2.0 in one file: mesh, morph targets, joints, and what they do over time.

What moves is one skinned mesh with a morph target for each of ARKit's names; what only turns (eyeballs, teeth) hangs on
its joint as it is. Metres, y up, the face looks along z: so it is in glTF, and with us. ADR 0013.

Source: Khronos Group, glTF 2.0 Specification.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mien.core import Face, Motion, Rig, Scene, Sound
from mien.timeline import Timeline

from .atomic import writing
from .glb_binary import Binary, Json
from .glb_meshes import Meshes
from .glb_motion import Recording, record, resting_pose
from .glb_targets import Anatomy, check_face
from .notes import software
from .wav import write_wav

Floats = NDArray[np.float64]

STILL = 1e-6
"""Turns and places (m) of joints that differ by less are the same."""

DECIMALS = 9

NO_TURN = (0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class Puppet:
    """A face with its morph targets and joints, that can be written.

    Attributes:
        anatomy: of the face.
        notes: text that goes into the file: what made it, which face.
        recording: what it does over time, if anything.
        sound: name of the file with what is heard meanwhile, if anything.
    """

    anatomy: Anatomy
    notes: Mapping[str, str] = field(default_factory=dict)
    recording: Recording | None = None
    sound: str = ""

    def write(self, path: Path | str) -> None:
        """Writes a ``.glb`` file.

        Raises:
            MienError: the place cannot be written, or a number of the mesh is not finite.
        """
        content = self.to_glb()
        with writing(path) as temporary:
            temporary.write_bytes(content)

    def to_glb(self) -> bytes:
        """The bytes of a ``.glb`` file; the same puppet has the same bytes."""
        binary, rig = Binary(), self.anatomy.rig
        meshes = Meshes(self.anatomy, binary)
        names = [node_name(joint.name) for joint in rig.joints]
        nodes = self._joints(meshes, names)
        shown: list[Json] = []
        for number, name in enumerate(names):
            turning = meshes.turning(number)
            if turning:
                nodes[number]["mesh"] = len(shown)
                shown.append({"name": name, "primitives": turning})
        nodes.append({"name": "face", "mesh": len(shown), "skin": 0})
        shown.append({"name": "face", "primitives": meshes.moving(), "extras": {"targetNames": [*self.anatomy.names]}})
        bind = np.tile(np.eye(4), (len(names), 1, 1))
        bind[:, 3, :3] = -rig.pivots  # columns lie one after the other
        skin = {"joints": list(range(len(names))), "inverseBindMatrices": binary.add_samples(bind.reshape(-1, 16))}
        roots = [number for number, parent in enumerate(rig.parents) if parent < 0]
        document: Json = {
            "asset": {"version": "2.0", "generator": software(), "extras": dict(self.notes)},
            "scene": 0,
            "scenes": [{"nodes": [*roots, len(names)]}],
            "nodes": nodes,
            "meshes": shown,
            "skins": [skin],
            "materials": meshes.materials,
        }
        extensions = sorted({name for material in meshes.materials for name in material.get("extensions", ())})
        if extensions:
            document["extensionsUsed"] = extensions
        if self.recording is not None:
            document["animations"] = [self._animation(self.recording, nodes, binary)]
        return binary.to_glb(document)

    def _joints(self, meshes: Meshes, names: list[str]) -> list[Json]:
        """A node for each joint, as it stands in the base; its extras say how it stands when a target is at 1."""
        rig = self.anatomy.rig
        nodes: list[Json] = []
        for number, (name, stand) in enumerate(zip(names, stands(rig, meshes.motion), strict=True)):
            children = [child for child, parent in enumerate(rig.parents) if parent == number]
            nodes.append({"name": name, **stand, **({"children": children} if children else {})})
        for change in meshes.changes:
            for node, before, after in zip(nodes, stands(rig, change.before), stands(rig, change.after), strict=True):
                if after != before:
                    node.setdefault("extras", {}).setdefault("targets", {})[change.name] = after
        return nodes

    def _animation(self, recording: Recording, nodes: list[Json], binary: Binary) -> Json:
        """What the recording does; joints that stay where they are have no channel."""
        times = binary.add_samples(recording.times_s[:, None], bounds=True)
        samplers: list[Json] = []
        channels: list[Json] = []

        def add(node: int, path: str, values: Floats) -> None:
            samplers.append({"input": times, "output": binary.add_samples(values), "interpolation": "LINEAR"})
            channels.append({"sampler": len(samplers) - 1, "target": {"node": node, "path": path}})

        add(len(nodes) - 1, "weights", recording.weights.reshape(-1, 1))
        for joint in range(len(nodes) - 1):
            for path, values in (("rotation", recording.turns[:, joint]), ("translation", recording.places[:, joint])):
                if (np.abs(values - nodes[joint].get(path, NO_TURN)) > STILL).any():
                    add(joint, path, values)
        heard = {"extras": {"sound": self.sound}} if self.sound else {}
        return {"name": "performance", "channels": channels, "samplers": samplers, **heard}


def write_glb(
    timeline: Timeline,
    path: Path | str,
    *,
    face: Face,
    scene: Scene,
    rate: Fraction,
    sound: Sound | None,
    notes: Mapping[str, str],
) -> None:
    """Writes a performance: ``x.glb``, and its sound as ``x.wav`` beside it.

    Raises:
        MienError: the face cannot be a puppet, or the place cannot be written; then neither file has changed.
    """
    path = Path(path)
    beside = path.with_suffix(".wav")
    anatomy = Anatomy(face, resting_pose(check_face(face), timeline, scene, rate), scene.subdivide)
    puppet = Puppet(anatomy, notes, record(anatomy, timeline, scene, rate), "" if sound is None else beside.name)
    content = puppet.to_glb()
    with ExitStack() as stack:
        # Both are complete before either takes its place; what names the sound does so last.
        stack.enter_context(writing(path)).write_bytes(content)
        if sound is not None:
            write_wav(sound, stack.enter_context(writing(beside)))


def node_name(joint: str) -> str:
    """``eyeLeft`` of ``eye.left``: dots are no part of a name in programs that address nodes by paths."""
    first, *others = joint.split(".")
    return first + "".join(word.capitalize() for word in others)


def stands(rig: Rig, motion: Motion) -> list[Json]:
    """How each joint stands, as the fields of a node."""
    turns, places = rig.steps(motion)
    out = []
    for turn, place in zip(turns.round(DECIMALS) + 0.0, places.round(DECIMALS) + 0.0, strict=True):
        rotation = {} if tuple(turn) == NO_TURN else {"rotation": turn.tolist()}
        out.append({"translation": place.tolist(), **rotation})
    return out
