"""What a server tells of itself."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.metadata import version
from typing import Any

import numpy as np

from .animator import Animator

PERCENTS = (50, 95, 99)


def describe(animator: Animator) -> dict[str, Any]:
    """Face, loops, clients and what they have measured, as JSON."""
    session, report = animator.session, animator.report
    clients = [
        {"frames": outbox.frames, "events": outbox.events, "sound": outbox.sound, **outbox.report}
        for outbox in animator.outboxes
    ]
    return {
        "face": session.face.name,
        "version": version("mien"),
        "rate_hz": float(session.rate),
        "seed": session.seed,
        "loop": session.loop,
        "loops": {
            "run": report.run,
            "late": report.late,
            "dropped": report.dropped,
            "worst_ms": round(report.worst_s * 1000.0, 3),
            "delay_ms": _percentiles(animator.delays_s),
        },
        "messages": animator.messages,
        "clients": clients,
        "microphone": animator.microphone.describe(),
        "motions": sorted(session.motions),
        "speaks": animator.speaker is not None,
        **{name: tell() for name, tell in animator.about.items()},
    }


def _percentiles(delays_s: Sequence[float]) -> dict[str, float]:
    """How late loops began lately."""
    if not delays_s:
        return {}
    found = np.percentile(np.array(delays_s) * 1000.0, PERCENTS)
    return {f"p{percent}": round(float(value), 3) for percent, value in zip(PERCENTS, found, strict=True)}
