"""Phones to mouth shapes of a named set: what an animator's exposure sheet says, or a games engine plays."""

from __future__ import annotations

from collections.abc import Sequence

from mien.core import Cue

from .mouth_passes import soften_pauses, tidy
from .shapes_passes import choose, drop_short, hold, lengthen, put_between, round_early, split
from .shapes_table import SHAPE_SETS, shape_table

__all__ = ["SHAPE_SETS", "shapes_of"]


def shapes_of(phones: Sequence[Cue], name: str) -> tuple[Cue, ...]:
    """Mouth shapes from 0 s to the end of the last phone, without holes; no shape follows itself.

    Every p b m is shut and every f v tucked for a while that a film shows.

    Args:
        phones: ARPABET cues; vowels may carry a stress digit, ``SIL`` is silence and fills gaps.
        name: the set, one of ``SHAPE_SETS``.

    Raises:
        RangeError: a time is not finite or a phone ends before it starts.
        UnknownNameError: no such set, or a symbol is no phone.
    """
    table = shape_table(name)
    end_s = max((cue.end_s for cue in phones), default=0.0)
    cues = split(soften_pauses(tidy(phones)), table)
    cues = tuple(Cue(cue.start_s, min(cue.end_s, end_s), cue.symbol) for cue in cues if cue.start_s < end_s)
    shapes = round_early(cues, choose(cues, table), table)
    pieces = put_between(drop_short(lengthen(hold(cues, shapes))), table)
    return tuple(Cue(piece.start_s, piece.end_s, piece.shape) for piece in pieces)
