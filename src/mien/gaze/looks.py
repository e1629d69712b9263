"""Looks that somebody asked for: the eyes leave first, the head follows a little, both come back."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from math import sqrt
from types import MappingProxyType

from mien.core.chance import stream
from mien.timeline import Track

from .curves import way
from .eyes import saccade_length_s

HEAD_LAG_S = 0.06
HEAD_WAY_S = 0.42
"""The head sets out after the eyes and takes this long; how far it goes is in the table.

Source: Freedman and Sparks 1997, Eye-head coordination during head-unrestrained gaze shifts, Journal of
Neurophysiology 77 (eyes lead, head contributes little to shifts under 20 degrees); the numbers are our choice.
"""

_CHANNELS = ("eye_turn", "eye_nod", "head_turn", "head_nod")


@dataclass(frozen=True)
class Direction:
    """Where a look goes: degrees by channel, and whether chance decides the side."""

    name: str
    angles_deg: Mapping[str, float]
    either: bool


@dataclass(frozen=True)
class Glance:
    """A look in a direction from one moment to another, 0..1 of the way.

    Attributes:
        start_s: when the eyes leave.
        end_s: when they come back.
        direction: a name of ``look_directions``.
        amount: share of the way.
    """

    start_s: float
    end_s: float
    direction: str
    amount: float = 1.0


@cache
def look_directions() -> Mapping[str, Direction]:
    """Directions by name. The amounts are our choice: plain to see, and the iris stays whole."""
    text = resources.files("mien.gaze").joinpath("data", "looks.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(text.splitlines())
    found = (
        Direction(row["name"], {channel: float(row[channel]) for channel in _CHANNELS}, row["either"] == "1")
        for row in rows
    )
    return MappingProxyType({direction.name: direction for direction in found})


def looks(glances: Sequence[Glance], length_s: float, seed: int) -> dict[str, Track]:
    """Tracks of ``eye_turn``, ``eye_nod``, ``head_turn`` and ``head_nod``, degrees; none without glances.

    Args:
        glances: in order; one that begins before another ends cuts it short.
        length_s: for how long.
        seed: of the sides that chance decides.
    """
    aims = list(_aims(glances, seed))
    return {channel: _follow(channel, aims, length_s) for channel in _CHANNELS} if aims else {}


def _aims(glances: Sequence[Glance], seed: int) -> Iterator[tuple[float, Mapping[str, float]]]:
    """When the eyes set out, and for which angles."""
    chance = stream(seed, "looks")
    for number, glance in enumerate(glances):
        direction = look_directions()[glance.direction]
        side = -1.0 if chance.random() < 0.5 and direction.either else 1.0
        yield (
            glance.start_s,
            {
                channel: angle * glance.amount * (side if channel.endswith("turn") else 1.0)
                for channel, angle in direction.angles_deg.items()
            },
        )
        if number + 1 == len(glances) or glances[number + 1].start_s > glance.end_s:
            yield glance.end_s, dict.fromkeys(_CHANNELS, 0.0)


def _follow(channel: str, aims: Sequence[tuple[float, Mapping[str, float]]], length_s: float) -> Track:
    times, places = [0.0], [0.0]
    before: Mapping[str, float] = dict.fromkeys(_CHANNELS, 0.0)
    for start_s, angles in aims:
        aside, up = (angles[eye] - before[eye] for eye in ("eye_turn", "eye_nod"))
        lag_s, way_s = (
            (0.0, saccade_length_s(sqrt(aside * aside + up * up)))
            if channel.startswith("eye")
            else (HEAD_LAG_S, HEAD_WAY_S)
        )
        begin = max(times[-1], start_s + lag_s)
        times += [begin, begin + way_s]
        places += [places[-1], angles[channel]]
        before = angles
    times.append(max(length_s, times[-1]))
    places.append(places[-1])
    return way(times, places, name=channel)
