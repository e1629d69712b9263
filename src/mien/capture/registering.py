"""Moments brought onto one another by what does not move between them, so that a head does not swim."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError
from mien.core.mesh import Points

Bools = NDArray[np.bool_]

LEAST_POINTS = 3
STEPS = 60
STILL_SHARE = 0.5
"""At least this share of the points is taken to be still where nobody says which are."""
SETTLED_M = 1e-7
LEAST_SCALE_M = 2e-5
TUKEY = 4.685
"""How many deviations off a point may be before it counts nothing. Source: Beaton and Tukey 1974."""
DEVIATION_OF_MEDIAN = 1.538
"""The median length of a three-dimensional normal error over its deviation along an axis."""


@dataclass(frozen=True, eq=False)
class Motion:
    """A rigid motion.

    Attributes:
        turn: (3, 3).
        shift: (3,) m, added after the turn.
    """

    turn: Points
    shift: Points

    def apply(self, points: Points) -> Points:
        """Points (N, 3) m moved."""
        return np.asarray(points @ self.turn.T + self.shift)

    def after(self, first: Motion) -> Motion:
        """This motion following another one."""
        return Motion(self.turn @ first.turn, self.turn @ first.shift + self.shift)


STAYING = Motion(np.eye(3), np.zeros(3))


def found(points: Points) -> Bools:
    """(…, N) which of points (…, N, 3) were found: the others are nan."""
    return np.asarray(np.isfinite(points).all(axis=-1))


def fit_motion(points: Points, wanted: Points, weights: NDArray[np.float64] | None = None) -> Motion:
    """The rigid motion that brings points (N, 3) m nearest to others, by weighted squares.

    Source: Umeyama 1991, "Least-squares estimation of transformation parameters", without its scale.

    Raises:
        MienError: fewer than three points, or all on a line.
    """
    weight = np.ones(len(points)) if weights is None else weights
    if np.count_nonzero(weight) < LEAST_POINTS:
        raise MienError(f"{np.count_nonzero(weight)} points hold no body — want at least {LEAST_POINTS}")
    share = (weight / weight.sum())[:, None]
    middle, goal = (share * points).sum(axis=0), (share * wanted).sum(axis=0)
    u, size, vt = np.linalg.svd((share * (wanted - goal)).T @ (points - middle))
    if size[1] <= 1e-9 * size[0]:
        raise MienError(f"{len(points)} points on a line leave a turn about it free — want one beside it")
    turn = (u * [1.0, 1.0, np.sign(np.linalg.det(u @ vt))]) @ vt
    return Motion(turn, goal - turn @ middle)


def register(moments: Mapping[str, Points], names: tuple[str, ...], still: tuple[str, ...] = ()) -> dict[str, Motion]:
    """Moment -> motion that brings it onto the first one.

    Args:
        moments: name -> (N, 3) m, nan where a point was not found; the first is what all others are brought onto.
        names: of the N points.
        still: names of points that do not move with expression; where none are told they are found: those that move
            together while others go their own ways.

    Raises:
        MienError: too few of the still points are seen in a moment.
    """
    first = next(iter(moments.values()))
    chosen = np.isin(names, still) if still else np.ones(len(names), dtype=bool)
    rest = next(iter(moments))
    out = {rest: STAYING}
    for moment, points in moments.items():
        if moment == rest:
            continue
        both = chosen & found(first) & found(points)
        if np.count_nonzero(both) < LEAST_POINTS:
            kind = "still points" if still else "points"
            raise MienError(
                f"moment {moment!r} has {np.count_nonzero(both)} {kind} that are also seen in {rest!r}, wanted at "
                f"least {LEAST_POINTS} — click more that do not move with expression: corners of the eyes, root of "
                "the nose, before the ears"
            )
        out[moment] = fit_robustly(points[both], first[both])
    return out


def fit_robustly(points: Points, wanted: Points) -> Motion:
    """The rigid motion of most points (N, 3) m; those that go their own ways count nothing.

    The scale of what is still noise falls from that of all to that of the nearest half, so that the start matters
    little. Source: Beaton and Tukey 1974 (biweight); Rousseeuw and Leroy 1987 (the nearest half).
    """
    weights = np.ones(len(points))
    motion = fit_motion(points, wanted)
    for _ in range(STEPS):
        away = np.linalg.norm(motion.apply(points) - wanted, axis=1)
        scale = max(float(np.quantile(away, STILL_SHARE)) / DEVIATION_OF_MEDIAN, LEAST_SCALE_M)
        # The nearest points always count, so that three of them are left.
        weights = np.maximum(1.0 - (away / (TUKEY * scale)) ** 2, 0.0) ** 2
        found = fit_motion(points, wanted, weights)
        moved = float(np.abs(found.apply(points) - motion.apply(points)).max())
        motion = found
        if moved < SETTLED_M:
            break
    return motion


def fit_similarity(points: Points, wanted: Points) -> tuple[Motion, float]:
    """The motion and the scale, about the origin and before the motion, that bring points (N, 3) m onto others.

    Source: Umeyama 1991, equations 40 to 42.
    """
    motion = fit_motion(points, wanted)
    centred = points - points.mean(axis=0)
    goal = wanted - wanted.mean(axis=0)
    scale = float((goal * (centred @ motion.turn.T)).sum() / (centred**2).sum())
    return Motion(motion.turn, wanted.mean(axis=0) - scale * motion.turn @ points.mean(axis=0)), scale
