"""Which cues are on which frame, so that none is lost between two of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

from mien.core import Cue
from mien.timeline import Timeline

from .cue_shapes import ShapeSet

_NEAR = 1e-6
"""Of a frame: by which a cue may begin after its moment and still be on it, for times that were rounded."""


def count_frames(length_s: float, rate: Fraction) -> int:
    """Number of frames of a recording; at least one."""
    return Timeline((), length_s).frame_count(rate)


def place_cues(cues: Sequence[Cue], length_s: float, rate: Fraction) -> tuple[tuple[Cue, ...], ...]:
    """The cues of each frame, in order: those that last at its moment, k / fps, and those that no frame is nearer to.

    A cue that falls between two frames is so on the one nearest to its middle, beside what else is there.

    Source: Parke 1974, section 4.3, has the problem: lip motions that last only a frame or two.
    """
    placed: list[list[Cue]] = [[] for _ in range(count_frames(length_s, rate))]
    for cue in cues:
        first, last = (math.ceil(time_s * float(rate) - _NEAR) for time_s in (cue.start_s, cue.end_s))
        if first == last:
            first = round(cue.centre_s * float(rate))
        for frame in range(first, max(last, first + 1)):
            placed[min(frame, len(placed) - 1)].append(cue)
    return tuple(map(tuple, placed))


def choose_shapes(shapes: Sequence[Cue], length_s: float, rate: Fraction, names: ShapeSet) -> tuple[str, ...]:
    """The shape of each frame: the one at its moment, but shut and tucked lips win; the one of rest in gaps."""

    def choose(there: Sequence[Cue]) -> str:
        sealed = [cue for cue in there if names.is_sealed(cue.symbol)]
        return max(sealed or there, key=lambda cue: cue.length_s).symbol if there else names.rest

    return tuple(map(choose, place_cues(shapes, length_s, rate)))
