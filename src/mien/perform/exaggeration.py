"""A pose or a performance, louder or softer."""

from __future__ import annotations

from dataclasses import replace
from typing import overload

from mien.core import Pose, exaggeration
from mien.timeline import exaggerate_timeline

from .performance import Performance


@overload
def exaggerate(subject: Pose, amount: float) -> Pose: ...
@overload
def exaggerate(subject: Performance, amount: float) -> Performance: ...
def exaggerate(subject: Pose | Performance, amount: float) -> Pose | Performance:
    """A pose or a performance with all that expresses something ``amount`` times as far from rest, 0..3.

    Values keep their order and their ranges, what is shut stays shut, and the eyes look where they looked.

    Raises:
        RangeError: there is no such amount.
    """
    if isinstance(subject, Pose):
        return exaggeration.exaggerate(subject, amount)
    return replace(subject, timeline=exaggerate_timeline(subject.timeline, subject.face.parameters, amount))
