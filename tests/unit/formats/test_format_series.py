"""Numbered frames in a folder or after a pattern."""

from __future__ import annotations

import errno
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mien.core import MienError, Sound
from mien.formats.series import check_series, write_series


def frames(count: int) -> list[np.ndarray]:
    return [np.full((4, 6, 4), (10 * number, 0, 0, 255), dtype=np.uint8) for number in range(count)]


def first_values(folder: Path) -> list[int]:
    out = []
    for path in sorted(folder.glob("*.png")):
        with Image.open(path) as image:
            out.append(image.getpixel((0, 0))[0])
    return out


def test_a_folder_of_frames_with_its_sound(tmp_path: Path) -> None:
    write_series(iter(frames(12)), tmp_path / "out", sound=Sound.silence(0.5))
    assert sorted(item.name for item in (tmp_path / "out").glob("*.png"))[:2] == ["frame_0000.png", "frame_0001.png"]
    assert first_values(tmp_path / "out") == [10 * number for number in range(12)]
    assert (tmp_path / "out" / "sound.wav").stat().st_size == 44 + 24000


def test_a_pattern_replaces_an_older_longer_series(tmp_path: Path) -> None:
    (tmp_path / "notes.png").write_text("mine")
    for count in (5, 2):
        write_series(iter(frames(count)), tmp_path / "f%03d.png")
    assert sorted(item.name for item in tmp_path.iterdir()) == ["f000.png", "f001.png", "notes.png"]


def test_a_failure_leaves_the_older_series(tmp_path: Path) -> None:
    write_series(iter(frames(3)), tmp_path / "out")

    def failing():
        yield frames(1)[0]
        raise KeyboardInterrupt

    for place in (tmp_path / "out", tmp_path / "out" / "frame_%04d.png"):
        with pytest.raises(KeyboardInterrupt):
            write_series(failing(), place)
        assert first_values(tmp_path / "out") == [0, 10, 20]
    assert [item.name for item in tmp_path.iterdir()] == ["out"]


@pytest.mark.parametrize("name", ["a.png", "%s.png", "%d_%d.png", "50%_%d.png", "%%d.png"])
def test_a_name_that_numbers_nothing_is_refused_with_one_that_does(tmp_path: Path, name: str) -> None:
    with pytest.raises(MienError, match=r"as in (\S*%04d\.png)") as caught:
        check_series(tmp_path / name)
    check_series(tmp_path / str(caught.value).split("as in ")[1].split(",")[0])


def test_standard_output_is_no_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(MienError, match="standard output"):
        check_series("-")


def test_a_full_disk_names_what_was_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(sound: Sound, path: Path) -> None:
        raise OSError(errno.ENOSPC, "No space left on device", str(path))

    monkeypatch.setattr("mien.formats.series.write_samples", full)
    with pytest.raises(MienError, match=r"/out: the disk is full"):
        write_series(frames(1), tmp_path / "out", sound=Sound(np.zeros(9, dtype=np.int16), 100))
    monkeypatch.setattr("mien.formats.series._write_frames", lambda *_: full(Sound(np.zeros(1, np.int16), 1), tmp_path))
    with pytest.raises(MienError, match=r"/f_%d\.png: the disk is full"):
        write_series(frames(1), tmp_path / "f_%d.png")
    assert list(tmp_path.iterdir()) == []
