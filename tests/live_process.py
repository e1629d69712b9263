"""``mien live`` in a process of its own, for tests: on ports that are free, with a runtime folder of its own."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

STILL = "blinks=0,saccades=0,breathing=0,sway=0"


@dataclass(frozen=True)
class LiveProcess:
    """A server that runs: its link, the environment in which clients find it by themselves, its process."""

    link: str
    environment: dict[str, str]
    process: subprocess.Popen[str]


@contextmanager
def live_process(folder: Path, *options: str) -> Iterator[LiveProcess]:
    environment = {name: value for name, value in os.environ.items() if name != "MIEN_LINK"}
    environment |= {"XDG_RUNTIME_DIR": str(folder), "XDG_CACHE_HOME": str(folder)}
    command = [sys.executable, "-m", "mien", "live", "--port", "0", "--quiet", *options]
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            link = process.stdout.readline().strip()
            assert link.startswith("http://")
            yield LiveProcess(link, environment, process)
        finally:
            process.send_signal(signal.SIGINT)
            assert process.wait(20) in (0, -signal.SIGKILL)
