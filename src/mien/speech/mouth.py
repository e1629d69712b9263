"""Phones to tracks of the mouth's channels: a coarticulation model, the same for every kind of face."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np

from mien.core import Cue
from mien.timeline import Track

from .articulation import USUAL, Articulation
from .mouth_blend import blend
from .mouth_gestures import Gestures, gestures
from .mouth_holds import NEAR_S, Hold, evaluate, find_holds, nearness
from .mouth_keys import reduce_keys
from .mouth_passes import soften_pauses, split_diphthongs, tidy
from .mouth_table import BLENDED, GROUPS, HELD, Floats

MOUTH_CHANNELS: tuple[str, ...] = (*HELD, *BLENDED)
"""Channels that speech plays, each 0..1."""

STEP_S = 0.01
CHUNK_S = 30.0

SEALED = {"upper_lip": 1.0, "lower_lip": 1.0, "spread": 0.5, "tongue_out": 1.0, "tuck": 1.0}
"""Part of a channel that is taken away while the lips are pressed together."""

TUCKED = {"lower_lip": 1.0, "tongue_out": 1.0}
"""Part of a channel that is taken away while the lower lip is under the teeth."""

RAISED = {"closure": 0.35, "tuck": 0.3}
"""Part of the jaw's opening that is taken away where the lips are held."""


def articulate(phones: Iterable[Cue], style: Articulation = USUAL) -> dict[str, Track]:
    """Tracks of the mouth's channels by name, from 0 s to a moment of rest after the last phone.

    Work grows linearly with the phones; besides the keys, memory does not.

    Args:
        phones: ARPABET cues; vowels may carry a stress digit, ``SIL`` is silence and fills gaps.
        style: how much each pass does; lips close and tuck fully whatever the others do.

    Raises:
        RangeError: a time is not finite, or a phone ends before it starts.
        UnknownNameError: a symbol is no phone.
    """
    cues = tidy(phones)
    holds = find_holds(cues, style.closures)
    sounds = gestures(split_diphthongs(soften_pauses(cues, style.pauses)), style)
    times: dict[str, list[Floats]] = {channel: [] for channel in MOUTH_CHANNELS}
    values: dict[str, list[Floats]] = {channel: [] for channel in MOUTH_CHANNELS}
    for grid, part in _chunks(holds, cues[-1].end_s):
        curves = sample(sounds, part, grid, style)
        for channel, curve in curves.items():
            keep = np.isin(grid, _corners(part)) if channel in HELD else None
            kept = reduce_keys(grid, curve, keep=keep)
            kept = kept[1:] if times[channel] else kept
            times[channel].append(grid[kept])
            values[channel].append(curve[kept])
    return {
        channel: Track.from_keys(np.concatenate(times[channel]), np.concatenate(values[channel]), name=channel)
        for channel in MOUTH_CHANNELS
    }


def sample(sounds: Gestures, holds: Sequence[Hold], times_s: Floats, style: Articulation = USUAL) -> dict[str, Floats]:
    """(N,) values of every channel at sorted times, 0..1; a pure function of each moment's neighbourhood."""
    blended = blend(sounds, times_s)
    curves = {channel: evaluate(holds, channel, times_s) for channel in HELD}
    for group, channels in GROUPS.items():
        amount = style.strength * getattr(style, group)
        curves |= {channel: reach(blended[:, BLENDED.index(channel)], amount) for channel in channels}
    for channel, taken in RAISED.items():
        curves["jaw"] = curves["jaw"] * (1.0 - taken * nearness(holds, channel, times_s))
    return give_way(give_way(curves, "closure", SEALED), "tuck", TUCKED)


def reach(share: Floats, amount: float) -> Floats:
    """(N,) shares 0..1 made larger or smaller; those made larger come nearer to 1 without being cut off there."""
    return amount * share / (1.0 + max(0.0, amount - 1.0) * share)


def give_way(curves: Mapping[str, Floats], ruler: str, taken: Mapping[str, float]) -> dict[str, Floats]:
    """The curves with some made smaller by the part taken away while another, the ruler, is 1."""
    return {
        channel: curve * (1.0 - taken[channel] * curves[ruler]) if channel in taken else curve
        for channel, curve in curves.items()
    }


def _chunks(holds: Sequence[Hold], end_s: float) -> Iterator[tuple[Floats, Sequence[Hold]]]:
    """Sample times of one piece after the other, sharing their ends, with the holds that reach into each."""
    starts = np.array([hold.start_s - NEAR_S for hold in holds])
    ends = np.array([hold.end_s + NEAR_S for hold in holds])
    count = max(1, math.ceil(end_s / CHUNK_S))
    for piece in range(count):
        low, high = piece * CHUNK_S, min((piece + 1) * CHUNK_S, end_s)
        part = holds[int(np.searchsorted(ends, low)) : int(np.searchsorted(starts, high, side="right"))]
        inner = low + STEP_S * np.arange(1, math.ceil((high - low) / STEP_S))
        corners = _corners(part)
        inside = corners[(corners > low) & (corners < high)]
        yield np.unique(np.concatenate([[low], inner[inner < high], inside, [high]])), part


def _corners(holds: Sequence[Hold]) -> Floats:
    """Times at which held curves begin, reach and leave their plateaus."""
    return np.array(
        [
            time
            for hold in holds
            for time in (hold.start_s - hold.rise_s, hold.start_s, hold.end_s, hold.end_s + hold.fall_s)
        ]
    )
