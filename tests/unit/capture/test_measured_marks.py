"""``marks.csv``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mien.capture.marks import Marks, format_marks, plain_marks, read_marks
from mien.core import LoadError

HEAD = "number,name,body,follows,touches,x,y,z\n"
MARKS = Marks(
    ("chin", "tooth"),
    ("", "teeth"),
    ((), ("chin",)),
    np.array([[0.0, -0.1, 0.09], [0.004, -0.06, 0.08]]),
    ((), (("open", "chin"),)),
)


def written(folder: Path, text: str) -> Path:
    (folder / "marks.csv").write_text(text, encoding="utf-8")
    return folder / "marks.csv"


def test_marks_are_read_as_they_were_written(tmp_path):
    read = read_marks(written(tmp_path, format_marks(MARKS, "mm")), 2, "mm")
    assert (read.names, read.bodies, read.follows) == (MARKS.names, MARKS.bodies, MARKS.follows)
    assert read.touches == MARKS.touches
    np.testing.assert_allclose(read.model, MARKS.model, atol=1e-9)


def test_places_may_be_left_out(tmp_path):
    assert read_marks(written(tmp_path, HEAD + "2,b,,,,,,\n1,a,,b,,,,\n"), 2, "mm").model is None


def test_points_without_marks_are_called_by_their_numbers():
    assert plain_marks(3).names == ("1", "2", "3")


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ("1,a,,,,,,\n", r"marks\.csv: point 2 is missing"),
        ("1,a,,,,,,\n3,c,,,,,,\n", r"marks\.csv:3: point '3' is not in 1\.\.2"),
        ("1,a,,,,,,\n1,b,,,,,,\n", r"marks\.csv:3: point 1 is there twice"),
        ("1,a,,,,,,\n2,a,,,,,,\n", r"marks\.csv:2: name 'a' is there twice"),
        ("1,a,,zz,,,,\n2,b,,,,,,\n", r"marks\.csv:2: follows 'zz', which is no point"),
        ("1,a,,,blink:q,,,\n2,b,,,,,,\n", r"marks\.csv:2: touches 'q', which is no point"),
        ("1,a,,,,1,2,x\n2,b,,,,,,\n", r"marks\.csv:2: want x, y and z as numbers"),
        ("1,a,,,,1,2,nan\n2,b,,,,,,\n", r"marks\.csv:2: want x, y and z as numbers"),
        ("1,,,,,,,\n2,b,,,,,,\n", r"marks\.csv:2: point 1 has no name"),
        ("1,a\n2,b,,,,,,\n", r"marks\.csv:2: want 8 fields"),
    ],
)
def test_wrong_marks_are_told_with_their_line(tmp_path, rows, message):
    with pytest.raises(LoadError, match=message):
        read_marks(written(tmp_path, HEAD + rows), 2, "mm")


def test_other_columns_are_no_marks(tmp_path):
    with pytest.raises(LoadError, match="want the columns number,name"):
        read_marks(written(tmp_path, "number,name\n1,a\n"), 1, "mm")
