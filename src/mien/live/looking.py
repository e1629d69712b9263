"""Looking at something: the eyes go first, the head follows, and the eyes come back as far as it has come."""

from __future__ import annotations

import math
from collections.abc import Iterator

from mien.core import MienError, UnknownNameError
from mien.gaze import look_directions
from mien.gaze.eyes import saccade_length_s
from mien.gaze.looks import HEAD_LAG_S, HEAD_WAY_S
from mien.vocab import vocabulary

from .mixing import CHANNELS
from .slices import Floats, Way, count_slices

HEAD_SHARE = 0.26
"""How much of a small turn the head does: as in ``looks.csv`` of ``mien.gaze``."""

EYES_DEG = {"turn": 26.0, "nod": 18.0}
"""Eyes do not stay further aside than this if the head can help: our choice; eyes can do 45, and it looks strained."""

PURSUIT_DEG = 3.0
"""Eyes that follow something go so far at once; where it has gone further they leap, as after a glance.

Source: smooth pursuit manages 30 to 100 degrees a second, and larger errors are made up for by saccades (Robinson 1965,
Journal of Physiology 180); the angle is our choice.
"""

MOST_TARGETS = 1000

Point = tuple[float, float, float]
Target = str | Point
Ways = Iterator[tuple[int, tuple[Way, ...]]]


def aim(at: Target, head: float) -> dict[str, float]:
    """Degrees of ``eye_turn``, ``eye_nod``, ``head_turn`` and ``head_nod`` in the end, within their ranges.

    Args:
        at: a direction, or a point (x, y, z) m from the middle of the head.
        head: how much of what is usual the head does.

    Source: Freedman and Sparks 1997, Journal of Neurophysiology 77 (small shifts are the eyes'); shares are our choice.
    """
    if isinstance(at, str):
        angles = look_directions()[at].angles_deg
        whole = {axis: angles[f"eye_{axis}"] + angles[f"head_{axis}"] for axis in EYES_DEG}
        turned = {axis: angles[f"head_{axis}"] for axis in EYES_DEG}
    else:
        x, y, z = at
        whole = {"turn": _degrees(x, z), "nod": _degrees(y, math.sqrt(x * x + z * z))}
        turned = {axis: _head_share(angle, EYES_DEG[axis]) for axis, angle in whole.items()}
    found = {}
    for axis, angle in whole.items():
        found[f"head_{axis}"] = _hold(f"head_{axis}", turned[axis] * head)
        found[f"eye_{axis}"] = _hold(f"eye_{axis}", angle - found[f"head_{axis}"])
    return found


def look_ways(at: Target, head: float, now: Floats, loop_s: float) -> Ways:
    """Channel and ways of each that takes part in a look.

    Args:
        at: where.
        head: how much of what is usual the head does.
        now: (C,) channels as they are.
        loop_s: length of a loop, seconds.
    """
    angles, index = aim(at, head), vocabulary(CHANNELS).index
    far = {
        axis: _hold(f"eye_{axis}", angles[f"eye_{axis}"] + angles[f"head_{axis}"] - now[index[f"head_{axis}"]])
        for axis in EYES_DEG
    }
    aside, up = (far[axis] - now[index[f"eye_{axis}"]] for axis in EYES_DEG)
    leap = count_slices(saccade_length_s(math.sqrt(aside * aside + up * up)), loop_s)
    lag = max(leap, count_slices(HEAD_LAG_S, loop_s))
    follow = count_slices(HEAD_WAY_S, loop_s)
    for axis in EYES_DEG:
        wait = (Way(None, lag - leap),) if lag > leap else ()
        back = Way(angles[f"eye_{axis}"], follow, "cosine")
        yield index[f"eye_{axis}"], (Way(far[axis], leap), *wait, back)
        yield index[f"head_{axis}"], (Way(None, lag), Way(angles[f"head_{axis}"], follow, "cosine"))


def follow_ways(at: Point, head: float, now: Floats, loop_s: float) -> Ways:
    """Channel and ways of each while something that moves is looked at: the eyes stay on it, the head comes along.

    Args:
        at: where it is now.
        head: how much of what is usual the head does.
        now: (C,) channels as they are.
        loop_s: length of a loop, seconds.
    """
    angles, index = aim(at, head), vocabulary(CHANNELS).index
    before = {axis: float(now[index[f"head_{axis}"]]) for axis in EYES_DEG}
    whole = {axis: angles[f"eye_{axis}"] + angles[f"head_{axis}"] for axis in EYES_DEG}
    aside, up = (whole[axis] - before[axis] - now[index[f"eye_{axis}"]] for axis in EYES_DEG)
    far = math.sqrt(aside * aside + up * up)
    leap = 1 if far <= PURSUIT_DEG else count_slices(saccade_length_s(far), loop_s)
    follow = count_slices(HEAD_WAY_S, loop_s)
    for axis in EYES_DEG:
        # Both go straight, so that eyes and head together stay where the target is; the next place of it may come
        # at the next loop, and a way that sets out slowly would never get anywhere.
        turned = before[axis] + (angles[f"head_{axis}"] - before[axis]) * (leap / (leap + follow))
        first = Way(_hold(f"eye_{axis}", whole[axis] - turned), leap)
        yield index[f"eye_{axis}"], (first, Way(angles[f"eye_{axis}"], follow))
        yield index[f"head_{axis}"], (Way(angles[f"head_{axis}"], leap + follow),)


class Looks:
    """What a face can look at by name, and which of it it looks at."""

    def __init__(self, loop_s: float) -> None:
        self._loop_s = loop_s
        self._targets: dict[str, Point] = {}
        self._followed: tuple[str, float] | None = None

    def look(self, at: Target, head: float, now: Floats) -> Ways:
        """The ways of a look; what it is at will be followed.

        Raises:
            UnknownNameError: there is no such direction or target.
        """
        if isinstance(at, str) and at not in self._targets and at not in look_directions():
            raise UnknownNameError("direction or target", at, [*look_directions(), *self._targets])
        self._followed = (at, head) if isinstance(at, str) and at in self._targets else None
        return look_ways(self._targets.get(at, at) if isinstance(at, str) else at, head, now, self._loop_s)

    def place(self, name: str, at: Point, now: Floats) -> Ways:
        """The ways of a face that looks at a target which is somewhere now; none if it does not.

        Raises:
            MienError: the name is that of a direction, or there are too many.
        """
        if name in look_directions():
            raise MienError(f"target: {name!r} is a direction — give it another name")
        if len(self._targets) == MOST_TARGETS and name not in self._targets:
            raise MienError(f"target: there are {MOST_TARGETS} already — use their names again")
        self._targets[name] = at
        if self._followed is None or self._followed[0] != name:
            return iter(())
        return follow_ways(at, self._followed[1], now, self._loop_s)

    def leave(self) -> None:
        """Follow nothing any more."""
        self._followed = None


def _head_share(angle_deg: float, eyes_deg: float) -> float:
    beyond = max(0.0, (1.0 - HEAD_SHARE) * abs(angle_deg) - eyes_deg)
    return HEAD_SHARE * angle_deg + math.copysign(beyond, angle_deg)


def _degrees(across: float, along: float) -> float:
    """The angle, to a ten-millionth, so that no library's arctangent decides a bit of what is drawn."""
    return round(math.degrees(math.atan2(across, along)), 7)


def _hold(channel: str, angle_deg: float) -> float:
    row = vocabulary(CHANNELS)[channel]
    return min(max(angle_deg, row.low), row.high)
