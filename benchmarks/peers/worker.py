"""One renderer in a process of its own: ``python -m peers.worker MODULE SAMPLES THREADS``.

It reads a JSON command a line and answers each with a JSON line. It ends with its input, so that none is left behind
whatever became of who started it; Ctrl-C is not its business. What the renderer's libraries print goes to stderr.
"""

from __future__ import annotations

import json
import os
import resource
import signal
import sys
import time
from importlib import import_module
from pathlib import Path

import numpy as np

from .setting import Form, Peer

LEAD = 2
"""Frames drawn before the clock starts: others had the caches in the meantime."""


def measure(peer: Peer, first: int, count: int, frame_count: int) -> dict[str, float]:
    """Seconds of the clock and of all threads' work for ``count`` frames."""
    for k in range(first - LEAD, first):
        peer.draw(k % frame_count)
    work, clock = _work_s(), time.perf_counter()
    for k in range(first, first + count):
        peer.draw(k % frame_count)
    return {"wall_s": time.perf_counter() - clock, "cpu_s": _work_s() - work}


def _work_s() -> float:
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def main() -> None:
    """Obey until the input ends."""
    module, samples, threads = sys.argv[1:]
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)
    peer: Peer = import_module(f"peers.{module}").Renderer(int(samples), int(threads))
    print(json.dumps({"name": peer.name}), file=answers)
    form: Form | None = None
    for line in sys.stdin:
        command = json.loads(line)
        answer: dict[str, float] = {}
        if command["do"] == "load":
            form = Form.read(Path(command["path"]))
            peer.load(form)
        elif command["do"] == "draw" and form is not None:
            answer = measure(peer, command["first"], command["count"], len(form.points))
        elif command["do"] == "picture":
            np.save(command["path"], peer.upright(peer.draw(command["frame"])))
        print(json.dumps(answer), file=answers)


if __name__ == "__main__":
    main()
