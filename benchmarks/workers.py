"""Renderers in processes of their own that draw on command, so that all of them can be measured in turn."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import tempfile
import threading
from pathlib import Path
from types import TracebackType
from typing import Any

FOLDER = Path(__file__).parent

LIMIT_S = 300.0
"""How long a renderer may take for one command; compiling is the longest of them."""

SOFTWARE = {"LIBGL_ALWAYS_SOFTWARE": "1", "SDL_VIDEODRIVER": "dummy"}
"""Peers draw on the processor too, and open no window."""


class WorkerEndedError(Exception):
    """A renderer that did not start, or fell over; the message says why."""


class Worker:
    """One renderer at work. Its process ends with this one, whatever happens: it reads commands from our pipe."""

    def __init__(self, python: Path, module: str, samples: int, threads: int) -> None:
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 (closed on exit)
        self._process = subprocess.Popen(
            [python, "-m", "peers.worker", module, str(samples), str(threads)],
            cwd=FOLDER,
            env={**os.environ, **SOFTWARE},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
            text=True,
        )

    def __enter__(self) -> Worker:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout, self._errors):
            if stream is not None:
                try:
                    stream.close()
                except BrokenPipeError:
                    continue  # it went away with a command unread

    def start(self) -> str:
        """What the renderer calls itself, once it is ready."""
        name: str = self._answer()["name"]
        return name

    def ask(self, do: str, **more: Any) -> dict[str, float]:
        """The answer to a command.

        Raises:
            WorkerEndedError: there is none.
        """
        pipe = self._process.stdin
        try:
            if pipe is not None:
                pipe.write(json.dumps({"do": do, **more}) + "\n")
                pipe.flush()
        except BrokenPipeError:
            raise WorkerEndedError(self._reason()) from None
        return self._answer()

    def _answer(self) -> dict[str, Any]:
        timer = threading.Timer(LIMIT_S, self._process.kill)
        timer.start()
        try:
            line = self._process.stdout.readline() if self._process.stdout is not None else ""
        finally:
            timer.cancel()
        if not line:
            raise WorkerEndedError(self._reason())
        answer: dict[str, Any] = json.loads(line)
        return answer

    def _reason(self) -> str:
        code = self._process.wait()
        self._errors.seek(0)
        said = [line for line in self._errors.read().decode(errors="replace").splitlines() if line.strip()]
        ended = f"ended by {signal.Signals(-code).name}" if code < 0 else f"ended with {code}"
        return f"{ended}: {said[-1].strip()}" if said else ended
