"""A timeline played louder or softer: what its layers add, farther from rest or nearer to it."""

from __future__ import annotations

import math
from dataclasses import replace

from mien.core import Parameter, ParameterTable
from mien.core.exaggeration import check_amount, stretch

from .layers import Layer
from .timeline import Timeline
from .track import Floats, Track

AIMS = "gaze"
"""Name of the layer that turns eyes and head towards something; twice the angle would be another target."""


def exaggerate_timeline(timeline: Timeline, table: ParameterTable, amount: float) -> Timeline:
    """The timeline with ``amount`` times the distance from rest in all that expresses something; 1 is the same.

    Tracks that are added, and those that replace what lies beneath, are stretched key by key as ``exaggerate`` does a
    pose. Layers that multiply stay as they are, for they shut eyes and lips however wide these are; so does the layer
    of the gaze.

    Raises:
        RangeError: there is no such amount.
        UnknownNameError: a track's parameter is not in the table.
    """
    check_amount(amount)
    if amount == 1.0:
        return timeline
    layers = (
        [layer] if layer.blend == "multiply" or layer.name == AIMS else _exaggerate_layer(layer, table, amount)
        for layer in timeline.layers
    )
    return replace(timeline, layers=tuple(layer for several in layers for layer in several))


def _exaggerate_layer(layer: Layer, table: ParameterTable, amount: float) -> list[Layer]:
    """The layer by rows, since the two sides of a face may rest at different values.

    Where several names of it reach one row it becomes several layers, which act in the order of the names.
    """
    passes: list[dict[str, Track]] = [{}]
    for name, track in layer.tracks.items():
        for row in table.resolve(name):
            tracks = next((tracks for tracks in passes if row not in tracks), None)
            if tracks is None:
                passes.append(tracks := {})
            tracks[row] = _exaggerate_track(track, table[row], amount, layer.blend)
    names = [layer.name, *(f"{layer.name} {number}" for number in range(2, len(passes) + 1))]
    return [replace(layer, name=name, tracks=tracks) for name, tracks in zip(names, passes, strict=True)]


def _exaggerate_track(track: Track, row: Parameter, amount: float, blend: str) -> Track:
    if row.role != "motion":
        return track
    rest = 0.0 if blend == "add" else row.default
    shift = rest - row.default
    closed = math.nan if row.closed is None else row.closed + shift

    def move(values: Floats) -> Floats:
        return stretch(values, amount, rest=rest, low=row.low + shift, high=row.high + shift, closed=closed)

    return replace(track, first=move(track.first), last=move(track.last))
