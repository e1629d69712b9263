"""The last stage of several commands: a performance into a file, with progress, and what came out of it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from .stages import Stages, format_time

if TYPE_CHECKING:
    from mien.formats.cuts import Cut
    from mien.formats.performances import Performance
    from mien.timeline import Rate


def write(
    performance: Performance,
    out: Path,
    kind: str,
    stages: Stages,
    *,
    fps: Rate,
    threads: int | None,
    subtitles: str | None,
    variable: bool,
    cuts: Sequence[Cut] = (),
) -> None:
    """Writes a performance in a format that ``check_performance`` named, and tells of it."""
    from mien.formats import write_performance
    from mien.formats.codecs import find_codec
    from mien.formats.performances import BURN, DRAWN, HEARD

    if kind in DRAWN:
        prepare(stages)
    with stages.progress("drawing") if kind in DRAWN else stages.stage("writing") as report:
        write_performance(
            performance,
            out,
            fps=fps,
            scene=performance.scene,
            threads=threads,
            subtitles=subtitles,
            variable=variable,
            cuts=cuts,
            report=report,
        )
    if subtitles is not None and subtitles != BURN:
        stages.say(subtitles)
    rate = "" if kind in HEARD else f" at {float(fps):g} frames a second"
    silent = ", without sound" if kind == "film" and performance.sound and not find_codec(out).sound else ""
    stages.say(f"{out}: {performance.timeline.length_s:.1f} s{rate}{silent}; done in {format_time(stages.elapsed_s)}")


def prepare(stages: Stages) -> None:
    """Compiles the rasteriser when it is used for the first time, and says so."""
    from mien.api import warmup

    warmup(stages.say)
