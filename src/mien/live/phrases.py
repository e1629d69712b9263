"""Blinks and glances of who says something: at the ends of its phrases, instead of those of idle life."""

from __future__ import annotations

from collections.abc import Sequence

from mien.core import SILENCE, Cue
from mien.gaze import blinks, saccades
from mien.gaze.blinks import PAUSE_S
from mien.perform.performance import PHRASE_LOOK_S
from mien.vocab import vocabulary

from .messages import IDLE_PARTS
from .mixing import CHANNELS
from .slices import Floats

Piece = tuple[int, int, Floats]
"""What a part of idle life does with a channel: the number of each, and (loops,) values."""


def life_beside(phones: Sequence[Cue], times: Floats, seed: int) -> tuple[Piece, ...]:
    """What the parts ``blinks`` and ``saccades`` do while some phones are said; each is at rest at the end.

    Args:
        phones: what is said, silences included.
        times: (loops,) s.
        seed: of what chance decides.

    Source: as in ``mien.perform``: blinks are drawn to pauses, and the eyes are on the listener before a phrase ends.
    """
    length_s = phones[-1].end_s
    ends_s = [cue.start_s for cue in phones if cue.symbol == SILENCE and cue.length_s >= PAUSE_S and cue.start_s > 0.0]
    rests = [(max(0.0, end_s - PHRASE_LOOK_S), end_s) for end_s in ends_s]
    lives = {"blinks": blinks(length_s, seed, phones), "saccades": saccades(length_s, seed, phones, rests)}
    index = vocabulary(CHANNELS).index
    return tuple(
        (IDLE_PARTS.index(part), index[channel], track.evaluate(times)[0] * (times < length_s))
        for part, tracks in lives.items()
        for channel, track in tracks.items()
    )
