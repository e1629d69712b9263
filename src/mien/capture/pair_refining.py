"""The two cameras and the points of a pair that fit all that is known best, and how well they are known."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError
from mien.core.mesh import Ints, Points

from .pair_clicks import FRONT, SIDE, Clicks
from .pair_surface import guess_surface
from .pair_views import COUNT, NEARNESS, PITCH, RIGHTWARDS, ROLL, SCALE, YAW, View

Floats = NDArray[np.float64]

FLIP = np.array([-1.0, 1.0, 1.0])
"""Mirrors a place about the symmetry plane."""

MIDLINE_M, TWINS_M = 0.001, 0.0015
"""How far a midline point lies from the symmetry plane, and the mirror image of a point from its twin, in each
direction: standard deviations over faces. Source: Ercan et al. 2008, Kramer et al. 2023 and others find mean
asymmetries of 0.5 to 1.5 mm by landmark."""

DISTANCE_M, DISTANCE_SIGMA = 1.7, 0.7
"""Where portraits are taken from: 0.85 to 3.4 m for two thirds of them, as the deviation of its ln."""

TURN_RAD = math.radians(10.0)
"""Standard deviation of turns that the pair itself tells well."""

SAME_LENS = 0.01
"""Share by which the focal length of one lens differs between two photographs (focusing)."""

LENGTH = 1e-4
"""Share of the told length by which it may be missed: it sets the scale, so it is taken for exact."""

PARALLEL = {True: [[ROLL, RIGHTWARDS, RIGHTWARDS + 1, SCALE], [SCALE]]}
FREE = PARALLEL | {False: [list(range(COUNT)), [PITCH, YAW, SCALE, NEARNESS]]}
"""Parameters that are solved for, of front and side, by whether the views are orthographic. The others of the side view
are the frame of the head: up is up in the side photograph, and the origin is in the middle of its points."""

STEPS = 100
SETTLED = 1e-5
"""Share of χ² that a step still gains: along the valley of what is barely told, a few hundredths of a deviation."""


@dataclass(frozen=True)
class Known:
    """What is known besides clicks.

    Attributes:
        ends: numbers of the two points of the told length, and whether the mirror image is meant of each.
        length_m: between them.
        tape_m: by view, the distance from the lens to the nearest point, and its standard deviation.
        same_lens: both photographs were taken with one lens.
        turn_rad: standard deviation of how far the side photograph is turned from exact profile.
        orthographic: without perspective.
    """

    ends: tuple[tuple[int, bool], tuple[int, bool]]
    length_m: float
    tape_m: dict[int, tuple[float, float]]
    same_lens: bool
    turn_rad: float
    orthographic: bool


@dataclass(frozen=True, eq=False)
class Fit:
    """Cameras and points of a pair.

    Attributes:
        views: front and side.
        places: (N, 3) m.
        covariance: of the free parameters of the views, then of x, y, z of each point.
        residuals: (2, N, 2) px, seen less solved; NaN where nothing is seen.
        statistics: (2, N) χ² of leaving a click out.
        chi2, redundancy: of all clicks.
    """

    views: tuple[View, View]
    places: Points
    covariance: Floats
    residuals: Points
    statistics: Points
    chi2: float
    redundancy: float

    def of_point(self, number: int) -> Points:
        """(3, 3) m², covariance of a point."""
        first = self.covariance.shape[0] - 3 * (len(self.places) - number)
        return self.covariance[first : first + 3, first : first + 3]


def refine(clicks: Clicks, known: Known, front: View, side: View, places: Points) -> Fit:
    """The most likely cameras and points, from rough ones.

    Raises:
        MienError: the search goes nowhere.
    """
    views = (front, side)
    for _ in range(2):  # guessed depths follow the points that they are guessed from
        guesses = _guess(clicks, places)
        views, places = _descend(clicks, known, views, places, guesses)
    return _judged(clicks, known, views, places, guesses)


def side_turn(view: View) -> float:
    """Rad, how far the camera of a side view stands before (positive) or behind the exact profile."""
    towards = view.towards()
    return math.atan2(towards[2], -view.base[2, 0] * towards[0])


def deviation(fit: Fit, known: Known, view: int, parameter: int) -> float:
    """Standard deviation of a parameter that was solved for."""
    column = list(_columns(known)).index((view, parameter))
    return math.sqrt(float(fit.covariance[column, column]))


Guesses = tuple[Ints, Ints, Floats, Floats]
"""Points, axes, m and standard deviations: what no photograph tells."""


def _guess(clicks: Clicks, places: Points) -> Guesses:
    """Depths of points seen from the front only, and distances from the symmetry plane of those from the side only."""
    missing = clicks.missing
    whole = places[missing < 0]
    parts: list[Guesses] = []
    for axis, across in ((2, [0, 1]), (0, [1, 2])):
        wanted = np.flatnonzero(missing == axis)
        if not len(wanted):
            continue
        outwards = np.where(_on_left(clicks, wanted, places), 1.0, -1.0) if axis == 0 else np.ones(len(wanted))
        heights = np.abs(whole[:, axis]) if axis == 0 else whole[:, axis]
        value, sigma = guess_surface(whole[:, across], heights, places[wanted][:, across], even=axis == 2)
        value = np.maximum(value, 0.0) if axis == 0 else value
        parts.append((wanted, np.full(len(wanted), axis), outwards * value, sigma))
    if not parts:
        nothing = np.zeros(0)
        return nothing.astype(np.int64), nothing.astype(np.int64), nothing, nothing
    points, axes, values, sigmas = (np.concatenate(part) for part in zip(*parts, strict=True))
    return points, axes, values, sigmas


def _on_left(clicks: Clicks, wanted: Ints, places: Points) -> NDArray[np.bool_]:
    """Which of some points lie on the face's left: by their twin, else where those seen in both photographs lie."""
    usual = (
        bool(np.median(places[clicks.double & ~clicks.midline, 0]) > 0)
        if (clicks.double & ~clicks.midline).any()
        else True
    )
    left = np.full(len(clicks.names), usual)
    left[clicks.twins[:, 0]], left[clicks.twins[:, 1]] = True, False
    return left[wanted]


def _columns(known: Known) -> Iterator[tuple[int, int]]:
    for view in (FRONT, SIDE):
        for parameter in FREE[known.orthographic][view]:
            yield view, parameter


def _rows(
    clicks: Clicks, known: Known, views: tuple[View, View], places: Points, guesses: Guesses
) -> tuple[Floats, Floats]:
    """Residuals (R,) in standard deviations and their slopes (R, U), those of clicks first, then all else."""
    columns = list(_columns(known))
    count, size = len(columns), len(columns) + 3 * len(places)
    ahead: list[tuple[Floats, Floats]] = []
    for number, view in enumerate(views):
        there = np.flatnonzero(clicks.visible[number])
        sigma = clicks.sigma[number, there, None]
        off = (view.seen(places[there]) - clicks.seen[number, there]) / sigma
        slopes = np.zeros((len(there), 2, size))
        for column, (of, parameter) in enumerate(columns):
            if of == number:
                slopes[:, :, column] = _slope(view, parameter, lambda each: each.seen(places[there])) / sigma  # noqa: B023
        at = count + 3 * there[:, None] + np.arange(3)
        np.put_along_axis(
            slopes,
            np.broadcast_to(at[:, None], (len(there), 2, 3)),
            view.slopes(places[there]) / sigma[..., None],
            axis=2,
        )
        ahead.append((off.reshape(-1), slopes.reshape(-1, size)))
    ahead.extend(_symmetry(clicks, places, count, size))
    points, axes, values, sigmas = guesses
    slopes = np.zeros((len(points), size))
    slopes[np.arange(len(points)), count + 3 * points + axes] = 1.0 / sigmas
    ahead.append(((places[points, axes] - values) / sigmas, slopes))
    ahead.append(_told_length(known, places, count, size))
    beliefs = _beliefs(known, views, places)
    slopes = np.zeros((len(beliefs), size))
    for column, (of, parameter) in enumerate(columns):

        def believe(each: View, of: int = of) -> Floats:
            return _beliefs(known, (each, views[SIDE]) if of == FRONT else (views[FRONT], each), places)

        slopes[:, column] = _slope(views[of], parameter, believe)
    ahead.append((beliefs, slopes))
    return np.concatenate([row for row, _ in ahead]), np.concatenate([row for _, row in ahead])


def _slope(view: View, parameter: int, of: Callable[[View], Floats]) -> Floats:
    """How a function of a view changes with one of its parameters."""
    step = 1e-3 if RIGHTWARDS <= parameter < SCALE else 1e-6
    up, down = view.values.copy(), view.values.copy()
    up[parameter] += step
    down[parameter] -= step
    return (of(replace(view, values=up)) - of(replace(view, values=down))) / (2.0 * step)


def _symmetry(clicks: Clicks, places: Points, count: int, size: int) -> Iterator[tuple[Floats, Floats]]:
    midline = np.flatnonzero(clicks.midline)
    slopes = np.zeros((len(midline), size))
    slopes[np.arange(len(midline)), count + 3 * midline] = 1.0 / MIDLINE_M
    yield places[midline, 0] / MIDLINE_M, slopes
    left, right = clicks.twins.T
    slopes = np.zeros((len(left), 3, size))
    for axis in range(3):
        slopes[np.arange(len(left)), axis, count + 3 * left + axis] = 1.0 / TWINS_M
        slopes[np.arange(len(left)), axis, count + 3 * right + axis] = -FLIP[axis] / TWINS_M
    yield ((places[left] - places[right] * FLIP) / TWINS_M).reshape(-1), slopes.reshape(-1, size)


def _told_length(known: Known, places: Points, count: int, size: int) -> tuple[Floats, Floats]:
    flips = [FLIP if mirrored else np.ones(3) for _, mirrored in known.ends]
    (one, _), (other, _) = known.ends
    between = apart(known, places)
    length = float(np.linalg.norm(between))
    slopes = np.zeros((1, size))
    slopes[0, count + 3 * one : count + 3 * one + 3] += between / length * flips[0]
    slopes[0, count + 3 * other : count + 3 * other + 3] -= between / length * flips[1]
    sigma = LENGTH * known.length_m
    return np.array([(length - known.length_m) / sigma]), slopes / sigma


def _beliefs(known: Known, views: tuple[View, View], places: Points) -> Floats:
    """What is known of the cameras beforehand, (B,) standard deviations."""
    front, side = views
    rows = [front.values[ROLL] / TURN_RAD]
    if known.orthographic:
        return np.array(rows)
    ahead, across = front.towards(), side.towards()
    rows += [math.atan2(ahead[0], ahead[2]) / TURN_RAD, math.atan2(ahead[1], ahead[2]) / TURN_RAD]
    rows += [side_turn(side) / known.turn_rad, math.atan2(across[1], abs(across[0])) / TURN_RAD]
    for number, view in enumerate(views):
        rows.append((view.values[NEARNESS] + math.log(DISTANCE_M)) / DISTANCE_SIGMA)
        if number in known.tape_m:
            tape, sigma = known.tape_m[number]
            rows.append((view.nearness * (tape - view.depths(places).min()) - 1.0) * tape / sigma)
    if known.same_lens:
        rows.append(
            (front.values[SCALE] - side.values[SCALE] - front.values[NEARNESS] + side.values[NEARNESS]) / SAME_LENS
        )
    return np.array(rows)


def _descend(
    clicks: Clicks, known: Known, views: tuple[View, View], places: Points, guesses: Guesses
) -> tuple[tuple[View, View], Points]:
    """Cameras and places at the least sum of squares.

    Source: Levenberg 1944, Marquardt 1963.
    """
    columns = list(_columns(known))
    damping, (off, slopes) = 1e-4, _rows(clicks, known, views, places, guesses)
    for _ in range(STEPS):
        square, ahead = slopes.T @ slopes, slopes.T @ off
        while True:
            change = -np.linalg.solve(square + damping * np.diag(np.diag(square)), ahead).astype(np.float64)
            tried, moved = _moved(known, views, places, columns, change)
            now = _rows(clicks, known, tried, moved, guesses)
            if float(now[0] @ now[0]) <= float(off @ off):
                break
            damping *= 8.0
            if damping > 1e12:
                return views, places
        gain = float(off @ off) - float(now[0] @ now[0])
        views, places, damping, (off, slopes) = tried, moved, max(damping / 10.0, 1e-12), now
        if gain < SETTLED * (1.0 + float(off @ off)):
            return views, places
    raise MienError(
        f"the pair of photographs does not settle within {STEPS} steps — are names exchanged, or the photographs not "
        "one from the front and one from the side?"
    )


def _moved(
    known: Known, views: tuple[View, View], places: Points, columns: list[tuple[int, int]], change: Floats
) -> tuple[tuple[View, View], Points]:
    """Cameras and places after a step, and then as large as the told length wants, which alters no picture."""
    places = places + change[len(columns) :].reshape(-1, 3)
    growth = known.length_m / max(float(np.linalg.norm(apart(known, places))), 1e-9)
    values = [view.values.copy() for view in views]
    for (view, parameter), step in zip(columns, change, strict=False):
        values[view][parameter] += step
    for each in values:
        each[[SCALE, NEARNESS]] -= math.log(growth)
    return (replace(views[0], values=values[0]), replace(views[1], values=values[1])), places * growth


def apart(known: Known, places: Points) -> Points:
    """(3,) m from one end of the told length to the other."""
    one, other = (places[number] * (FLIP if mirrored else 1.0) for number, mirrored in known.ends)
    return one - other


def _judged(clicks: Clicks, known: Known, views: tuple[View, View], places: Points, guesses: Guesses) -> Fit:
    off, slopes = _rows(clicks, known, views, places, guesses)
    square = slopes.T @ slopes
    norms = np.sqrt(np.diag(square))
    covariance = np.linalg.inv(square / norms / norms[:, None]) / norms / norms[:, None]
    residuals, statistics = np.full(clicks.seen.shape, np.nan), np.zeros(clicks.sigma.shape)
    row, chi2, redundancy = 0, 0.0, 0.0
    for view, point in np.argwhere(clicks.visible):
        two = slopes[row : row + 2]
        spare, axes = np.linalg.eigh(np.eye(2) - two @ covariance @ two.T)
        turned = axes.T @ off[row : row + 2]
        checked = spare > 1e-3
        residuals[view, point] = -off[row : row + 2] * clicks.sigma[view, point]
        statistics[view, point] = float(np.sum(turned[checked] ** 2 / spare[checked]))
        chi2 += float(off[row : row + 2] @ off[row : row + 2])
        redundancy += float(spare.sum())
        row += 2
    return Fit(views, places, covariance, residuals, statistics, chi2, redundancy)
