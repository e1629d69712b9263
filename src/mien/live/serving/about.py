"""What a server tells of itself."""

from __future__ import annotations

from importlib.metadata import version
from typing import Any

from .animator import Animator


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
        },
        "messages": animator.messages,
        "clients": clients,
        "motions": sorted(session.motions),
    }
