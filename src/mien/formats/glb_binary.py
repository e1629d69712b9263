"""The container of a ``.glb`` file: one run of bytes, and the accessors that say what lies where in it.

Source: Khronos Group, glTF 2.0 Specification, sections 3.6 (binary data) and 4 (GLB).
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

Json = dict[str, Any]

ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963

COMPONENTS = {"<f4": 5126, "<u4": 5125, "<u2": 5123, "u1": 5121}
KINDS = {1: "SCALAR", 3: "VEC3", 4: "VEC4", 16: "MAT4"}

MOST_SHORT = 65535
"""Vertices that sixteen bits can number; the last number of all means something else."""


class Binary:
    """Collects arrays; arrays of one use lie one after the other in a view of their own.

    Attributes:
        accessors: what each array is, in the order in which they came.
    """

    def __init__(self) -> None:
        self.accessors: list[Json] = []
        self._views: list[Json] = []
        self._bytes: list[bytearray] = []
        self._view_of: dict[tuple[str, str, int], int] = {}
        self._zeros: dict[int, int] = {}

    def add_attribute(self, values: NDArray[Any], kind: str = "<f4", *, bounds: bool = False) -> int:
        """Number of the accessor of a vertex attribute (N, K)."""
        return self._add(values.astype(kind), "attributes", bounds)

    def add_triangles(self, triangles: NDArray[np.int64], vertex_count: int) -> int:
        """Number of the accessor of triangles (T, 3), which number vertices below ``vertex_count``."""
        return self._add(triangles.reshape(-1, 1).astype(_number_kind(vertex_count)), "triangles", False)

    def add_samples(self, values: NDArray[Any], *, bounds: bool = False) -> int:
        """Number of the accessor of plain numbers (N, K): matrices, times, what is animated."""
        return self._add(values.astype("<f4"), "samples", bounds)

    def add_sparse(self, values: NDArray[np.float64], kept: NDArray[np.bool_]) -> int:
        """Number of the accessor of vectors (N, 3) that are 0 but where they are ``kept`` (N,)."""
        count = len(values)
        rows = np.flatnonzero(kept)
        if not len(rows):
            return self._add_zeros(count)
        there = values[rows].astype("<f4")
        numbers = rows[:, None].astype(_number_kind(count))
        # The zeros between count too.
        ends = there if len(rows) == count else np.concatenate([there, np.zeros((1, 3), dtype="<f4")])
        accessor = self._accessor(there, count) | _bounds(ends)
        accessor["sparse"] = {
            "count": len(rows),
            "indices": {**self._place(numbers, "rows"), "componentType": COMPONENTS[_number_kind(count)]},
            "values": self._place(there, "moves"),
        }
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def to_glb(self, document: Mapping[str, Any]) -> bytes:
        """The file: a document of JSON, completed by what is known here, and the bytes."""
        whole = bytearray()
        views = []
        for view, content in zip(self._views, self._bytes, strict=True):
            views.append({"buffer": 0, "byteOffset": len(whole), "byteLength": len(content), **view})
            whole += content + bytes(-len(content) % 4)
        tables = {"accessors": self.accessors, "bufferViews": views, "buffers": [{"byteLength": len(whole)}]}
        text = json.dumps({**document, **tables}, separators=(",", ":"), ensure_ascii=False, allow_nan=False).encode()
        text += b" " * (-len(text) % 4)
        size = 12 + 8 + len(text) + 8 + len(whole)
        head = struct.pack("<4sII", b"glTF", 2, size)
        return b"".join(
            [head, struct.pack("<I4s", len(text), b"JSON"), text, struct.pack("<I4s", len(whole), b"BIN\0"), whole]
        )

    def _add(self, values: NDArray[Any], use: str, bounds: bool) -> int:
        self.accessors.append(
            {**self._place(values, use), **self._accessor(values, len(values)), **(_bounds(values) if bounds else {})}
        )
        return len(self.accessors) - 1

    def _add_zeros(self, count: int) -> int:
        if count not in self._zeros:
            nothing = np.zeros((1, 3), dtype="<f4")
            self.accessors.append(self._accessor(nothing, count) | _bounds(nothing))
            self._zeros[count] = len(self.accessors) - 1
        return self._zeros[count]

    def _accessor(self, values: NDArray[Any], count: int) -> Json:
        return {"componentType": COMPONENTS[_kind(values)], "count": count, "type": KINDS[values.shape[1]]}

    def _place(self, values: NDArray[Any], use: str) -> Json:
        """Where the bytes of an array lie, after they have been put there."""
        width = values.shape[1] * values.itemsize
        key = (use, _kind(values), width)
        if key not in self._view_of:
            self._view_of[key] = len(self._views)
            self._views.append(_view(use, width))
            self._bytes.append(bytearray())
        number = self._view_of[key]
        content = self._bytes[number]
        offset = len(content)
        content += np.ascontiguousarray(values).tobytes()
        content += bytes(-len(content) % 4)
        return {"bufferView": number, "byteOffset": offset}


def _view(use: str, width: int) -> Json:
    if use == "attributes":
        return {"byteStride": width, "target": ARRAY_BUFFER}
    return {"target": ELEMENT_ARRAY_BUFFER} if use == "triangles" else {}


def _kind(values: NDArray[Any]) -> str:
    return values.dtype.str.lstrip("|")


def _number_kind(count: int) -> str:
    return "<u2" if count <= MOST_SHORT else "<u4"


def _bounds(values: NDArray[Any]) -> Json:
    return {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
