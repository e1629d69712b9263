"""What ``mien doctor`` finds, well and not well."""

from __future__ import annotations

import json
import os
import re
import socket
import tempfile
import tomllib
from contextlib import closing
from pathlib import Path

import pytest

from fake_live import fake_server
from mien.cli import main
from mien.cli.checks import NOTE, OK, PACKAGES, PROBLEM, PYTHON, check_faces, check_folders, check_packages
from mien.cli.checks import check_servers as look_for_servers
from mien.compiling import folders
from mien.live.link import DEFAULT_PORT
from mien.live.serving.runtime import Running, announce

PROJECT = tomllib.loads((Path(__file__).parents[3] / "pyproject.toml").read_text())["project"]
ABOUT = {
    "rate_hz": 60.0,
    "clients": [{"frames": True}, {"frames": False}],
    "loops": {"run": 1000, "late": 2, "dropped": 0, "worst_ms": 20.0},
}


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    return {"XDG_RUNTIME_DIR": str(tmp_path)}


def servers(environment: dict[str, str]) -> dict[str, tuple[str, str, str]]:
    return {line.about: (line.status, line.text, line.advice) for line in look_for_servers(environment)}


def test_says_that_all_is_well(capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("XDG_RUNTIME_DIR", raising=False)
    assert main(["doctor"]) == 0
    out, err = capfd.readouterr()
    assert err == ""
    for words in ("Versions\n", "numpy", "faces ", "compiled code", "usual port", "all is well"):
        assert words in out
    assert main(["doctor", "--json"]) == 0
    found = json.loads(capfd.readouterr().out)
    assert found["ok"] is True
    assert [line["about"] for line in found["checks"]["Versions"]] == ["python", "mien", *PACKAGES]


def test_looks_at_all_that_mien_depends_on() -> None:
    wanted = {re.match(r"[\w-]+", each).group() for each in PROJECT["dependencies"]}  # type: ignore[union-attr]
    assert wanted == set(PACKAGES)
    low, high = (".".join(map(str, pair)) for pair in PYTHON)
    assert PROJECT["requires-python"] == f">={low},<{high}"


def test_a_package_that_is_broken_is_a_problem(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def load(name: str) -> None:
        if name == "av":
            raise ImportError("libavcodec.so.61: cannot open shared object file")

    lines = {line.about: line for line in check_packages(load)}
    assert {line.about for line in lines.values() if line.status != OK} == {"av"}
    assert "cannot be used: libavcodec.so.61" in lines["av"].text
    assert lines["av"].advice == "pip install --force-reinstall av"

    monkeypatch.setattr("mien.cli.checks.PACKAGES", {"no-such-package": ""})
    assert main(["doctor"]) == 2
    out = capfd.readouterr().out
    assert re.search(r"problem +no-such-package +is not installed\n +-> pip install", out)
    assert out.endswith("1 problem: mien cannot be used like this\n")


def test_faces_that_cannot_be_loaded_are_a_problem(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail() -> None:
        raise OSError("the file is gone")

    monkeypatch.setattr("mien.api.load_face", fail)
    monkeypatch.setattr("mien.api.voices", fail)
    assert [(line.about, line.status) for line in check_faces()] == [("faces", PROBLEM), ("voices", NOTE)]


def test_folders_that_cannot_be_written_to(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "a.objects").write_bytes(bytes(2_000_000))
    assert "1 files, 2.0 MB" in next(iter(check_folders(lambda: tmp_path))).text
    (tmp_path / "a.objects").unlink()
    assert "mien warmup" in next(iter(check_folders(lambda: tmp_path))).advice
    monkeypatch.setattr(folders, "can_write", lambda folder: False)
    compiled, temporary = check_folders(lambda: Path(tempfile.gettempdir()) / "mien-compiled-x")
    assert (compiled.status, temporary.status) == (NOTE, PROBLEM)


def test_servers_that_run(environment: dict[str, str]) -> None:
    assert servers(environment)["live faces"][:2] == (OK, "none runs")
    with fake_server() as fake:
        running = Running(fake.link, {"page": 1, "tcp": 7000}, "head", "0.1.0", "2026-11-22 16:00")
        with announce(running, environment):
            fake.about = ABOUT
            status, text, _ = servers(environment)["head, live"]
            assert status == OK
            assert text == (
                f"http://{running.address.place}, tcp port 7000, process {os.getpid()}; "
                "60 loops/s, 1 watching, 2 connected"
            )
            fake.about = {**ABOUT, "loops": {"run": 1000, "late": 20, "dropped": 5}}
            status, text, advice = servers(environment)["head, live"]
            assert (status, advice) == (NOTE, "--rate 30 takes half as much")
            assert "25 of 1000 loops came late" in text
            fake.about = ["another thing"]
            assert "is of another version" in servers(environment)["head, live"][1]
        link = fake.link.replace("token=", "token=wrong-")
        with announce(Running(link, {"page": 1}, "head", "0.1.0", ""), environment):
            status, text, advice = servers(environment)["head, live"]
            assert status == NOTE
            assert "refuses this client" in text
            assert "wrong-" not in text
            assert f"kill {os.getpid()}" in advice


def test_the_usual_port(environment: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> None:
    with closing(socket.create_server(("127.0.0.1", 0))) as other:
        port = other.getsockname()[1]
        monkeypatch.setattr("mien.live.link.DEFAULT_PORT", port)
        assert servers(environment)["usual port"] == (NOTE, f"{port} is taken by another program", "mien live --port 0")
        link = f"http://127.0.0.1:{port}/?token=secret-token"
        with announce(Running(link, {"page": port}, "head", "0.1.0", ""), environment):
            monkeypatch.setattr("mien.cli.checks.ANSWER_S", 0.1)
            found = servers(environment)
            assert "is that of a live face" in found["usual port"][1]
            # It takes connections and answers nothing.
            assert "no live face answers (timed out)" in found["head, live"][1]
    assert servers(environment)["usual port"] == (OK, f"{port} is free", "")
    assert DEFAULT_PORT == 8765


def test_where_clients_cannot_find_a_server() -> None:
    assert [line for line in look_for_servers({}) if line.status == NOTE and "without a link" in line.text]
