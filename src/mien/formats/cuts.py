"""A film that cuts from one face to another while the sound goes on."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from mien.core import Face, Pose
from mien.timeline import Timeline
from mien.timeline.rates import time_of


@dataclass(frozen=True, eq=False)
class Cut:
    """From ``start_s`` on, seconds, a face is seen that plays a timeline; its moments are those of the film."""

    start_s: float
    timeline: Timeline
    face: Face


def cut_poses(cuts: Sequence[Cut], count: int, rate: Fraction) -> Iterator[tuple[Face, Pose]]:
    """The face that each of ``count`` frames shows, with its pose; before the first cut that of the first."""
    takes = {id(cut.timeline): cut.timeline.poses(cut.face.parameters, rate) for cut in cuts}
    starts = [cut.start_s for cut in cuts]
    for frame in range(count):
        # All go on, seen or not, because a timeline is evaluated many frames at a time.
        poses = {key: next(take) for key, take in takes.items()}
        cut = cuts[max(0, bisect_right(starts, time_of(float(frame), rate) + 1e-9) - 1)]
        yield cut.face, poses[id(cut.timeline)]
