"""Loops as bytes for a page that draws them: a setup once, then small frames (docs/frames.md).

Every frame stands for itself beside its setup: a viewer may miss any of them. One encoded frame serves all viewers.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mien.core import Drawing, Face, Mesh, MienError, Pose, Scene
from mien.core.scene import fill_rows

from .drawing_frames import DrawingFrames
from .mesh_frames import MeshFrames
from .session import Frame
from .wire import FRAME, HEADER, SETUP, VERSION

NUMBERS = 1 << 16
"""Setups have numbers below this, and begin at 0 again."""


class Shapes(Protocol):
    """How the shapes of one face become bytes."""

    def describe(self) -> dict[str, Any]:
        """What a viewer must know once, as JSON."""

    def arrays(self) -> Mapping[str, NDArray[Any]]:
        """The same, what is numbers."""

    def encode(self, shape: Any) -> bytes | None:
        """A frame without its header; None where a shape needs, or deserves, a setup of its own."""


class FrameEncoder:
    """Makes the messages of one face, seen in one scene, for all its viewers.

    Args:
        face: which.
        scene: camera, lights and background; its size is the viewer's own affair.
        rate: loops a second.
        subdivide: Catmull-Clark steps that the viewer does, 0..2.

    Attributes:
        number: of the setup; grows when it changes.
        setup: the message to send before any frame of that number.

    Raises:
        MienError: pages draw no wires.
    """

    def __init__(self, face: Face, scene: Scene, rate: Fraction, *, subdivide: int = 2) -> None:
        if scene.shading == "wire":
            raise MienError("shading 'wire' cannot be shown live — take smooth or polygon")
        self._face = face if subdivide else face.unsubdivided
        self._scene, self._rate = replace(scene, subdivide=subdivide), rate
        self.number, self.setup = 0, b""
        self._begin(self._shape(face.neutral))

    def encode(self, frame: Frame) -> bytes:
        """The message of a frame; ``number`` may have grown, then ``setup`` goes before it.

        Raises:
            MienError: the face has a point or a colour that is not a finite number.
        """
        shape = self._shape(frame.pose)
        body = self._shapes.encode(shape)
        if body is None:
            self._begin(shape)
            body = self._shapes.encode(shape) or b""
        return self._header(FRAME, frame.loop) + body

    def _shape(self, pose: Pose) -> Mesh | Drawing:
        return self._face.shape(fill_rows(self._face, pose, self._scene))

    def _begin(self, shape: Mesh | Drawing) -> None:
        self._shapes: Shapes = MeshFrames(shape, self._scene) if isinstance(shape, Mesh) else DrawingFrames(self._scene)
        self.number = (self.number + 1) % NUMBERS
        facts = {"face": self._face.name, "rate": float(self._rate), **self._shapes.describe()}
        self.setup = self._header(SETUP, 0) + pack_arrays(facts, self._shapes.arrays())

    def _header(self, kind: int, loop: int) -> bytes:
        return HEADER.pack(kind, VERSION, self.number, loop, float(loop / self._rate))


def pack_arrays(facts: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """What follows the header of a setup: length of the JSON, the JSON, the arrays, each on a multiple of 8 bytes.

    Offsets count from the start of the message.
    """
    rows: list[dict[str, Any]] = []
    # The offsets decide how long the JSON is, and it decides the offsets: they are made after it, in a fixed width.
    sizes = np.cumsum([0, *(_padded(array.nbytes) for array in arrays.values())]).tolist()
    rows = [
        {"name": name, "dtype": array.dtype.name, "shape": list(array.shape), "offset": size}
        for (name, array), size in zip(arrays.items(), sizes[:-1], strict=True)
    ]
    start = HEADER.size + 4
    length = _padded(start + len(_json(facts, rows)) + 10 * len(rows)) - start
    for row in rows:
        row["offset"] += start + length
    text = _json(facts, rows).ljust(length)
    blocks: Sequence[bytes] = [
        array.astype(array.dtype.newbyteorder("<"), copy=False).tobytes().ljust(_padded(array.nbytes), b"\0")
        for array in arrays.values()
    ]
    return struct.pack("<I", length) + text + b"".join(blocks)


def _json(facts: Mapping[str, Any], rows: list[dict[str, Any]]) -> bytes:
    return json.dumps({**facts, "arrays": rows}, allow_nan=False, separators=(",", ":")).encode()


def _padded(size: int) -> int:
    return -(-size // 8) * 8
