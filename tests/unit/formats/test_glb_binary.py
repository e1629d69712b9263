"""The container of a .glb file, byte by byte."""

from __future__ import annotations

import json
import struct

import numpy as np
import pytest

from mien.formats.glb_binary import Binary


def open_up(content: bytes) -> tuple[dict, bytes]:
    """The JSON and the bytes of a file, after a look at its frame."""
    magic, version, size = struct.unpack_from("<4sII", content)
    assert (magic, version, size) == (b"glTF", 2, len(content))
    length, kind = struct.unpack_from("<I4s", content, 12)
    assert (kind, length % 4) == (b"JSON", 0)
    rest = 20 + length
    count, kind = struct.unpack_from("<I4s", content, rest)
    assert (kind, count % 4, rest + 8 + count) == (b"BIN\0", 0, len(content))
    return json.loads(content[20:rest]), content[rest + 8 :]


def test_arrays_of_one_use_share_a_view() -> None:
    binary = Binary()
    first = binary.add_attribute(np.array([[1.0, 2, 3], [4, 0, 6]]), bounds=True)
    second = binary.add_attribute(np.array([[7.0, 8, 9]]))
    document, data = open_up(binary.to_glb({"asset": {"version": "2.0"}}))
    assert document["accessors"][first] == {
        **{"bufferView": 0, "byteOffset": 0, "componentType": 5126, "count": 2, "type": "VEC3"},
        **{"min": [1, 0, 3], "max": [4, 2, 6]},
    }
    assert document["accessors"][second]["byteOffset"] == 24
    assert document["bufferViews"] == [
        {"buffer": 0, "byteOffset": 0, "byteLength": 36, "byteStride": 12, "target": 34962}
    ]
    assert document["buffers"] == [{"byteLength": 36}]
    assert np.frombuffer(data, "<f4").tolist() == [1, 2, 3, 4, 0, 6, 7, 8, 9]


def test_arrays_begin_at_multiples_of_four() -> None:
    binary = Binary()
    binary.add_triangles(np.array([[0, 1, 2]]), 3)
    binary.add_triangles(np.array([[2, 1, 0]]), 3)
    binary.add_samples(np.array([[0.5]]), bounds=True)
    document, data = open_up(binary.to_glb({}))
    assert [a["byteOffset"] for a in document["accessors"]] == [0, 8, 0]
    assert [v["byteOffset"] for v in document["bufferViews"]] == [0, 16]
    assert data[:16] == struct.pack("<3H2x3H2x", 0, 1, 2, 2, 1, 0)
    assert document["bufferViews"][0] == {"buffer": 0, "byteOffset": 0, "byteLength": 16, "target": 34963}


@pytest.mark.parametrize(("count", "kind"), [(65535, 5123), (65536, 5125)])
def test_many_vertices_want_longer_numbers(count: int, kind: int) -> None:
    binary = Binary()
    assert binary.accessors[binary.add_triangles(np.array([[0, 1, count - 1]]), count)]["componentType"] == kind


def test_moves_of_few_vertices_are_sparse() -> None:
    binary = Binary()
    moves = np.array([[9.0, 9, 9], [0, -1, 2], [0, 0, 0], [3, 1, 5]])
    binary.add_sparse(moves, np.array([False, True, False, True]))
    document, data = open_up(binary.to_glb({}))
    (accessor,) = document["accessors"]
    assert accessor == {
        **{"componentType": 5126, "count": 4, "type": "VEC3", "min": [0, -1, 0], "max": [3, 1, 5]},
        "sparse": {
            "count": 2,
            "indices": {"bufferView": 0, "byteOffset": 0, "componentType": 5123},
            "values": {"bufferView": 1, "byteOffset": 0},
        },
    }
    assert data == struct.pack("<2H6f", 1, 3, 0, -1, 2, 3, 1, 5)


def test_bounds_of_moves_of_all_vertices_need_no_zero() -> None:
    binary = Binary()
    binary.add_sparse(np.array([[1.0, 2, 3], [2, 3, 4]]), np.array([True, True]))
    assert (binary.accessors[0]["min"], binary.accessors[0]["max"]) == ([1, 2, 3], [2, 3, 4])


def test_targets_that_move_nothing_share_an_accessor_without_bytes() -> None:
    binary = Binary()
    nothing = np.zeros((5, 3)), np.zeros(5, dtype=bool)
    assert binary.add_sparse(*nothing) == binary.add_sparse(*nothing) == 0
    document, data = open_up(binary.to_glb({}))
    assert document["accessors"] == [
        {"componentType": 5126, "count": 5, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]}
    ]
    assert data == b""


def test_texts_of_any_script_are_kept() -> None:
    document, _ = open_up(Binary().to_glb({"asset": {"extras": {"Title": "Grüß Gott, 世界"}}}))
    assert document["asset"]["extras"]["Title"] == "Grüß Gott, 世界"
