"""``mien live`` on the command line: its mistakes, its signals, its end."""

import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from live_process import live_process
from mien.cli.main import main


def refused(capsys, *options):
    """What is said where nothing is served."""
    status = main(["live", "--no-voice", "--port", "0", *options])
    out, error = capsys.readouterr()
    assert (status, out) == (2, "")
    assert "Traceback" not in error
    return error


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--face", "heda"], "head"),
        (["--host", "no-such-host.invalid"], "--host no-such-host.invalid"),
        (["--host", ""], "--host"),
        (["--host", "x" * 300], "--host"),
        (["--vmc-to", "127.0.0.1"], "HOST:PORT"),
        (["--vmc-to", "x" * 300 + ":39539"], "no such host"),
        (["--vmc-to", "127.0.0.1:39539", "--vmc-names", "vrm9"], "vrm1"),
        (["--token", "short"], "8 letters"),
        (["--allow", "*"], "--allow '*'"),
        (["--idle", "blinks"], "PART=N"),
        (["--idle", "winks=1"], "blinks"),
        (["--motions", "there-is-none.json"], "there-is-none.json"),
        (["--log", "no/such/folder.log"], "cannot be written"),
    ],
)
def test_mistakes_are_named(capsys, options, words):
    assert words in refused(capsys, *options)


def test_a_port_that_is_taken_is_named_and_leaves_no_log(capsys, tmp_path):
    log = tmp_path / "talk.log"
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = str(taken.getsockname()[1])
        assert f"127.0.0.1:{port}" in refused(capsys, "--port", port, "--log", str(log))
        assert "--tcp-port" in refused(capsys, "--tcp-port", port, "--log", str(log))
    assert not log.exists()


def test_motions_that_are_none_are_named(capsys, tmp_path):
    broken = tmp_path / "mine.json"
    broken.write_text('{"smirk": ')
    assert "mine.json" in refused(capsys, "--motions", str(broken))


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_it_and_leaves_a_whole_log_and_no_runtime_file(tmp_path, number):
    log = tmp_path / "talk.log"
    with live_process(tmp_path, "--no-voice", "--log", str(log)) as live:
        files = list((tmp_path / "mien").glob("live-*.json"))
        assert len(files) == 1
        for _ in range(2):
            live.process.send_signal(number)
        live.process.wait(20)
    assert not files[0].exists()
    assert '"loops"' in log.read_text().splitlines()[-1]


def test_a_signal_while_the_voice_wakes_ends_it_and_the_voice(tmp_path):
    log = tmp_path / "talk.log"
    environment = {**os.environ, "XDG_RUNTIME_DIR": str(tmp_path)}
    command = [sys.executable, "-m", "mien", "live", "--port", "0", "--log", str(log)]
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as live:
        workers = Path(f"/proc/{live.pid}/task/{live.pid}/children")
        if not workers.exists():
            live.kill()
            pytest.skip("this system does not tell which processes a process has started")
        while not (worker := workers.read_text().split()):
            assert live.poll() is None
            time.sleep(0.005)
        live.send_signal(signal.SIGINT)
        out, error = live.communicate(timeout=20)
    assert (live.returncode, out) == (130, "")
    assert "interrupted" in error
    assert "Traceback" not in error
    assert not Path("/proc", worker[0]).exists()
    assert not log.exists()


def test_nobody_reads_the_link(tmp_path):
    environment = {**os.environ, "XDG_RUNTIME_DIR": str(tmp_path)}
    command = [sys.executable, "-m", "mien", "live", "--port", "0", "--no-voice"]
    read, write = os.pipe()
    os.close(read)
    with subprocess.Popen(command, env=environment, stdout=write, stderr=subprocess.PIPE, text=True) as live:
        os.close(write)
        _, error = live.communicate(timeout=30)
    assert live.returncode == 0
    assert "Traceback" not in error
    assert not list((tmp_path / "mien").glob("live-*.json"))
