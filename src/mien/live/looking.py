"""Looking at something: the eyes go first, the head follows, and the eyes come back as far as it has come."""

from __future__ import annotations

import math
from collections.abc import Iterator

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

Target = str | tuple[float, float, float]


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


def look_ways(at: Target, head: float, now: Floats, loop_s: float) -> Iterator[tuple[int, tuple[Way, ...]]]:
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


def _head_share(angle_deg: float, eyes_deg: float) -> float:
    beyond = max(0.0, (1.0 - HEAD_SHARE) * abs(angle_deg) - eyes_deg)
    return HEAD_SHARE * angle_deg + math.copysign(beyond, angle_deg)


def _degrees(across: float, along: float) -> float:
    """The angle, to a ten-millionth, so that no library's arctangent decides a bit of what is drawn."""
    return round(math.degrees(math.atan2(across, along)), 7)


def _hold(channel: str, angle_deg: float) -> float:
    row = vocabulary(CHANNELS)[channel]
    return min(max(angle_deg, row.low), row.high)
