"""Parts that keep their shape, such as eyes and teeth: fitted as a whole where enough of them is seen."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError
from mien.core.mesh import Ints, Points

from .marks import Marks
from .registering import Motion, fit_motion, fit_similarity

Bools = NDArray[np.bool_]

ENOUGH = 6
"""Points of a body from which on its own place is fitted."""


def members(marks: Marks) -> Mapping[str, Ints]:
    """Body -> numbers of its points, from 0."""
    names = dict.fromkeys(body for body in marks.bodies if body)
    return {name: np.flatnonzero([body == name for body in marks.bodies]) for name in names}


def settle_bodies(places: Points, seen: Bools, marks: Marks) -> None:
    """Put each body of all phases (K, N, 3) m into one shape, that of the phase which shows most of it.

    Its shape is the model's, scaled and moved onto what is seen. In a phase that shows enough of it, it is moved onto
    that; in others it goes along with the points that it follows, or stays where it follows none.
    """
    if marks.model is None:
        return
    number = {name: k for k, name in enumerate(marks.names)}
    for points in members(marks).values():
        counts = seen[:, points].sum(axis=1)
        best = int(counts.argmax())
        shown = points[seen[best, points]] if counts[best] >= ENOUGH else points
        motion, scale = fit_similarity(marks.model[shown], places[best, shown])
        shape = motion.apply(scale * marks.model[points])
        follows = np.array([number[name] for name in marks.follows[points[0]]], dtype=np.int64)
        for phase in range(len(places)):
            places[phase, points] = _moved(shape, places, seen, points, follows, best, phase)


def _moved(shape: Points, places: Points, seen: Bools, points: Ints, follows: Ints, best: int, phase: int) -> Points:
    """The body's points in a phase."""
    there = seen[phase, points]
    if np.count_nonzero(there) >= ENOUGH:
        return fit_motion(shape[there], places[phase, points[there]]).apply(shape)
    if not len(follows) or phase == best:
        return shape
    try:
        return fit_motion(places[best, follows], places[phase, follows]).apply(shape)
    except MienError:  # what it follows is too little to turn it
        return Motion(np.eye(3), (places[phase, follows] - places[best, follows]).mean(axis=0)).apply(shape)


def fit_centre(points: Points) -> Points:
    """(3,) m, the middle of the ball that points (N, 3) m lie on, by linear least squares."""
    middle = points.mean(axis=0)
    off = points - middle
    matrix = np.column_stack([2.0 * off, np.ones(len(off))])
    found = np.linalg.lstsq(matrix, (off**2).sum(axis=1), rcond=None)[0]
    return np.asarray(middle + found[:3])
