"""Passes over the list of phones before it is blended; each takes cues and gives cues."""

from __future__ import annotations

import math
from collections.abc import Iterable

from mien.core import SILENCE, Cue, RangeError

from .mouth_table import bare, phone_table

HOLD_PAUSE_S = 0.12
RELAX_PAUSE_S = 0.35
FIRST_TARGET_SHARE = 0.6
RELEASE_S = 0.45
"""Time that the mouth takes to come to rest after the last phone."""


def tidy(phones: Iterable[Cue]) -> tuple[Cue, ...]:
    """The phones in order, without overlaps or gaps, from 0 s on, with silence at the end.

    Raises:
        RangeError: a time is not finite or a phone ends before it starts.
        UnknownNameError: a symbol is no phone.
    """
    table = phone_table()
    out: list[Cue] = []
    time = 0.0
    for cue in sorted(phones):
        if not (math.isfinite(cue.start_s) and math.isfinite(cue.end_s) and cue.start_s <= cue.end_s):
            raise RangeError(
                f"phone {cue.symbol!r} goes from {cue.start_s} to {cue.end_s} s — it must end after it starts"
            )
        table[cue.symbol]
        start, end = max(cue.start_s, time), cue.end_s
        if start > time + 1e-9:
            out.append(Cue(time, start, SILENCE))
        if end > start:
            out.append(Cue(start, end, cue.symbol))
            time = end
    if not out or out[-1].symbol != SILENCE or out[-1].length_s < RELEASE_S:
        out.append(Cue(time, time + RELEASE_S, SILENCE))
    return join_silences(out)


def join_silences(phones: Iterable[Cue]) -> tuple[Cue, ...]:
    """The phones with neighbouring silences made one."""
    out: list[Cue] = []
    for cue in phones:
        if out and cue.symbol == SILENCE == out[-1].symbol:
            out[-1] = Cue(out[-1].start_s, cue.end_s, SILENCE)
        else:
            out.append(cue)
    return tuple(out)


def soften_pauses(phones: Iterable[Cue], amount: float = 1.0) -> tuple[Cue, ...]:
    """The phones with short pauses marked: under 120 ms the mouth holds, up to 350 ms it relaxes partly.

    Before the first phone and after the last the mouth rests, however short that is.

    Args:
        phones: tidy ones.
        amount: the two lengths are multiplied by it.

    Source: Edwards et al. 2016 (JALI), section 4; the lengths are our choice.
    """
    cues = tuple(phones)
    ends = (0, len(cues) - 1)
    return tuple(
        Cue(cue.start_s, cue.end_s, _pause(cue.length_s, amount)) if cue.symbol == SILENCE and i not in ends else cue
        for i, cue in enumerate(cues)
    )


def _pause(length_s: float, amount: float) -> str:
    if length_s < amount * HOLD_PAUSE_S:
        return "SIL-hold"
    return "SIL-relax" if length_s <= amount * RELAX_PAUSE_S else SILENCE


def split_diphthongs(phones: Iterable[Cue]) -> tuple[Cue, ...]:
    """The phones with each diphthong as two: 60 % of its time for the first target, 40 % for the second.

    Source: Rhubarb Lip Sync's timing rule.
    """
    table = phone_table()
    out: list[Cue] = []
    for cue in phones:
        if bare(cue.symbol) + "+" in table.index:
            middle = cue.start_s + FIRST_TARGET_SHARE * cue.length_s
            out += [Cue(cue.start_s, middle, cue.symbol), Cue(middle, cue.end_s, cue.symbol + "+")]
        else:
            out.append(cue)
    return tuple(out)
