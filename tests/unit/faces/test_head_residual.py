"""Files of points of a person's own: what is no such file is told in one line."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from mien.core import LoadError
from mien.faces import load_face


def face_beside(folder: Path) -> str:
    """The address of a face file whose residual is ``a.npz`` beside it."""
    path = folder / "a.face.json"
    path.write_text(json.dumps({"format": "mien-face", "version": 1, "residual": "a.npz"}))
    return str(path)


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04junk", b"junk", b"\x93NUMPY"], ids=repr)
def test_a_damaged_file_is_told(content: bytes, tmp_path: Path) -> None:
    (tmp_path / "a.npz").write_bytes(content)
    with pytest.raises(LoadError, match=r"a\.npz: not a file of arrays"):
        load_face(face_beside(tmp_path))


def test_a_zip_whose_bytes_are_damaged_is_told(tmp_path: Path) -> None:
    np.savez_compressed(tmp_path / "a.npz", cage=np.arange(300.0))
    content = bytearray((tmp_path / "a.npz").read_bytes())
    content[60:90] = bytes(30)
    (tmp_path / "a.npz").write_bytes(bytes(content))
    with pytest.raises(LoadError, match=r"a\.npz: not a file of arrays"):
        load_face(face_beside(tmp_path))


def test_arrays_that_are_missing_or_of_another_shape_are_told(tmp_path: Path) -> None:
    np.savez(tmp_path / "a.npz", cage=np.zeros((4, 3)))
    with pytest.raises(LoadError, match=r"array 'cage': want finite numbers of shape \(\d+, 3\), got \(4, 3\)"):
        load_face(face_beside(tmp_path))
    np.save(tmp_path / "b.npy", np.zeros(3))
    (tmp_path / "b.npy").rename(tmp_path / "a.npz")
    with pytest.raises(LoadError, match=r"a\.npz: not a file of arrays"):
        load_face(face_beside(tmp_path))


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(LoadError, match=r"a\.npz: cannot be read: No such file"):
        load_face(face_beside(tmp_path))
