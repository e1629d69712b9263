"""Which servers run on this machine: a small file for each, for its user's eyes only, in the runtime folder.

A file holds the link with the token, so folders have mode 0700 and files 0600, and only plain files of that kind, owned
by the user, are read. Files of servers that are gone are removed by whoever looks next.
"""

from __future__ import annotations

import json
import os
import re
import socket
import stat
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from mien.core import MienError
from mien.formats.atomic import writing
from mien.live.link import Link, parse_link

FORMAT = {"format": "mien-running", "format_version": 1}

NAMES = re.compile(r"live-[0-9]{1,10}-[0-9]{1,5}\.json")
"""What the files are called: process and port of the page."""

MOST_BYTES = 65_536
ANSWER_S = 0.5
"""A server on this machine takes a connection in this time, however busy it is: the system does it for it."""


@dataclass(frozen=True)
class Running:
    """A server that runs.

    Attributes:
        link: for a browser, with the token.
        ports: by what listens there: ``page``, ``tcp``, ``osc`` …
        face: its address or name.
        version: of mien.
        pid: number of the process.
        start: when it was started, as people write it.
        machine: name of the machine; folders may be shared by several.
    """

    link: str
    ports: Mapping[str, int]
    face: str
    version: str
    start: str
    pid: int = field(default_factory=os.getpid)
    machine: str = field(default_factory=socket.gethostname)

    @property
    def address(self) -> Link:
        """Its link in parts."""
        return parse_link(self.link)


def runtime_folders(environment: Mapping[str, str]) -> tuple[Path, ...]:
    """Where files of running servers may lie, the usual place first: the runtime folder, or mien's in the cache."""
    places = [Path(environment["XDG_RUNTIME_DIR"]) / "mien"] if environment.get("XDG_RUNTIME_DIR") else []
    home = environment.get("XDG_CACHE_HOME") or (environment.get("HOME") and environment["HOME"] + "/.cache")
    return (*places, Path(home) / "mien" / "live") if home else tuple(places)


@contextmanager
def announce(running: Running, environment: Mapping[str, str] = os.environ) -> Iterator[Path | None]:
    """The file that says so while the server runs; None where there can be none: clients need its link then."""
    path = next((path for folder in runtime_folders(environment) if (path := _write(running, folder))), None)
    try:
        yield path
    finally:
        if path is not None:
            path.unlink(missing_ok=True)


def running_servers(environment: Mapping[str, str] = os.environ) -> tuple[Running, ...]:
    """The servers of this user that run on this machine, in the order of their files; files of others are removed."""
    found = []
    for folder in runtime_folders(environment):
        if not _is_private(folder):
            continue
        for path in sorted(folder.iterdir()):
            running = _read(path) if NAMES.fullmatch(path.name) else None
            if running is None or running.machine != socket.gethostname():
                continue
            if _runs(running):
                found.append(running)
            else:
                with suppress(OSError):
                    path.unlink()
    return tuple(found)


def find_server(environment: Mapping[str, str] = os.environ) -> Running:
    """The one server that runs.

    Raises:
        MienError: there is none, or more than one.
    """
    found = running_servers(environment)
    if not found:
        raise MienError("no server of yours runs here — start one with 'mien live', or give the link that it printed")
    if len(found) > 1:
        each = "; ".join(f"{server.face} at {server.address.place} (process {server.pid})" for server in found)
        raise MienError(f"{len(found)} servers run here: {each} — give the link of the one that you mean")
    return found[0]


def _write(running: Running, folder: Path) -> Path | None:
    """The file of a server; None where the folder is not fit for it, or full."""
    path = folder / f"live-{running.pid}-{running.address.port}.json"
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if not _is_private(folder):
            return None
        with writing(path) as temporary:
            temporary.chmod(0o600)
            temporary.write_text(json.dumps({**FORMAT, **asdict(running)}, indent=1) + "\n", encoding="utf-8")
    except (OSError, MienError):
        return None
    return path


def _is_private(folder: Path) -> bool:
    """Whether it is a folder, no link, that is the user's alone."""
    try:
        return _is_ours(folder.lstat(), stat.S_ISDIR)
    except OSError:
        return False


def _is_ours(status: os.stat_result, kind: Any) -> bool:
    mine = not hasattr(os, "getuid") or (status.st_uid == os.getuid() and not stat.S_IMODE(status.st_mode) & 0o077)
    return bool(kind(status.st_mode)) and mine


def _read(path: Path) -> Running | None:
    """What a file says; None if it is not one of ours."""
    try:
        # A link is not followed, and a pipe is not waited for.
        handle = os.open(path, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0))
        with open(handle, "rb") as file:
            if not _is_ours(os.fstat(handle), stat.S_ISREG):
                return None
            value = json.loads(file.read(MOST_BYTES))
        if {name: value.pop(name) for name in FORMAT} != FORMAT:
            return None
        found = Running(**value)
        return found if isinstance(found.pid, int) and found.address and dict(found.ports) else None
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError, MienError):
        return None


def _runs(running: Running) -> bool:
    """Whether its process is there and something takes connections; one that is too busy to answer runs."""
    if os.name == "posix":
        try:
            os.kill(running.pid, 0)
        except (ProcessLookupError, OverflowError):
            return False
        except PermissionError:
            pass
    try:
        socket.create_connection((running.address.host, running.address.port), ANSWER_S).close()
    except ConnectionRefusedError:
        return False
    except OSError:
        return True
    return True
