"""The examples of examples/live with a real server, as somebody would start them."""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import mien
from live_process import STILL, LiveProcess, live_process
from mien.cli import main

EXAMPLES = Path(__file__).parents[3] / "examples" / "live"


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveProcess]:
    folder = tmp_path_factory.mktemp("run")
    with live_process(folder, "--face", "toon:olav", "--idle", STILL, "--tcp-port", "0", "--osc-port", "0") as running:
        yield running


def run(server: LiveProcess, name: str, *arguments: str) -> list[str]:
    program = [sys.executable] if name.endswith(".py") else ["bash"]
    done = subprocess.run(
        [*program, str(EXAMPLES / name), *arguments],
        env=server.environment,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout.splitlines()


def test_every_example_is_short_and_says_how_to_start() -> None:
    for path in EXAMPLES.iterdir():
        text = path.read_text(encoding="utf-8")
        assert "mien live" in text
        assert len(text.splitlines()) <= 50
        assert (path.suffix == ".sh") == os.access(path, os.X_OK)


def test_a_robot_s_eyes_follow_an_object(server: LiveProcess) -> None:
    rows = [[float(word) for word in line.split() if word[-1].isdigit()] for line in run(server, "robot.py", "12")]
    objects, pupils = zip(*rows, strict=True)
    assert len(rows) == 12
    assert objects[-1] > objects[0]
    # To the face's own left is to the right as one sees the picture, where ToonFace has negative angles.
    assert pupils[-1] < pupils[0] - 5


def test_lines_from_a_shell_are_answered(server: LiveProcess) -> None:
    with mien.Client(server.link) as face:
        port = face.about()["ports"]["tcp"]
        answers = [json.loads(line) for line in run(server, "netcat.sh", str(port))]
        assert [answer["kind"] for answer in answers] == ["ok", "ok", "ok", "state"]
        assert set(answers[-1]["values"]) == {"ELU", "MB"}


@pytest.mark.timeout(60)
def test_an_assistant_falls_silent_when_it_is_interrupted(server: LiveProcess) -> None:
    with (
        mien.Client(server.link) as face,
        subprocess.Popen(
            [sys.executable, str(EXAMPLES / "assistant.py")],
            env=server.environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        ) as assistant,
    ):
        assert assistant.stdin is not None
        assert assistant.stdout is not None
        events = face.events()
        assistant.stdin.write("Why is the sky blue\n")
        assistant.stdin.flush()
        assert next(events)["event"] == "speech.started"
        assistant.stdin.write("Hi\n")
        assistant.stdin.close()
        assert assistant.stdout.read().splitlines() == ["broken off", "said"]


def test_an_experiment_can_be_replayed_to_the_loop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with live_process(
        tmp_path, "--no-voice", "--face", "toon:olav", "--rate", "100", "--idle", STILL, "--log", "trial.log"
    ) as running:
        trials = list(csv.DictReader(run(running, "experiment.py", "2", "0.3")))
    assert [trial["trial"] for trial in trials] == ["1", "2"]
    assert main(["replay", "trial.log", "-o", "trial.csv", "-q"]) == 0
    rows = [row[1:] for row in csv.reader(Path("trial.csv").read_text().splitlines())][1:]
    moved = next(number for number, row in enumerate(rows) if row != rows[0])
    assert moved == int(trials[0]["loop"])
    assert float(trials[0]["time_s"]) == pytest.approx(moved / 100)
