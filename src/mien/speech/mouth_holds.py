"""Stretches of time over which lips are shut (p b m) or the lower lip is under the teeth (f v).

A film shows a moment every 1/fps seconds: what lasts a frame's time and a little is seen in every film.
Parke lost his f and v tucks between frames (1974, section 4.3); here none can be lost.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from mien.core import Cue, exact

from .mouth_table import Floats, PhoneTarget, phone_table

LEAST_S = 0.086
"""Length of the shortest hold: one frame at 12 fps is 83.3 ms."""

SAME_GAP_S = 0.045
OTHER_GAP_S = 0.05
MERGE_S = 0.03

CLOSE_S = 0.06
OPEN_S = 0.04
FASTER = 0.7
"""Lips pop open and close slowly: opening takes at most this share of the time of closing.

They meet at speed, so that they are not nearly shut for longer than they are shut.
Source: Löfqvist and Gracco 1997, Lip and jaw kinematics in bilabial stop consonant production, Journal of Speech,
Language, and Hearing Research 40: lips move fast when they touch. The lengths are our choice.
"""

NEAR_S = 0.08
"""The jaw comes up for a hold, and goes down after it, in this time: it cannot pop as the lips do."""

CLOSE_SHARE = 0.5
LEAST_CLOSE_S = 0.036
"""Closing takes at most a share of the sound before, so that a short one is not lost, but no less than this."""

NOISY = ("sibilant", "labial")
"""Kinds of phones whose noise needs open lips: holds beside them grow to the other side."""

SHORT_VOWEL_S = 0.15
"""A vowel between two holds that is shorter is left to itself: closures grow away from it, so that it is seen open."""


@dataclass(frozen=True)
class Hold:
    """A channel is 1 from ``start_s`` to ``end_s``; it rises over ``rise_s`` before and falls over ``fall_s`` after.

    ``spare_s`` is what is left of the phone after the hold, ``leave`` the sides, before and after, to which it is not
    lengthened.
    """

    start_s: float
    end_s: float
    channel: str
    rise_s: float = CLOSE_S
    fall_s: float = OPEN_S
    spare_s: float = 0.0
    leave: tuple[bool, bool] = (False, False)

    @property
    def length_s(self) -> float:
        """Duration of the plateau, seconds."""
        return self.end_s - self.start_s


def find_holds(phones: Sequence[Cue], amount: float = 1.0) -> tuple[Hold, ...]:
    """Holds of all labial phones, in order, none overlapping.

    Args:
        phones: tidy ones.
        amount: of the guarantee, 0..1: with 1 none is too short to be seen at 12 fps, with 0 each is as long as it is.
    """
    least_s = amount * LEAST_S
    return ease(spread_out(lengthen(merge(wish(phones)), least_s), least_s))


def wish(phones: Sequence[Cue]) -> list[Hold]:
    """The part of each labial phone over which it is held."""
    table = phone_table()
    rows = [table[cue.symbol] for cue in phones]
    out = []
    for i, (cue, row) in enumerate(zip(phones, rows, strict=True)):
        if row.hold:
            end = cue.start_s + row.hold_to * cue.length_s
            noise_before = i > 0 and rows[i - 1].kind in NOISY
            noise_after = i + 1 < len(rows) and rows[i + 1].kind in NOISY
            room = CLOSE_SHARE * phones[i - 1].length_s if i and not noise_before else CLOSE_S * (i == 0)
            vowel_before = i > 1 and _is_squeezed(row, phones[i - 1], rows[i - 1], rows[i - 2])
            vowel_after = i + 2 < len(rows) and _is_squeezed(row, phones[i + 1], rows[i + 1], rows[i + 2])
            out.append(
                Hold(
                    start_s=cue.start_s + row.hold_from * cue.length_s,
                    end_s=end,
                    channel=row.hold,
                    rise_s=min(CLOSE_S, max(LEAST_CLOSE_S, room)),
                    spare_s=cue.end_s - end,
                    leave=(noise_before or vowel_before, noise_after or vowel_after),
                )
            )
    return out


def merge(holds: Sequence[Hold]) -> list[Hold]:
    """Neighbours of one kind with no time for a sound between them (``stop, me``) made one."""
    out: list[Hold] = []
    for hold in holds:
        if out and out[-1].channel == hold.channel and hold.start_s - out[-1].end_s < MERGE_S:
            out[-1] = replace(
                out[-1],
                end_s=max(out[-1].end_s, hold.end_s),
                spare_s=hold.spare_s,
                leave=(out[-1].leave[0], hold.leave[1]),
            )
        else:
            out.append(hold)
    return out


def lengthen(holds: Sequence[Hold], least_s: float = LEAST_S) -> list[Hold]:
    """The holds made long enough, about the middle of their phones, so that the frame nearest to it has them.

    What must not be shortened beside a hold is left alone: a short one grows into its own phone, then to the other
    side, and is held about the middle for half of that time at least, a frame at 24 fps.
    """
    out = []
    for hold in holds:
        before, after = hold.leave
        middle = 0.5 * (hold.start_s + hold.end_s + hold.spare_s)
        start, end, about = hold.start_s, hold.end_s, 0.5 * least_s
        if before != after:
            missing = max(0.0, least_s - hold.length_s)
            own = min(missing, hold.spare_s)
            start, end, about = start - (missing - own) * after, end + own + (missing - own) * before, 0.25 * least_s
        start, end = min(start, middle - about), max(end, middle + about)
        out.append(replace(hold, start_s=max(0.0, start), end_s=end - min(0.0, start)))
    return out


def spread_out(holds: Sequence[Hold], least_s: float = LEAST_S) -> list[Hold]:
    """The holds moved apart where they overlap: long ones give way first, then all move as little as they can.

    The moves are the least-squares ones (isotonic regression by pooling neighbours).
    """
    if not holds:
        return []
    trimmed = list(holds)
    for i in range(len(trimmed) - 1):
        first, second = trimmed[i], trimmed[i + 1]
        lack = first.end_s + _gap(first, second) - second.start_s
        if lack > 0.0:
            spare = (
                max(0.0, first.length_s - least_s),
                max(0.0, second.length_s - least_s),
            )
            total = spare[0] + spare[1]
            share = min(1.0, lack / total) if total > 0.0 else 0.0
            trimmed[i] = replace(first, end_s=first.end_s - share * spare[0])
            trimmed[i + 1] = replace(second, start_s=second.start_s + share * spare[1])
    offsets = [0.0]
    for first, second in pairwise(trimmed):
        offsets.append(offsets[-1] + first.length_s + _gap(first, second))
    fitted = _pool([hold.start_s - offset for hold, offset in zip(trimmed, offsets, strict=True)])
    starts = [max(0.0, place) + offset for place, offset in zip(fitted, offsets, strict=True)]
    return [
        hold if abs(start - hold.start_s) < 1e-9 else replace(hold, start_s=start, end_s=start + hold.length_s)
        for hold, start in zip(trimmed, starts, strict=True)
    ]


def ease(holds: Sequence[Hold]) -> tuple[Hold, ...]:
    """The holds with slopes short enough that the lips part between two of them, and open faster than they close."""
    out = list(holds)
    for i, hold in enumerate(out):
        before = hold.start_s - out[i - 1].end_s if i else np.inf
        after = out[i + 1].start_s - hold.end_s if i + 1 < len(out) else np.inf
        rise = min(hold.rise_s, 0.4 * before)
        out[i] = replace(hold, rise_s=rise, fall_s=min(hold.fall_s, FASTER * rise, 0.3 * after))
    return tuple(out)


def evaluate(holds: Sequence[Hold], channel: str, times_s: Floats) -> Floats:
    """(N,) value of a held channel at sorted times: exactly 1 on every plateau, slopes that are steepest beside it."""
    value = np.zeros(len(times_s))
    for hold in holds:
        if hold.channel == channel:
            low, high = np.searchsorted(times_s, [hold.start_s - hold.rise_s, hold.end_s + hold.fall_s])
            t = times_s[low : high + 1]
            rise = np.clip((t - (hold.start_s - hold.rise_s)) / hold.rise_s, 0.0, 1.0)
            fall = np.clip(((hold.end_s + hold.fall_s) - t) / hold.fall_s, 0.0, 1.0)
            shape = np.where(t < hold.start_s, rise * rise, np.where(t > hold.end_s, fall * fall, 1.0))
            value[low : high + 1] = np.maximum(value[low : high + 1], shape)
    return value


def nearness(holds: Sequence[Hold], channel: str, times_s: Floats) -> Floats:
    """(N,) how near a hold is at sorted times: 1 on it, smoothly down to 0 where it is ``NEAR_S`` away."""
    value = np.zeros(len(times_s))
    for hold in holds:
        if hold.channel == channel:
            low, high = np.searchsorted(times_s, [hold.start_s - NEAR_S, hold.end_s + NEAR_S])
            t = times_s[low : high + 1]
            away = np.maximum(0.0, np.maximum(hold.start_s - t, t - hold.end_s))
            value[low : high + 1] = np.maximum(value[low : high + 1], exact.smoothstep(1.0 - away / NEAR_S))
    return value


def _is_squeezed(closure: PhoneTarget, cue: Cue, row: PhoneTarget, other: PhoneTarget) -> bool:
    """Whether a phone is a short vowel between a closure and another hold."""
    return closure.hold == "closure" and row.is_vowel and cue.length_s < SHORT_VOWEL_S and bool(other.hold)


def _gap(first: Hold, second: Hold) -> float:
    return SAME_GAP_S if first.channel == second.channel else OTHER_GAP_S


def _pool(places: Sequence[float]) -> list[float]:
    """The nearest never-falling numbers, by least squares; numbers in order stay what they are."""
    blocks: list[tuple[float, int]] = []
    for place in places:
        total, count = place, 1
        while blocks and blocks[-1][0] / blocks[-1][1] > total / count:
            earlier, more = blocks.pop()
            total, count = earlier + total, more + count
        blocks.append((total, count))
    out: list[float] = []
    for total, count in blocks:
        out += [total / count] * count
    return out
