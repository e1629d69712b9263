"""The meshes of a face as glTF has them: what only turns, one joint each, and what moves, with its morph targets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.core import Material, MienError, Motion, Part
from mien.core.mesh import Points

from .glb_binary import Binary, Json
from .glb_pieces import MIXED, Piece, cut_pieces, describe_material, split_vertices
from .glb_targets import STILL_M, Anatomy, Apart
from .obj import corner_normals

Floats = NDArray[np.float64]

STILL_NORMAL, STILL_COLOR = 0.01, 0.004
"""A target that changes a normal or a colour by less leaves it as it is."""

MOST_JOINTS = 4
"""Joints that may move one vertex."""


@dataclass(frozen=True, eq=False)
class Change:
    """What a morph target does.

    Attributes:
        name: of the target.
        moves: (V, 3) m.
        normals: (M, 3), added to those of the base.
        colors: what is added to the mesh's colours: creases and shadows.
        before: how the joints have moved without it.
        after: how they have moved when it is at its fullest.
    """

    name: str
    moves: Points
    normals: Floats
    colors: Floats
    before: Motion
    after: Motion


class Meshes:
    """The meshes of a face in its base pose.

    Args:
        anatomy: of the face.
        binary: where arrays go.

    Raises:
        MienError: a number of the mesh is not finite.
    """

    def __init__(self, anatomy: Anatomy, binary: Binary) -> None:
        self._binary, self._pivots = binary, anatomy.rig.pivots
        base = anatomy.take_apart(anatomy.base)
        self._mesh, self.motion = base.mesh, base.motion
        if not (np.isfinite(base.mesh.points).all() and np.isfinite(base.mesh.colors).all()):
            raise MienError("a mesh to be written has a point or a colour that is not a finite number")
        self._vertices, self._normals = split_vertices(base.mesh)
        self.changes = self._changes(anatomy, base)
        moved = np.logical_or.reduce([_large(change.moves, STILL_M) for change in self.changes])
        self._shares = anatomy.shares
        self._pieces = cut_pieces(base.mesh.topology, self._vertices, self._shares, moved)
        self._materials: dict[Material, Json] = {}

    @property
    def materials(self) -> list[Json]:
        """Those of the primitives so far."""
        return list(self._materials.values())

    def turning(self, joint: int) -> list[Json]:
        """Primitives that hang on a joint, seen from it."""
        return [self._primitive(piece, self._pivots[joint]) for piece in self._pieces if piece.joint == joint]

    def moving(self) -> list[Json]:
        """Primitives with morph targets and shares of the joints."""
        out = []
        for piece in self._pieces:
            if piece.joint == MIXED:
                primitive = self._primitive(piece, np.zeros(3))
                primitive["attributes"] |= self._weights(piece)
                primitive["targets"] = [self._target(piece, change) for change in self.changes]
                out.append(primitive)
        return out

    def _changes(self, anatomy: Anatomy, base: Apart) -> list[Change]:
        changes = []
        for name in anatomy.names:
            poses = anatomy.poses_of(name)
            before, after = (base if pose is anatomy.base else anatomy.take_apart(pose) for pose in poses)
            earlier = self._normals if before is base else corner_normals(before.mesh)[0]
            normals = corner_normals(after.mesh)[0] - earlier
            moves = after.mesh.points - before.mesh.points
            colors = after.mesh.colors - before.mesh.colors
            changes.append(Change(name, moves, normals, colors, before.motion, after.motion))
        return changes

    def _primitive(self, piece: Piece, origin: Points) -> Json:
        binary, vertices, rows = self._binary, self._vertices, piece.rows
        return {
            "attributes": {
                "POSITION": binary.add_attribute(self._mesh.points[vertices.vertex[rows]] - origin, bounds=True),
                "NORMAL": binary.add_attribute(self._normals[vertices.normal[rows]]),
                "COLOR_0": binary.add_attribute(np.clip(self._mesh.colors[vertices.color[rows]], 0.0, 1.0)),
            },
            "indices": binary.add_triangles(piece.triangles, len(rows)),
            "material": self._material(piece.part),
            "extras": {"part": piece.part.name},
        }

    def _weights(self, piece: Piece) -> Json:
        shares = self._shares[self._vertices.vertex[piece.rows]]
        joints = np.argsort(-shares, axis=1, kind="stable")[:, :MOST_JOINTS]
        weights = np.zeros((len(shares), MOST_JOINTS))
        weights[:, : joints.shape[1]] = np.take_along_axis(shares, joints, axis=1)
        numbers = np.zeros((len(shares), MOST_JOINTS), dtype=np.int64)
        numbers[:, : joints.shape[1]] = joints
        numbers[weights == 0.0] = 0
        return {
            "JOINTS_0": self._binary.add_attribute(numbers, "u1"),
            "WEIGHTS_0": self._binary.add_attribute(weights),
        }

    def _target(self, piece: Piece, change: Change) -> Json:
        moves = change.moves[self._vertices.vertex[piece.rows]]
        normals = change.normals[self._vertices.normal[piece.rows]]
        colors = change.colors[self._vertices.color[piece.rows]]
        return {
            "POSITION": self._binary.add_sparse(moves, _large(moves, STILL_M)),
            "NORMAL": self._binary.add_sparse(normals, _large(normals, STILL_NORMAL)),
            "COLOR_0": self._binary.add_sparse(colors, _large(colors, STILL_COLOR)),
        }

    def _material(self, part: Part) -> int:
        name = part.name.split(".")[0]
        self._materials.setdefault(part.material, describe_material(part.material, name))
        return list(self._materials).index(part.material)


def _large(vectors: Floats, limit: float) -> NDArray[np.bool_]:
    """(N,) whether one of the three numbers of a vector (N, 3) is beyond the limit."""
    large: NDArray[np.bool_] = np.abs(vectors).max(axis=1) > limit
    return large
