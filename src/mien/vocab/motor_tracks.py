"""Timelines whose tracks are named by motors of ToonFace, for faces whose parameters have other names."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mien.core import Face, MienError, ParameterTable
from mien.timeline import Layer, Timeline, Track

from .posing import MOTORS, set_values
from .vocabulary import vocabulary

SAMPLES_S = 120.0
"""Moments a second at which motors are turned into parameters, besides the keys: two a frame at 60 frames a second."""


def table_with_motors(face: Face) -> ParameterTable:
    """The rows of a face, and those motors that are no names of it."""
    codes = vocabulary(MOTORS)
    rows = [row for row in codes if row.name not in face.parameters]
    known = {row.name for row in rows}
    aliases = {alias: name for alias, name in codes.aliases.items() if name in known and alias not in face.parameters}
    return ParameterTable((*face.parameters, *rows), {**face.parameters.aliases, **aliases})


def play_motors(timeline: Timeline, face: Face) -> Timeline:
    """The timeline with the face's own parameters in place of motors that it has no parameters for.

    Tracks of its own parameters win over motors of the same layer. Between the samples values run straight.

    Raises:
        MienError: a layer that does not replace names a motor, or the face has no table for motors.
        UnknownNameError: a track is neither a parameter of the face nor a motor.
    """
    return replace(timeline, layers=tuple(_play(layer, face) for layer in timeline.layers))


def _play(layer: Layer, face: Face) -> Layer:
    codes = {name: track for name, track in layer.tracks.items() if name not in face.parameters}
    if not codes:
        return layer
    if layer.blend != "replace":
        names = ", ".join(codes)
        raise MienError(f"layer {layer.name!r}: {names} of {face.name} can only replace, not {layer.blend}")
    first_s, last_s = min(track.first_s for track in codes.values()), layer.length_s
    keys = [track.given()[0] for track in codes.values()]
    times = np.unique(np.concatenate([*keys, np.arange(first_s, last_s, 1.0 / SAMPLES_S)]))
    values = {name: track.evaluate(times)[0] for name, track in codes.items()}
    rest = face.neutral.values
    poses = np.stack(
        [
            set_values(
                {name: float(column[k]) for name, column in values.items() if not np.isnan(column[k])},
                face,
                face.neutral,
            ).values
            for k in range(len(times))
        ]
    )
    moved = {
        name: Track.from_keys(times, poses[:, row], name=name)
        for name, row in face.parameters.index.items()
        if (poses[:, row] != rest[row]).any()
    }
    own = {name: track for name, track in layer.tracks.items() if name not in codes}
    return replace(layer, tracks={**moved, **own})
