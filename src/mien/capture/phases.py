"""From the points of several moments to the phases of one face.

Source: Parke 1972, "Data acquisition", and 1974, section 2.3: phases measured one by one, of one topology.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError, UnknownNameError
from mien.core.mesh import Ints, Points
from mien.faces.keypose.records import KeyposeTopology

from .bodies import settle_bodies
from .guessing import edges_of, quieten, spread
from .marks import Marks
from .records import Solution
from .registering import STAYING, Motion, fit_robustly, found, register

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

WORST_M = 0.003
"""A point that is known no better is guessed from its neighbours."""
LINKS = 3
"""Points that one which follows others is tied to, the nearest of those."""
LOOSE = 3.0
"""How much farther they may move apart than neighbours of one polygon."""
PLAIN_EDGE_M = 0.01
"""Length of an edge where no model tells it."""
LEAST_PLANE = 4
"""Points on the midline from which on the plane of symmetry is fitted to them."""


@dataclass(frozen=True, eq=False)
class MeasuredPhases:
    """The face in all of its phases, x to its own left, y up, z forward.

    Attributes:
        names: of the phases: of the moments they were photographed at.
        places: (K, N, 3) m.
        measured: (K, N) which of them were; the others are guessed from their neighbours.
        motions: moment -> how the world is moved into the frame of the face.
        remarks: what was guessed, a sentence each.
    """

    names: tuple[str, ...]
    places: Points
    measured: Bools
    motions: Mapping[str, Motion]
    remarks: tuple[str, ...]


def measure_phases(
    solution: Solution, topology: KeyposeTopology, marks: Marks, *, still: Sequence[str] = ()
) -> MeasuredPhases:
    """The phases that a solution of several moments shows.

    Args:
        solution: of photographs whose moments are the phases; the first moment is the face at rest.
        topology: of the face; its points are called as the marks say.
        marks: names of the points, what keeps its shape, and a model for what is hidden.
        still: names of points that do not move with expression; none to find them.

    Raises:
        UnknownNameError: a still point that the topology does not have.
        MienError: too few points of a moment were found.
    """
    for name in still:
        if name not in marks.names:
            raise UnknownNameError("still point", name, marks.names)
    moments = tuple(dict.fromkeys(photograph.moment for photograph in solution.survey.photographs))
    solved = {moment: _solved(solution, moment, marks.names) for moment in moments}
    motions = register({moment: places for moment, (places, _) in solved.items()}, marks.names, tuple(still))
    midline = np.array([number - 1 for number in topology.midline], dtype=np.int64)
    frame = _frame(solved[moments[0]][0], marks, midline)
    motions = {moment: frame.after(motion) for moment, motion in motions.items()}
    measured = np.stack([motions[moment].apply(solved[moment][0]) for moment in moments])
    sigma = np.stack([solved[moment][1] for moment in moments])
    seen = found(measured)
    _lay_on(measured, sigma, moments, marks)
    places = _completed(measured, sigma, topology, marks)
    settle_bodies(places, seen, marks)
    places[:, midline, 0] = 0.0
    return MeasuredPhases(moments, places, seen, motions, _remarks(moments, seen, marks))


def _solved(solution: Solution, moment: str, names: tuple[str, ...]) -> tuple[Points, Floats]:
    """Places (N, 3) m in the world, nan where there is none, and deviations (N,) m."""
    places, sigma = np.full((len(names), 3), np.nan), np.full(len(names), np.nan)
    for number, name in enumerate(names):
        point = solution.points.get((moment, name))
        if point is None:
            continue
        deviation = float(np.sqrt(np.trace(point.covariance) / 3.0))
        if np.isfinite(point.place).all() and deviation <= WORST_M:
            places[number], sigma[number] = point.place, deviation
    return places, sigma


def _frame(rest: Points, marks: Marks, midline: Ints) -> Motion:
    """The motion of the world into the frame of the face: onto the model, its midline onto the plane x = 0."""
    frame = STAYING
    seen = found(rest)
    if marks.model is not None:
        if np.count_nonzero(seen) < LEAST_PLANE:
            raise MienError(f"{np.count_nonzero(seen)} points of the face at rest were found, wanted all that are seen")
        frame = fit_robustly(rest[seen], marks.model[seen])
    middle = midline[seen[midline]]
    if len(middle) < LEAST_PLANE:
        return frame
    points = frame.apply(rest[middle])
    centre = np.median(points, axis=0)
    weights = np.ones(len(points))
    for _ in range(20):
        centre = (weights[:, None] * points).sum(axis=0) / weights.sum()
        normal = np.linalg.svd(np.sqrt(weights)[:, None] * (points - centre))[2][-1]
        off = np.abs((points - centre) @ normal)
        weights = 1.0 / np.maximum(off, 2e-4)
    normal = normal * (1.0 if normal[0] >= 0.0 else -1.0)
    up = np.array([0.0, 1.0, 0.0]) - normal[1] * normal
    up /= np.linalg.norm(up)
    turn = np.stack([normal, up, np.cross(normal, up)])
    return Motion(turn, -turn @ centre + np.array([0.0, *centre[1:]])).after(frame)


def _lay_on(measured: Points, sigma: Floats, moments: Sequence[str], marks: Marks) -> None:
    """Put points that were not found on those that they touch, where these were: the margin of a shut lid."""
    number = {name: k for k, name in enumerate(marks.names)}
    there = found(measured)
    for point, rows in enumerate(marks.touches):
        for moment, name in rows:
            if moment in moments:
                phase, other = moments.index(moment), number[name]
                if there[phase, other] and not there[phase, point]:
                    measured[phase, point], sigma[phase, point] = measured[phase, other], sigma[phase, other]


def _completed(measured: Points, sigma: Floats, topology: KeyposeTopology, marks: Marks) -> Points:
    """(K, N, 3) m: what was measured, and what is guessed where nothing was."""
    polygons = [tuple(number - 1 for number in polygon.points) for polygon in topology.polygons]
    edges = edges_of(polygons)
    if marks.model is None:
        base = np.tile(np.nanmean(measured[0], axis=0), (len(marks.names), 1))
        lengths = np.arange(len(base))[:, None] * np.array([PLAIN_EDGE_M, 0.0, 0.0])
        loose = np.full(len(edges), 1.0)
    else:
        base = lengths = marks.model
        links = _links(marks, base)
        loose = np.concatenate([np.ones(len(edges)), np.full(len(links), LOOSE)])
        edges = np.concatenate([edges, links])
    places = np.empty_like(measured)
    rest_sigma = sigma[0]
    places[0] = base + spread(measured[0] - base, rest_sigma, edges, lengths, loose)
    for phase in range(1, len(measured)):
        own = np.sqrt(sigma[phase] ** 2 + np.where(np.isnan(rest_sigma), 0.0, rest_sigma) ** 2)
        moves = spread(measured[phase] - places[0], own, edges, places[0], loose)
        usual = np.where(np.isnan(own), np.nanmedian(own), own)
        places[phase] = places[0] + quieten(moves, usual, edges)
    return places


def _links(marks: Marks, places: Points) -> Ints:
    """(L, 2) points and the nearest of those that they follow."""
    number = {name: k for k, name in enumerate(marks.names)}
    out = []
    for point, follows in enumerate(marks.follows):
        goals = np.array([number[name] for name in follows], dtype=np.int64)
        near = goals[np.argsort(np.linalg.norm(places[goals] - places[point], axis=1), kind="stable")[:LINKS]]
        out += [(point, int(goal)) for goal in near if goal != point]
    return np.array(out, dtype=np.int64).reshape(-1, 2)


def _remarks(moments: Sequence[str], seen: Bools, marks: Marks) -> tuple[str, ...]:
    remarks = [
        f"{moment}: {np.count_nonzero(~row)} of {len(row)} points were not measured, they are guessed from neighbours."
        for moment, row in zip(moments, seen, strict=True)
        if not row.all()
    ]
    never = [marks.names[number] for number in np.flatnonzero(~seen.max(axis=0))]
    if never:
        shown = ", ".join(never[:6]) + (", …" if len(never) > 6 else "")
        remarks.append(f"{len(never)} points were measured at no moment: {shown}")
    return tuple(remarks)
