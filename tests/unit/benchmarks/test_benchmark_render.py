"""The benchmark of drawing runs, says what it left out, and leaves no process behind."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

BENCHMARKS = Path(__file__).parents[3] / "benchmarks"


@pytest.fixture
def worker(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    from workers import Worker

    return Worker


def test_a_quick_run_without_peers_prints_the_table(tmp_path):
    command = [sys.executable, BENCHMARKS / "render.py", "--quick", "--no-peers", "--pictures", tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    rows = [line.split("|")[1:-1] for line in done.stdout.splitlines() if line.startswith("| mien")]
    assert [row[1].strip() for row in rows] == ["1", "1", "4", "4"]
    assert all(float(row[2]) > 0.0 and row[6].strip().endswith("%") for row in rows)
    assert "NOT ALIKE" not in done.stdout
    assert re.search(r"ours, one thread, 1 sample, is \d+\.\d\d times the floor", done.stdout)
    assert len(list(tmp_path.glob("*.png"))) == 5


def test_a_renderer_that_is_not_there_is_left_out_with_the_reason(worker):
    from workers import WorkerEndedError

    with worker(Path(sys.executable), "with_nothing", 1, 1) as absent, pytest.raises(WorkerEndedError) as caught:
        absent.start()
    assert "No module named 'peers.with_nothing'" in str(caught.value)


def test_a_worker_outlives_nobody_and_ignores_ctrl_c(worker):
    with worker(Path(sys.executable), "with_mien", 1, 1) as started:
        assert started.start().startswith("mien ")
        number = started._process.pid
        os.kill(number, signal.SIGINT)
        assert started.ask("nothing") == {}
        started._process.stdin.close()
        assert started._process.wait(timeout=20) == 0


def test_ctrl_c_ends_the_run_and_its_workers():
    command = [sys.executable, BENCHMARKS / "render.py", "--no-peers", "--rounds", "10000"]
    run = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # Who starts the tests in the background has Ctrl-C ignored, which programs inherit.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    try:
        while "memory floor" not in run.stdout.readline():
            assert run.poll() is None
        children = Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()
        assert len(children) == 5
        time.sleep(0.5)
        run.send_signal(signal.SIGINT)
        run.communicate(timeout=20)
    finally:
        run.kill()
    assert run.returncode != 0
    assert [number for number in children if Path(f"/proc/{number}").exists()] == []


@pytest.mark.parametrize(("size", "vertices"), [(800, 402), (5_000, 2_502), (50_000, 25_002)])
def test_the_form_is_closed_and_turns_its_outside_outwards(monkeypatch, size, vertices):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    from headlike import make_form

    form = make_form(size)
    assert form.triangles.shape == (size, 3)
    assert form.points.shape == (24, vertices, 3)
    edges = [(a, b) for t in form.triangles.tolist() for a, b in zip(t, t[1:] + t[:1], strict=True)]
    assert len(set(edges)) == len(edges) == 3 * size
    assert {(b, a) for a, b in edges} == set(edges)
    a, b, c = (form.points[0][form.triangles[:, k]].astype(float) for k in range(3))
    volume = (a * np.cross(b, c)).sum() / 6.0
    assert 0.003 < volume < 0.006
    assert abs((form.normals**2).sum(axis=2) - 1.0).max() < 1e-5
    assert (form.points[0] != form.points[1]).any()


def test_the_steps_of_a_start_are_timed():
    done = subprocess.run([sys.executable, BENCHMARKS / "first_steps.py"], capture_output=True, text=True, check=True)
    rows = [line.split("|")[1:-1] for line in done.stdout.splitlines() if line.startswith("| ")][1:]
    assert len(rows) >= 12
    assert all(float(wall) >= 0.0 and float(work) >= 0.0 for _, wall, work in rows)
