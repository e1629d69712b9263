"""Outputs appear whole or not at all."""

from __future__ import annotations

import errno
import os
import re
from pathlib import Path

import pytest

from mien.core import MienError
from mien.formats.atomic import check_file, check_new_folder, writing, writing_folder, writing_series


def leftovers(folder: Path) -> list[str]:
    return sorted(item.name for item in folder.iterdir())


def test_a_file_takes_its_place_only_at_the_end(tmp_path: Path) -> None:
    target = tmp_path / "a.txt"
    target.write_text("old")
    with writing(target) as temporary:
        temporary.write_text("new")
        assert target.read_text() == "old"
        assert temporary.suffix == ".txt"
        assert temporary.name.startswith(".")
        assert temporary.parent == tmp_path
    assert target.read_text() == "new"
    assert leftovers(tmp_path) == ["a.txt"]


@pytest.mark.parametrize("failure", [KeyboardInterrupt, ValueError, SystemExit])
def test_an_existing_file_survives_every_failure(tmp_path: Path, failure: type[BaseException]) -> None:
    target = tmp_path / "a.txt"
    target.write_text("old")

    def write_half() -> None:
        with writing(target) as temporary:
            temporary.write_text("half")
            raise failure

    with pytest.raises(failure):
        write_half()
    assert target.read_text() == "old"
    assert leftovers(tmp_path) == ["a.txt"]


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EFBIG, errno.EDQUOT])
def test_a_full_disk_is_said_in_words(tmp_path: Path, code: int) -> None:
    with pytest.raises(MienError, match="disk is full"), writing(tmp_path / "a.txt"):
        raise OSError(code, os.strerror(code))
    assert leftovers(tmp_path) == []


def test_a_new_file_obeys_the_umask_like_any_other(tmp_path: Path) -> None:
    with writing(tmp_path / "a.txt"):
        pass
    (tmp_path / "b.txt").write_text("")
    assert (tmp_path / "a.txt").stat().st_mode == (tmp_path / "b.txt").stat().st_mode


def test_what_a_killed_process_left_is_not_in_the_way(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mien.formats.atomic._numbers", iter(range(1, 9)))
    (tmp_path / f".mien-{os.getpid()}-1.part.txt").write_text("half")
    with writing(tmp_path / "a.txt") as temporary:
        temporary.write_text("new")
    assert (tmp_path / "a.txt").read_text() == "new"


def test_a_link_is_followed(tmp_path: Path) -> None:
    real = tmp_path / "real.txt"
    real.write_text("old")
    (tmp_path / "link.txt").symlink_to(real)
    with writing(tmp_path / "link.txt") as temporary:
        temporary.write_text("new")
    assert real.read_text() == "new"
    assert (tmp_path / "link.txt").is_symlink()


def test_a_missing_folder_is_refused_with_the_command_that_makes_it(tmp_path: Path) -> None:
    with pytest.raises(MienError, match=r"does not exist — make it first: mkdir -p"):
        check_file(tmp_path / "nowhere" / "a.png")


def test_a_file_in_the_place_of_a_folder_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    for path in (tmp_path / "file" / "a.png", tmp_path / "file" / "deeper" / "a.png"):
        with pytest.raises(MienError, match="is a file, not a folder"):
            check_file(path)
    with pytest.raises(MienError, match="there is a file of that name"):
        check_new_folder(tmp_path / "file", [])


def test_a_folder_that_nobody_can_write_to_is_refused() -> None:
    with pytest.raises(MienError, match="cannot be written to"):
        check_file("/proc/a.png")


def test_a_folder_and_a_device_in_the_place_of_a_file_are_refused(tmp_path: Path) -> None:
    with pytest.raises(MienError, match="there is a folder of that name"):
        check_file(tmp_path)
    with pytest.raises(MienError, match="not a plain file"):
        check_file("/dev/null")


def test_an_endless_name_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MienError, match="shorter"):
        check_file(tmp_path / ("x" * 300 + ".png"))


def test_checking_leaves_nothing_behind(tmp_path: Path) -> None:
    check_file(tmp_path / "a.png")
    check_new_folder(tmp_path / "frames", [])
    assert leftovers(tmp_path) == []


def test_a_folder_is_swapped_in_whole(tmp_path: Path) -> None:
    target = tmp_path / "frames"
    for names in (["frame_1.png", "frame_2.png"], ["frame_1.png"]):
        with writing_folder(target, ["frame_*.png"]) as temporary:
            for name in names:
                (temporary / name).write_text("x")
        assert leftovers(target) == names

    def write_half() -> None:
        with writing_folder(target, ["frame_*.png"]) as temporary:
            (temporary / "frame_9.png").write_text("x")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_half()
    assert leftovers(target) == ["frame_1.png"]
    assert leftovers(tmp_path) == ["frames"]


def test_a_folder_with_other_things_in_it_is_never_replaced(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("years")
    with pytest.raises(MienError, match=re.escape("holds other things (thesis.txt)")):
        check_new_folder(tmp_path, ["frame_*.png"])
    with pytest.raises(MienError), writing_folder(tmp_path, ["frame_*.png"]):
        pass
    assert (tmp_path / "thesis.txt").read_text() == "years"


def test_the_folder_one_is_in_is_never_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for path in (Path(), tmp_path, tmp_path / "." / ".." / tmp_path.name):
        with pytest.raises(MienError, match="folder that you are in"):
            check_new_folder(path, ["frame_*.png"])


def test_a_series_replaces_an_older_longer_one_and_nothing_else(tmp_path: Path) -> None:
    for name in ("f_0000.png", "f_0001.png", "f_0002.png", "f_x.png", "other.png"):
        (tmp_path / name).write_text("old")
    with writing_series(tmp_path / "f_%d.png", re.compile(r"f_\d+\.png")) as temporary:
        (temporary / "f_0000.png").write_text("new")
        assert (tmp_path / "f_0000.png").read_text() == "old"
    assert leftovers(tmp_path) == ["f_0000.png", "f_x.png", "other.png"]
    assert (tmp_path / "f_0000.png").read_text() == "new"
