"""Tracks made of pulses and of smooth ways between places, as keys with straight lines between them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache

from mien.timeline import Track

STEPS = 6
"""Straight pieces of a smooth way; the error is under 1.5 % of it."""


def way(times_s: Sequence[float], places: Sequence[float], *, steps: int = STEPS, name: str = "") -> Track:
    """The track that goes smoothly from place to place; two equal places in a row are a rest.

    Args:
        times_s: (K,) s, never falling; the first is 0 or more.
        places: (K,) values.
        steps: straight pieces from each place to the next.
        name: of the channel, for messages.
    """
    times: list[float] = [times_s[0]]
    values: list[float] = [places[0]]
    for i in range(1, len(times_s)):
        start, end = times_s[i - 1], times_s[i]
        if end <= start:
            continue
        count = 1 if places[i] == places[i - 1] else steps
        for share, height in _steps(count):
            times.append(start + share * (end - start))
            values.append(places[i - 1] + height * (places[i] - places[i - 1]))
    return Track.from_keys(times, values, name=name)


def pulses(
    shapes: Iterable[tuple[Sequence[float], Sequence[float]]], length_s: float, *, name: str = "", steps: int = STEPS
) -> Track:
    """The track of pulses one after the other, each times (K,) s and values (K,) that begin and end at rest.

    A pulse starts no earlier than the one before has ended, and none before 0 s.
    """
    times, values = [0.0], [0.0]
    for when, what in shapes:
        late = max(0.0, times[-1] - when[0])
        times += [moment + late for moment in when]
        values += what
    times.append(max(length_s, times[-1]))
    values.append(0.0)
    return way(times, values, name=name, steps=steps)


@lru_cache(maxsize=16)
def _steps(count: int) -> tuple[tuple[float, float], ...]:
    """Share of the time and of the way after each of ``count`` steps of a smooth way: 3x² - 2x³."""
    shares = [step / count for step in range(1, count + 1)]
    return tuple((x, x * x * (3.0 - 2.0 * x)) for x in shares)
