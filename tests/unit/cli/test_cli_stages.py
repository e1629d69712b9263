"""What a person sees while work goes on."""

from __future__ import annotations

import pytest

from mien.cli import stages
from mien.cli.stages import Stages, format_time


def test_times_as_people_say_them() -> None:
    times = {0.04: "0.0 s", 2.34: "2.3 s", 8.4: "8 s", 59.4: "59 s", 200: "3 min 20 s", 3900: "1 h 5 min"}
    assert {length: format_time(length) for length in times} == times


def test_without_a_terminal_there_is_a_line_now_and_then(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    clock = iter(range(0, 1000, 4))
    monkeypatch.setattr(stages.time, "perf_counter", lambda: float(next(clock)))
    with Stages().progress("drawing") as report:
        for number in range(1, 11):
            report(number, 10)
    lines = capfd.readouterr().err.splitlines()
    assert lines[0] == "drawing: 3 of 10, 28 s left"
    assert lines[-1].startswith("drawing: ")
    assert 2 < len(lines) < 6


def test_on_a_terminal_there_is_a_bar(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    with Stages().progress("drawing") as report:
        report(5, 10)
    assert "drawing:" in capsys.readouterr().err


def test_quiet_says_nothing(capfd: pytest.CaptureFixture[str]) -> None:
    quiet = Stages(quiet=True)
    quiet.say("hello")
    with quiet.stage("speaking"), quiet.progress("drawing") as report:
        report(1, 2)
    assert capfd.readouterr().err == ""
