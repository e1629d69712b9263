"""espeak-ng spoken with, as a separate process: its licence is the GPL, and no code of it is loaded into ours."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError

INSTALL = "pip install 'mien[espeak]'"

_PACKAGE = "espeakng_loader"
_LIBRARIES = ("libespeak-ng.so", "libespeak-ng.dylib", "espeak-ng.dll")
_WORKER = Path(__file__).with_name("espeak_worker.py")


@dataclass(frozen=True)
class Installation:
    """Where the shared library and the data of the engine are."""

    library: Path
    data: Path


@dataclass(frozen=True)
class Event:
    """What begins at a sample: a word, at a character of the text, or a phone in IPA, empty for a pause."""

    sample: int
    place: int = -1
    letters: str = ""

    @property
    def is_word(self) -> bool:
        """Whether a word begins."""
        return self.place >= 0


@dataclass(frozen=True, eq=False)
class Said:
    """A passage as the engine says it: (N,) samples, their rate and what begins when."""

    samples: NDArray[np.int16]
    rate_hz: int
    events: tuple[Event, ...]


def find_installation() -> Installation | None:
    """The engine's files; None when the extra ``espeak`` is not installed."""
    spec = find_spec(_PACKAGE)
    for folder in map(Path, (spec and spec.submodule_search_locations) or ()):
        library = next((folder / name for name in _LIBRARIES if (folder / name).exists()), None)
        if library is not None:
            return Installation(library, folder / "espeak-ng-data")
    return None


class Engine:
    """The engine in a process of its own, from entering to leaving; each begins afresh, so that it says the same."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None

    def __enter__(self) -> Engine:
        found = find_installation()
        if found is None:
            raise MienError(f"espeak-ng is not installed — try: {INSTALL}")
        self._process = subprocess.Popen(
            # Isolated: nothing of the caller's folder or environment is imported.
            [sys.executable, "-I", "-S", _WORKER, found.library, found.data],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            start_new_session=True,  # an interrupt is ours; the process ends with its input
        )
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._process is not None:
            self._process.kill()
            self._process.communicate()

    def say(self, text: str, voice: str, words_a_minute: int) -> Said:
        """A text said by one of the engine's voices.

        Raises:
            MienError: there is no such voice, or the process ended.
        """
        answer, samples = self._ask({"voice": voice, "words_a_minute": words_a_minute, "text": text})
        if "error" in answer:
            raise MienError(f"{answer['error']} — 'mien voices' lists ours")
        events = (
            Event(sample, place=value) if kind == "word" else Event(sample, letters=value)
            for sample, kind, value in answer["events"]
        )
        return Said(np.frombuffer(samples, "<i2").astype(np.int16), answer["rate_hz"], tuple(events))

    def _ask(self, request: dict[str, Any]) -> tuple[dict[str, Any], bytes]:
        if self._process is None or self._process.stdin is None or self._process.stdout is None:
            raise MienError("espeak-ng is asked before it is started")
        try:
            self._process.stdin.write(json.dumps(request).encode() + b"\n")
            self._process.stdin.flush()
            line = self._process.stdout.readline()
            answer = json.loads(line or "null")
            samples = self._process.stdout.read(answer.get("bytes", 0)) if answer else b""
        except BrokenPipeError:
            answer = None
        if answer is None or len(samples) < answer.get("bytes", 0):
            raise MienError(f"espeak-ng stopped with status {self._process.wait()} — try again: {INSTALL}")
        return answer, samples
