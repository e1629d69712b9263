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
MIDDLE_M = 0.002
"""A body that comes so near to the plane of symmetry is one with its mirror image."""


def members(marks: Marks) -> Mapping[str, Ints]:
    """Body -> numbers of its points, from 0."""
    names = dict.fromkeys(body for body in marks.bodies if body)
    return {name: np.flatnonzero([body == name for body in marks.bodies]) for name in names}


def settle_bodies(places: Points, seen: Bools, marks: Marks) -> None:
    """Put each body of all phases (K, N, 3) m into one shape, that of the phase which shows most of it.

    Its shape is the model's, scaled and moved onto what is seen. In a phase that shows enough of it, it is moved onto
    that; in others it goes along with the points that it follows, and shifts onto the few of its own that are seen, or
    stays where it follows none. A body that reaches the plane of symmetry, such as a row of teeth, moves together with
    its mirror image: it neither turns nor shifts sideways.
    """
    if marks.model is None:
        return
    number = {name: k for k, name in enumerate(marks.names)}
    for points in members(marks).values():
        whole = bool(np.abs(marks.model[points, 0]).min() < MIDDLE_M)
        counts = seen[:, points].sum(axis=1)
        best = int(counts.argmax())
        shown = points[seen[best, points]] if counts[best] >= ENOUGH else points
        motion, scale = fit_similarity(_whole(marks.model[shown], whole), _whole(places[best, shown], whole))
        shape = motion.apply(scale * marks.model[points])
        follows = np.array([number[name] for name in marks.follows[points[0]]], dtype=np.int64)
        for phase in range(len(places)):
            there = seen[phase, points]
            if np.count_nonzero(there) >= ENOUGH:
                start, goal = shape[there], places[phase, points[there]]
            elif len(follows) and phase != best:
                start, goal = places[best, follows], places[phase, follows]
            else:
                start = goal = shape
            moved = _motion(_whole(start, whole), _whole(goal, whole)).apply(shape)
            if len(follows) and there.any():
                moved += _whole(places[phase, points[there]] - moved[there], whole).mean(axis=0)
            places[phase, points] = moved


def _whole(points: Points, both: bool) -> Points:
    """Points (N, 3) m, with their mirror images if there are two halves."""
    return np.concatenate([points, points * [-1.0, 1.0, 1.0]]) if both else points


def _motion(points: Points, wanted: Points) -> Motion:
    """The motion of points (N, 3) m onto others; a shift alone where they are too few or too narrow to turn."""
    try:
        return fit_motion(points, wanted)
    except MienError:
        return Motion(np.eye(3), (wanted - points).mean(axis=0))


def fit_centre(points: Points) -> Points:
    """(3,) m, the middle of the ball that points (N, 3) m lie on, by linear least squares."""
    middle = points.mean(axis=0)
    off = points - middle
    matrix = np.column_stack([2.0 * off, np.ones(len(off))])
    found = np.linalg.lstsq(matrix, (off**2).sum(axis=1), rcond=None)[0]
    return np.asarray(middle + found[:3])
