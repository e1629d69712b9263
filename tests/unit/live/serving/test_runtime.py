"""Files that tell which servers run."""

from __future__ import annotations

import json
import os
import socket
import stat
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, closing
from pathlib import Path

import pytest

from mien import MienError
from mien.live.serving.runtime import Running, announce, find_server, running_servers, runtime_folders


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    return {"XDG_RUNTIME_DIR": str(tmp_path / "run"), "HOME": str(tmp_path / "home")}


@pytest.fixture
def port() -> Iterator[int]:
    """Where somebody listens."""
    with closing(socket.create_server(("127.0.0.1", 0))) as listening:
        yield listening.getsockname()[1]


def server(port: int, face: str = "head", **other: object) -> Running:
    link = f"http://127.0.0.1:{port}/?token=secret-token"
    return Running(link, {"page": port}, face, "0.1.0", "2026-11-22 16:00", **other)  # type: ignore[arg-type]


def refused_port() -> int:
    with closing(socket.create_server(("127.0.0.1", 0))) as listening:
        return int(listening.getsockname()[1])


def test_a_server_is_found_while_it_runs(environment: dict[str, str], port: int) -> None:
    with announce(server(port), environment) as path:
        assert path is not None
        assert path.parent == Path(environment["XDG_RUNTIME_DIR"]) / "mien"
        assert find_server(environment) == server(port)
        assert find_server(environment).address.token == "secret-token"
        assert stat.S_IMODE(path.stat().st_mode) == 0o600
        assert stat.S_IMODE(path.parent.stat().st_mode) == 0o700
        assert [entry.name for entry in path.parent.iterdir()] == [path.name]
    assert not path.exists()
    with pytest.raises(MienError, match="no server of yours runs here — start one with 'mien live'"):
        find_server(environment)


def test_without_a_runtime_folder_it_lies_in_the_cache(tmp_path: Path, port: int) -> None:
    home = tmp_path / "home"
    nowhere = tmp_path / "file"
    nowhere.write_text("")
    for environment in ({"HOME": str(home)}, {"HOME": str(home), "XDG_RUNTIME_DIR": str(nowhere)}):
        with announce(server(port), environment) as path:
            assert path is not None
            assert path.parent == home / ".cache" / "mien" / "live"
            # A client that has a runtime folder finds a server that had none.
            assert find_server({**environment, "XDG_RUNTIME_DIR": str(tmp_path)}).pid == os.getpid()


def test_where_there_is_no_folder_it_runs_without_a_file(port: int) -> None:
    assert runtime_folders({}) == ()
    with announce(server(port), {}) as path:
        assert path is None
    assert running_servers({}) == ()


def test_a_full_disk_does_not_keep_a_server_from_running(
    environment: dict[str, str], port: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(path: Path) -> None:
        raise MienError("the disk is full")

    monkeypatch.setattr("mien.live.serving.runtime.writing", full)
    with announce(server(port), environment) as path:
        assert path is None


def test_two_servers_are_both_named(environment: dict[str, str], port: int) -> None:
    with ExitStack() as stack:
        other = stack.enter_context(closing(socket.create_server(("127.0.0.1", 0)))).getsockname()[1]
        stack.enter_context(announce(server(port), environment))
        stack.enter_context(announce(server(other, "toon:gus"), environment))
        with pytest.raises(MienError) as caught:
            find_server(environment)
        for words in ("2 servers", f"head at 127.0.0.1:{port}", f"toon:gus at 127.0.0.1:{other}", "give the link"):
            assert words in str(caught.value)
        assert "secret-token" not in str(caught.value)


def test_files_of_servers_that_are_gone_are_removed(environment: dict[str, str], port: int) -> None:
    with subprocess.Popen([sys.executable, "-c", ""]) as process:
        process.wait()
    with (
        announce(server(port, pid=process.pid), environment) as gone,
        announce(server(refused_port()), environment) as silent,
    ):
        assert gone is not None
        assert silent is not None
        assert running_servers(environment) == ()
        assert not gone.exists()
        assert not silent.exists()


def test_another_machine_s_file_is_left_alone(environment: dict[str, str]) -> None:
    with announce(server(refused_port(), machine="elsewhere"), environment) as path:
        assert path is not None
        assert running_servers(environment) == ()
        assert path.exists()


def test_links_and_odd_files_are_not_read(environment: dict[str, str], port: int, tmp_path: Path) -> None:
    with announce(server(port), environment) as path:
        assert path is not None
        good = json.loads(path.read_text())
        folder = path.parent
    secret = tmp_path / "secret.json"
    secret.write_text(json.dumps(good))
    secret.chmod(0o600)
    (folder / "live-1-1.json").symlink_to(secret)
    os.mkfifo(folder / "live-2-2.json", 0o600)
    (folder / "live-3-3.json").mkdir()
    for number, text in enumerate(
        ["", "[" * 100_000, "[]", "{}", json.dumps({**good, "more": 1}), json.dumps({**good, "format_version": 2})]
        + [json.dumps({**good, **change}) for change in ({"link": "ftp://x"}, {"link": 3}, {"pid": "1"}, {"ports": 1})]
    ):
        odd = folder / f"live-4-{number}.json"
        odd.write_text(text)
        odd.chmod(0o600)
    loose = folder / "live-5-5.json"
    loose.write_text(json.dumps(good))
    loose.chmod(0o644)
    (folder / "notes.json").write_text(json.dumps(good))
    names = sorted(entry.name for entry in folder.iterdir())
    assert running_servers(environment) == ()
    assert sorted(entry.name for entry in folder.iterdir()) == names
    loose.chmod(0o600)
    assert len(running_servers(environment)) == 1


def test_a_folder_that_others_can_read_is_not_used(environment: dict[str, str], port: int, tmp_path: Path) -> None:
    folder = Path(environment["XDG_RUNTIME_DIR"]) / "mien"
    folder.mkdir(parents=True)
    folder.chmod(0o755)
    with announce(server(port), environment) as path:
        assert path is not None
        assert folder not in path.parents
        assert find_server(environment)
    folder.rmdir()
    (tmp_path / "elsewhere").mkdir(mode=0o700)
    folder.symlink_to(tmp_path / "elsewhere")
    with announce(server(port), environment) as path:
        assert path is not None
        assert folder not in path.parents
