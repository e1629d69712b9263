"""Logs of live faces in files, on disks that are full too."""

import resource

import pytest

from mien.cli.session_log import session_log
from mien.core import MienError


def write(path, said, *, loops=3, limit=None):
    """A log of some loops with one line each, where a file may have so many bytes."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    try:
        if limit is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, before[1]))
        with session_log(path, said.append) as log:
            log.write("header")
            for loop in range(loops):
                log.write(f"loop {loop}")
                log.flush()
            log.write("end")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_lines_are_in_the_file_after_every_loop(tmp_path):
    path = tmp_path / "a.log"
    with session_log(path, print) as log:
        for line in ("header", "é"):
            log.write(line)
        log.flush()
        assert path.read_text(encoding="utf-8") == "header\né\n"
        log.write("end")
    assert path.read_text(encoding="utf-8").endswith("\nend\n")


def test_a_session_that_never_ran_leaves_no_file(tmp_path):
    path = tmp_path / "a.log"
    with session_log(path, print) as log:
        log.write("header")
        log.write("end")
    assert not path.exists()


def test_a_full_disk_ends_the_log_behind_a_whole_line_and_nothing_else(tmp_path):
    path, said = tmp_path / "a.log", []
    write(path, said, loops=50, limit=100)
    assert (
        path.read_text()
        == "header\n" + "".join(f"loop {loop}\n" for loop in range(12))[: 100 - 7].rpartition("\n")[0] + "\n"
    )
    assert len(said) == 1
    assert "the log ends here" in said[0]
    assert str(path) in said[0]


def test_nothing_is_replaced_and_folders_must_be_there(tmp_path):
    path = tmp_path / "a.log"
    write(path, [])
    before = path.read_bytes()
    with pytest.raises(MienError, match="is there already"), session_log(path, print):
        pass
    assert path.read_bytes() == before
    with pytest.raises(MienError, match="cannot be written"), session_log(tmp_path / "no" / "a.log", print):
        pass
