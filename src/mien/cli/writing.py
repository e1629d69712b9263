"""The last stage of several commands: a performance into a file, with progress, and what came out of it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from .stages import Stages, format_time

if TYPE_CHECKING:
    from mien.formats.performances import Performance


def write(performance: Performance, out: Path, fps: float, threads: int | None, stages: Stages) -> None:
    """Writes a performance and tells of it."""
    from mien.formats import check_performance, write_performance

    kind = check_performance(out, fps=fps, scene=performance.scene)
    if kind in ("film", "folder", "series"):
        prepare(stages)
        with stages.progress("drawing") as report:
            write_performance(performance, out, fps=fps, threads=threads, report=report)
    else:
        with stages.stage("writing"):
            write_performance(performance, out, fps=fps, threads=threads)
    length_s = performance.timeline.length_s
    rate = "" if kind == "wav" else f" at {fps:g} frames a second"
    stages.say(f"{out}: {length_s:.1f} s{rate}; done in {format_time(stages.elapsed_s)}")


def prepare(stages: Stages) -> None:
    """Compiles the rasteriser when it is used for the first time, and says so."""
    from mien.api import warmup

    warmup(stages.say)
