"""``mien warmup``: what would otherwise be done at the first use."""

from __future__ import annotations

from . import options


def warmup(quiet: options.Quiet = False) -> None:
    """Compile now what the first picture would wait for.

    \b
    mien warmup
    """
    from mien.api import warmup

    from .stages import Stages, format_time

    stages = Stages(quiet)
    warmup(stages.say)
    stages.say(f"ready in {format_time(stages.elapsed_s)}")
