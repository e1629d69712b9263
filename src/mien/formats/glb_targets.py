"""A face taken apart: joints, the form that is left when they are at rest, and what names of a vocabulary do to it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mien.core import Drawing, Face, Mesh, MienError, Motion, Pose, Rigged, subdivide
from mien.core.mesh import Points
from mien.core.rig import unmoved, unturned
from mien.core.subdivision import refine
from mien.vocab import next_step, pose_from, vocabulary
from mien.vocab.rules import companions

Floats = NDArray[np.float64]

VOCABULARY = "arkit"

STILL_M = 2e-6
"""A target that moves a coordinate by less leaves it where it is."""


@dataclass(frozen=True, eq=False)
class Apart:
    """A pose taken apart.

    Attributes:
        mesh: with every joint at rest.
        motion: how the joints have moved.
    """

    mesh: Mesh
    motion: Motion


class Anatomy:
    """A face that can be taken apart.

    Args:
        face: has a mesh, joints, and a table for ``VOCABULARY``.
        base: the pose in which no target acts.
        levels: how often the mesh is subdivided.

    Raises:
        MienError: the face lacks one of them.
    """

    def __init__(self, face: Face, base: Pose, levels: int) -> None:
        self.face = check_face(face if levels else face.unsubdivided)
        self.base, self.levels = base, levels
        self.names = vocabulary(VOCABULARY).names
        self.rig = self.face.rig(base)
        rest = _mesh(self.face, self.rig.rest(base))
        self._rest = rest.points
        self.shares, topology = self.rig.shares, rest.topology
        for _ in range(levels):
            fine = refine(topology)
            self.shares, topology = fine.matrix.apply(self.shares), fine.topology

    def take_apart(self, pose: Pose) -> Apart:
        """A pose taken apart, subdivided."""
        mesh = _mesh(self.face, pose)
        motion = self.rig.motion(self._rest, mesh.points)
        mesh = subdivide(mesh, self.levels)
        normals = None if mesh.normals is None else unturned(mesh.normals, self.shares, motion)
        return Apart(replace(mesh, points=unmoved(mesh.points, self.shares, motion), normals=normals), motion)

    def bring_to_rest(self, pose: Pose) -> tuple[Points, Motion]:
        """(V, 3) m, where the points of a pose that is not subdivided are with all joints at rest; how they moved."""
        points = _mesh(self.face, pose).points
        motion = self.rig.motion(self._rest, points)
        return unmoved(points, self.rig.shares, motion), motion

    def poses_of(self, name: str) -> tuple[Pose, Pose]:
        """The base without and with a name of the vocabulary at its fullest.

        Both have what it is nothing without: of ``mouthClose``, the open jaw.
        """
        beside = companions(VOCABULARY, name)
        before = pose_from(VOCABULARY, beside, self.face, self.base) if beside else self.base
        return before, pose_from(VOCABULARY, {**beside, name: 1.0}, self.face, self.base)


def check_face(face: Face) -> Rigged:
    """The face, when it can be taken apart.

    Raises:
        MienError: it has no mesh, no joints, or nothing says what ``VOCABULARY`` does to it.
    """
    _mesh(face, Pose.neutral(face.parameters))
    if not isinstance(face, Rigged):
        raise MienError(f"{face.name}: has no joints (eyes, jaw), which .glb wants — write its mesh as .obj")
    next_step(VOCABULARY, face.family)
    return face


def _mesh(face: Face, pose: Pose) -> Mesh:
    shape = face.shape(pose)
    if isinstance(shape, Drawing):
        raise MienError(f"{face.name}: is a flat drawing and has no mesh — write it as .svg, or as a film")
    return shape
