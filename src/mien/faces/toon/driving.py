"""What motors do to an outline beyond the features' lines: states at their ends, several of which add up."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mien.core import exact

from .lines import Moment, Stretch
from .records import Character, Driver, Floats, Shift, State, Touch

Act = Callable[[Floats, Moment, float], Floats]
"""Vertices (N, 2) and a share 0..1 of the way into a state -> vertices."""


class Drive:
    """One motor and the states of an outline at its two ends."""

    def __init__(self, driver: Driver, character: Character, flatten: Callable[[State], Floats], rest: Floats) -> None:
        """``flatten`` gives the vertices (N, 2) of an outline, ``rest`` (N, 2) those that it rests with."""
        self._motor = driver.motor
        self._low, self._high = (
            None if state is None else _act(state, character, flatten, rest) for state in (driver.low, driver.high)
        )

    def __call__(self, points: Floats, moment: Moment) -> Floats:
        """Vertices (N, 2) as far into a state as the motor has gone from rest to that end (A1.5, A1.6)."""
        value = moment.activation(self._motor)
        act = self._high if value > 0.0 else self._low
        return points if act is None or not value else act(points, moment, min(abs(value), 1.0))


def _act(state: State, character: Character, flatten: Callable[[State], Floats], rest: Floats) -> Act:
    if isinstance(state, Shift):
        return lambda points, _, share: shift(points, state, share)
    if isinstance(state, Touch):
        stretch = Stretch(state.line, character.features[state.line.feature])
        return lambda points, moment, share: _touch(points, stretch.points(moment), state.offset, share)
    way = flatten(state) - rest
    return lambda points, _, share: points + share * way


def _touch(points: Floats, line: Floats, offset: float, share: float) -> Floats:
    """Points moved up until the highest reaches the middle of a line."""
    rise = line[len(line) // 2, 1] + offset - points[:, 1].min()
    return points + np.array([0.0, share * min(rise, 0.0)])


def shift(points: Floats, state: Shift, share: float) -> Floats:
    """Points (N, 2) a share of the way into a state that turns, scales and moves them, in this order."""
    sine, cosine = (float(each) for each in exact.sin_cos(np.deg2rad(state.rotate_deg * share)))
    (px, py), (sx, sy) = state.about, state.scale
    across = (points[:, 0] - px) * (1.0 + (sx - 1.0) * share)
    down = (points[:, 1] - py) * (1.0 + (sy - 1.0) * share)
    x = px + across * cosine - down * sine + state.move[0] * share
    y = py + across * sine + down * cosine + state.move[1] * share
    moved = np.stack([x, y], axis=1)
    if state.ramp is None:
        return moved
    top, full = state.ramp
    weight = exact.smoothstep((points[:, 1] - top) / (full - top))[:, None]
    return points + weight * (moved - points)
