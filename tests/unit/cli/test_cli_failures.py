"""Interrupted, out of room: the status says so, nothing half-written is left and what was there survives."""

from __future__ import annotations

import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

PLAY = [sys.executable, "-m", "mien", "play", "long.spec", "--size", "64", "--subdivide", "0", "--threads", "1"]
LONG = "word 0 9 Hello\nlength 20000\njaw.rotation 0 10 0 8 cosine\n"
SHORT = "length 12\njaw.rotation 0 10 0 8 cosine\n"


def wait_for_partial(folder: Path, process: subprocess.Popen[bytes], least_bytes: int) -> None:
    """Until a hidden output has grown, or the process has ended."""
    for _ in range(1200):
        parts = [path for path in folder.glob(".mien-*") if path.is_file()]
        files = [path for path in folder.glob(".mien-*/*") if path.is_file()]
        if sum(path.stat().st_size for path in parts + files) >= least_bytes or process.poll() is not None:
            return
        time.sleep(0.05)


@pytest.mark.parametrize(
    ("out", "old"), [("a.mp4", "a.mp4"), ("a.webm", "a.webm"), ("frames", "frames/frame_0000.png")]
)
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_interrupting_leaves_everything_as_it_was(tmp_path: Path, out: str, old: str, number: signal.Signals) -> None:
    (tmp_path / "long.spec").write_text(LONG)
    (tmp_path / old).parent.mkdir(exist_ok=True)
    (tmp_path / old).write_text("old")
    process = subprocess.Popen([*PLAY, "-o", out, "--subtitles", "a.srt"], cwd=tmp_path, stderr=subprocess.PIPE)
    try:
        wait_for_partial(tmp_path, process, 1)
        assert process.poll() is None
        process.send_signal(number)
        _, err = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 130
    assert b"interrupted" in err
    assert b"Traceback" not in err
    assert sorted(item.name for item in tmp_path.iterdir()) == sorted(["long.spec", out])
    assert (tmp_path / old).read_text() == "old"


@pytest.mark.parametrize("out", ["a.mp4", "a.gif", "a.webp", "frames", "f_%02d.png", "a.csv", "a.json"])
def test_a_full_disk_leaves_everything_as_it_was(tmp_path: Path, out: str) -> None:
    (tmp_path / "long.spec").write_text(SHORT)
    existing = {"frames": "frames/frame_0000.png", "f_%02d.png": "f_00.png"}.get(out, out)
    (tmp_path / existing).parent.mkdir(exist_ok=True)
    (tmp_path / existing).write_text("old")
    before = sorted(str(path) for path in tmp_path.rglob("*"))

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300))

    # Python's own compiled files would be cut off too.
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
    result = subprocess.run(
        [*PLAY, "-o", out], cwd=tmp_path, capture_output=True, preexec_fn=limit, env=environment, check=False
    )
    assert result.returncode == 2, result.stderr
    assert b"disk is full" in result.stderr
    assert b"Traceback" not in result.stderr
    assert sorted(str(path) for path in tmp_path.rglob("*")) == before
    assert (tmp_path / existing).read_text() == "old"
