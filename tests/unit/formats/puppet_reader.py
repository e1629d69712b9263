"""A reader of ``.glb`` files that poses them: nodes, skin, morph targets, animation, as the specification says.

pygltflib tells what is in the file; everything is reckoned from that here, not by our writer's code.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from pygltflib import GLTF2

TYPES = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


@dataclass
class Stand:
    """How a node stands."""

    translation: np.ndarray
    rotation: np.ndarray

    def matrix(self) -> np.ndarray:
        """(4, 4)."""
        x, y, z, w = self.rotation / np.linalg.norm(self.rotation)
        out = np.eye(4)
        out[:3, :3] = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
        out[:3, 3] = self.translation
        return out


@dataclass
class Shown:
    """A primitive as it is seen: in metres, in the room."""

    part: str
    points: np.ndarray
    normals: np.ndarray
    colors: np.ndarray
    triangles: np.ndarray


@dataclass
class PuppetFile:
    """What is in a file."""

    gltf: GLTF2
    data: bytes = field(repr=False)

    @classmethod
    def parse(cls, content: bytes) -> PuppetFile:
        """From the bytes of a ``.glb`` file."""
        gltf = GLTF2.load_from_bytes(content)
        return cls(gltf, gltf.binary_blob())

    @property
    def target_names(self) -> list[str]:
        """Of the mesh that has them."""
        return self.gltf.meshes[-1].extras["targetNames"]

    def accessor(self, number: int) -> np.ndarray:
        """(N, K) numbers of an accessor, sparse ones filled in."""
        a = self.gltf.accessors[number]
        width, kind = WIDTHS[a.type], np.dtype(TYPES[a.componentType])
        out = np.zeros((a.count, width), dtype=kind)
        if a.bufferView is not None:
            out[:] = self._read(a.bufferView, a.byteOffset or 0, a.count, width, kind)
        if a.sparse is not None:
            s = a.sparse
            index_kind = np.dtype(TYPES[s.indices.componentType])
            rows = self._read(s.indices.bufferView, s.indices.byteOffset or 0, s.count, 1, index_kind)[:, 0]
            assert (np.diff(rows.astype(int)) > 0).all()
            out[rows] = self._read(s.values.bufferView, s.values.byteOffset or 0, s.count, width, kind)
        return out

    def _read(self, view: int, offset: int, count: int, width: int, kind: np.dtype) -> np.ndarray:
        v = self.gltf.bufferViews[view]
        step = v.byteStride or width * kind.itemsize
        start = (v.byteOffset or 0) + offset
        assert start % kind.itemsize == 0
        assert offset + (count - 1) * step + width * kind.itemsize <= v.byteLength
        return np.ndarray((count, width), kind, self.data, start, (step, kind.itemsize))

    def stands(self, target: str | None = None) -> dict[int, Stand]:
        """How every node stands; with a target at 1, where the nodes' extras say so."""
        out = {}
        for number, node in enumerate(self.gltf.nodes):
            translation, rotation = node.translation or [0, 0, 0], node.rotation or [0, 0, 0, 1]
            told = (node.extras or {}).get("targets", {}).get(target)
            if told:
                translation, rotation = told["translation"], told.get("rotation", [0, 0, 0, 1])
            out[number] = Stand(np.array(translation, dtype=float), np.array(rotation, dtype=float))
        return out

    def frame(self, number: int) -> tuple[dict[int, Stand], np.ndarray]:
        """How nodes stand, and the weights, at a frame of the animation."""
        animation = self.gltf.animations[0]
        stands, weights = self.stands(), np.zeros(len(self.target_names))
        for channel in animation.channels:
            values = self.accessor(animation.samplers[channel.sampler].output)
            if channel.target.path == "weights":
                weights = values.reshape(-1, len(weights))[number]
            else:
                setattr(stands[channel.target.node], channel.target.path, values[number].astype(float))
        return stands, weights

    def show(self, stands: dict[int, Stand] | None = None, weights: np.ndarray | None = None) -> list[Shown]:
        """All primitives, posed."""
        stands = stands or self.stands()
        world: dict[int, np.ndarray] = {}

        def walk(node: int, parent: np.ndarray) -> None:
            world[node] = parent @ stands[node].matrix()
            for child in self.gltf.nodes[node].children or []:
                walk(child, world[node])

        for root in self.gltf.scenes[self.gltf.scene].nodes:
            walk(root, np.eye(4))
        out = []
        for number, node in enumerate(self.gltf.nodes):
            if node.mesh is None:
                continue
            for primitive in self.gltf.meshes[node.mesh].primitives:
                points, normals, colors = (
                    self.accessor(getattr(primitive.attributes, name)).astype(float)
                    for name in ("POSITION", "NORMAL", "COLOR_0")
                )
                for weight, target in zip([] if weights is None else weights, primitive.targets or [], strict=False):
                    points = points + weight * self.accessor(target["POSITION"])
                    normals = normals + weight * self.accessor(target["NORMAL"])
                    colors = colors + weight * self.accessor(target["COLOR_0"])
                matrices = self._skin(node.skin, primitive, world) if node.skin is not None else world[number][None]
                points = np.einsum("nab,nb->na", matrices[:, :3, :3] + np.zeros((len(points), 1, 1)), points)
                points += matrices[:, :3, 3]
                normals = np.einsum("nab,nb->na", matrices[:, :3, :3] + np.zeros((len(points), 1, 1)), normals)
                triangles = self.accessor(primitive.indices).reshape(-1, 3).astype(np.int64)
                out.append(Shown(primitive.extras["part"], points, normals, colors, triangles))
        return out

    def _skin(self, number: int, primitive: object, world: dict[int, np.ndarray]) -> np.ndarray:
        skin = self.gltf.skins[number]
        bind = self.accessor(skin.inverseBindMatrices).reshape(-1, 4, 4).transpose(0, 2, 1)
        moves = np.array([world[joint] @ back for joint, back in zip(skin.joints, bind, strict=True)])
        joints = self.accessor(primitive.attributes.JOINTS_0)  # type: ignore[attr-defined]
        shares = self.accessor(primitive.attributes.WEIGHTS_0).astype(float)  # type: ignore[attr-defined]
        return np.einsum("nk,nkab->nab", shares, moves[joints])
