"""Standard streams that are closed, full, or whose reader has gone."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from mien.cli import main

MIEN = f"{sys.executable} -m mien"


def shell(line: str, folder: Path) -> subprocess.CompletedProcess[str]:
    command = ["bash", "-c", f"set -o pipefail; {line}"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("command", ["params head", "params head --json", "faces", "play a.spec --commands", "--help"])
def test_a_reader_who_has_had_enough_is_no_fault(command: str, tmp_path: Path) -> None:
    (tmp_path / "a.spec").write_text("jaw.rotation 0 9000 0 8 cosine\n")
    result = shell(f"{MIEN} {command} | true", tmp_path)
    assert (result.returncode, result.stderr) == (0, "")


def test_what_is_to_be_written_is_written_though_nobody_listens(tmp_path: Path) -> None:
    (tmp_path / "a.spec").write_text("jaw.rotation 0 9000 0 8 cosine\n")
    result = shell(f"{MIEN} play a.spec --commands -o a.csv 2>&1 | true", tmp_path)
    assert result.returncode == 0
    assert len((tmp_path / "a.csv").read_text().splitlines()) == 9002


@pytest.mark.parametrize("closed", ["<&-", ">&-", "2>&-", "<&- >&- 2>&-"])
def test_closed_streams_are_no_fault(closed: str, tmp_path: Path) -> None:
    (tmp_path / "a.spec").write_text("jaw.rotation 0 9 0 8 cosine\n")
    result = shell(f"{MIEN} play a.spec --commands -o a.csv {closed}", tmp_path)
    assert result.returncode == 0
    assert len((tmp_path / "a.csv").read_text().splitlines()) == 11
    assert shell(f"{MIEN} params head {closed}", tmp_path).returncode == 0
    mistake = shell(f"{MIEN} params nobody {closed}", tmp_path)
    assert (mistake.returncode, mistake.stdout) == (2, "")


def test_nothing_on_a_closed_standard_input_is_empty(tmp_path: Path) -> None:
    result = shell(f"{MIEN} say - -o a.wav <&-", tmp_path)
    assert result.returncode == 2
    assert "standard input is empty" in result.stderr


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a device that is always full")
def test_a_list_that_does_not_fit_is_told_with_its_place(tmp_path: Path) -> None:
    result = shell(f"{MIEN} params head > /dev/full", tmp_path)
    assert result.returncode == 2
    assert "standard output: the disk is full" in result.stderr
    assert len(result.stderr.splitlines()) == 1


def test_tables_have_no_blanks_at_the_ends_of_lines(capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["presets", "head"]) == 0
    assert [line for line in capfd.readouterr().out.splitlines() if line != line.rstrip()] == []


def test_a_narrow_terminal_still_shows_every_column(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.stdout.isatty", lambda: True, raising=False)
    monkeypatch.setenv("COLUMNS", "30")
    assert main(["params", "head"]) == 0
    out = capfd.readouterr().out
    assert "what it does" in out
    assert "eyebrow.separation.right" in out
    assert "Parke unit" in out


@pytest.mark.parametrize(("before", "status"), [("", 130), ("trap '' HUP; ", -signal.SIGKILL)])
def test_the_end_of_the_terminal_ends_it_tidily_unless_under_nohup(before: str, status: int, tmp_path: Path) -> None:
    (tmp_path / "a.spec").write_text("length 20000\njaw.rotation 0 10 0 8 cosine\n")
    command = f"{before}exec {MIEN} play a.spec --size 64 --subdivide 0 --threads 1 -o a.mp4"
    # A shell cannot undo what its parent ignores, and tests may themselves run under nohup.
    process = subprocess.Popen(
        ["bash", "-c", command],
        cwd=tmp_path,
        stderr=subprocess.DEVNULL,
        preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL),
    )
    try:
        for _ in range(1200):
            if any(tmp_path.glob(".mien-*")) or process.poll() is not None:
                break
            time.sleep(0.05)
        process.send_signal(signal.SIGHUP)
        if status < 0:
            with pytest.raises(subprocess.TimeoutExpired):
                process.wait(1.0)
            process.kill()
        assert process.wait(60) == status
    finally:
        process.kill()
        process.wait()
    if status > 0:
        assert [item.name for item in tmp_path.iterdir()] == ["a.spec"]
