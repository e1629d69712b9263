"""What a hand does while its owner speaks: poses that stay until the next, and moves that end where they began."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from mien.core import Face, Preset
from mien.timeline import CHANGES, Track

from .marks import Expression, Units

KINDS = ("hand", "move")
"""Presets that are gestures."""

REACH_S = 0.4
"""A hand reaches a pose, and comes back from a move, in this time: our choice."""

CHANGE = "cosine"

Values = NDArray[np.float64]


def gestures(face: Face) -> dict[str, Preset]:
    """What the hand of a face can do, by name; nothing without one."""
    return {name: preset for name, preset in face.presets.items() if preset.kind in KINDS}


def part_gestures(
    face: Face, asked: Sequence[tuple[float, Expression | Units]]
) -> tuple[list[tuple[float, Expression]], list[tuple[float, Expression | Units]]]:
    """What is asked of the hand of a face, and what of the face itself, with the times."""
    known = gestures(face)
    signs = [(start_s, act) for start_s, act in asked if isinstance(act, Expression) and act.name in known]
    return signs, [each for each in asked if each not in signs]


def gesture(face: Face, asked: Sequence[tuple[float, Expression]], length_s: float) -> dict[str, Track]:
    """Tracks that add what was asked of a hand to its parameters; none where nothing was.

    A gesture goes on until the next one, which sets out from wherever the hand then is. At the end the hand is at rest
    again, unless that was asked for too late.

    Args:
        face: it has all the gestures.
        asked: from when on, seconds, in order.
        length_s: for how long.
    """
    if not asked:
        return {}
    known = gestures(face)
    rows = tuple(dict.fromkeys(row for name in known for values in _keys(known[name]) for row in values[1]))
    way = _Way(np.zeros(len(rows)))
    held = np.zeros(len(rows))
    starts = [start_s for start_s, _ in asked]
    for (start_s, act), end_s in zip(asked, [*starts[1:], length_s], strict=True):
        preset = known[act.name]
        keys = [(start_s + time_s, act.amount * values) for time_s, values in _states(face, preset, rows)]
        if preset.keys:
            keys.append((keys[-1][0] + REACH_S, held))
        else:
            held = keys[-1][1]
        way.wait(start_s)
        way.go(keys, end_s)
    if way.times_s[-1] <= length_s - REACH_S:
        way.wait(length_s - REACH_S)
        way.go([(length_s, np.zeros(len(rows)))], length_s)
    states = np.stack(way.states)
    return {
        row: Track.from_keys(way.times_s, column, CHANGE, name=row)
        for row, column in zip(rows, states.T, strict=True)
        if np.any(column)
    }


class _Way:
    """Where a hand is over time, as far as it has been told."""

    def __init__(self, rest: Values) -> None:
        self.times_s, self.states = [0.0], [rest]

    def wait(self, time_s: float) -> None:
        """Nothing happens until then."""
        if time_s > self.times_s[-1]:
            self._add(time_s, self.states[-1])

    def go(self, keys: Sequence[tuple[float, Values]], end_s: float) -> None:
        """Goes through keys, but breaks off at the end."""
        for time_s, state in keys:
            before_s, before = self.times_s[-1], self.states[-1]
            if before_s >= end_s:
                return
            share = float(CHANGES[CHANGE](min(1.0, (end_s - before_s) / (time_s - before_s))))
            self._add(min(time_s, end_s), before + share * (state - before))

    def _add(self, time_s: float, state: Values) -> None:
        self.times_s.append(time_s)
        self.states.append(state)


def _keys(preset: Preset) -> Sequence[tuple[float, dict[str, float]]]:
    return [(time_s, dict(values)) for time_s, values in preset.keys] or [(REACH_S, dict(preset.values))]


def _states(face: Face, preset: Preset, rows: Sequence[str]) -> Iterator[tuple[float, Values]]:
    """When, seconds from the beginning, and how far each row then lies from rest."""
    table = face.parameters
    state = dict.fromkeys(rows, 0.0)
    for time_s, values in _keys(preset):
        state |= {row: value - table[row].default for row, value in values.items()}
        yield time_s, np.array([state[row] for row in rows])
