"""What a face looks like while nothing moves it, as the lowest layer of a timeline."""

from __future__ import annotations

from dataclasses import replace

from mien.core import Pose

from .layers import Layer
from .timeline import Timeline
from .track import Track

SETTINGS = "settings"
"""Name of that layer."""


def with_settings(timeline: Timeline, pose: Pose) -> Timeline:
    """The timeline with what a pose changes as its lowest layer; everything else acts on top of it."""
    before = {layer.name: layer for layer in timeline.layers}.get(SETTINGS)
    tracks = {
        **(before.tracks if before else {}),
        **{name: Track.from_keys([0.0], [value], name=name) for name, value in pose.changed().items()},
    }
    others = tuple(layer for layer in timeline.layers if layer.name != SETTINGS)
    return replace(timeline, layers=(Layer(SETTINGS, "replace", tracks), *others)) if tracks else timeline
