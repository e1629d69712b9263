"""Joint refinement of lenses, places, boards and points by least squares.

Points are eliminated block by block (each is tied to cameras only, never to another point), so that the equations to
solve are as many as the cameras ask for, however many points there are.

Source: Brown 1976, "The bundle method"; Triggs, McLauchlan, Hartley and Fitzgibbon 2000, "Bundle adjustment: a modern
synthesis", section 6; damping after Marquardt 1963.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mien.capture.networks import Bools, Network, State
from mien.capture.projecting import LENS_TERMS, see_slopes, turn, turn_slopes
from mien.core.errors import MienError
from mien.core.mesh import Ints, Points

ROUNDS = 100
BLOCK = LENS_TERMS + 6 + 6
"""Columns that one observation touches: its lens, its station, its body."""


@dataclass(frozen=True, eq=False)
class Problem:
    """What is to be solved.

    Attributes:
        network: who sees whom.
        active: (N,) observations that take part.
        free_terms: (L, 8) lens terms that are let go.
        held_bodies: (B,) bodies that stay where they are: the world, and what stands for it.
        lens_means, lens_sigmas: (L, 8) what is assumed about lens terms and how surely; infinite where nothing is.
    """

    network: Network
    active: Bools
    free_terms: Bools
    held_bodies: Bools
    lens_means: Points
    lens_sigmas: Points


@dataclass(frozen=True, eq=False)
class Layout:
    """Columns of the unknowns of a problem: -1 for what is held.

    Attributes:
        lenses: (L, 8).
        stations: (S, 6), a turn and a move.
        bodies: (B, 6).
        points: (P,) number among the free points.
        columns: how many there are, without those of points.
        free_points: (F,) numbers of points.
        groups: slices of ``order`` in which all observations touch the same columns.
        order: (A,) numbers of active observations.
    """

    lenses: Ints
    stations: Ints
    bodies: Ints
    points: Ints
    columns: int
    free_points: Ints
    groups: tuple[slice, ...]
    order: Ints


@dataclass(frozen=True, eq=False)
class Equations:
    """The normal equations of a problem at a state; C columns, F free points, A active observations.

    Attributes:
        layout: of the columns.
        cost: χ², with what is assumed.
        chi2: of the observations alone.
        off: (A, 2) seen less solved, in standard deviations.
        by_columns: (A, 2, 20) how that changes with lens, station and body.
        by_point: (A, 2, 3) and with the point.
        cameras: (C, C); ties: (F, 3, C); points: (F, 3, 3); camera_right: (C,); point_right: (F, 3).
    """

    layout: Layout
    cost: float
    chi2: float
    off: Points
    by_columns: Points
    by_point: Points
    cameras: Points
    ties: Points
    points: Points
    camera_right: Points
    point_right: Points


@dataclass(frozen=True, eq=False)
class Refined:
    """A state of least χ² with its equations."""

    problem: Problem
    state: State
    equations: Equations


def lay_out(problem: Problem) -> Layout:
    """The columns of a problem: what active observations touch and is not held."""
    network, active = problem.network, problem.active
    counter = 0
    lenses = np.full((len(network.lenses), LENS_TERMS), -1, dtype=np.int64)
    stations = np.full((len(network.stations), 6), -1, dtype=np.int64)
    bodies = np.full((len(network.bodies), 6), -1, dtype=np.int64)
    for number in np.unique(network.lens_of[active]):
        for term in np.nonzero(problem.free_terms[number])[0]:
            lenses[number, term] = counter
            counter += 1
    for number in np.unique(network.station_of[active]):
        stations[number] = np.arange(counter, counter + 6)
        counter += 6
    for number in np.unique(network.body_of[active]):
        if not problem.held_bodies[number]:
            bodies[number] = np.arange(counter, counter + 6)
            counter += 6
    points = np.full(len(network.points), -1, dtype=np.int64)
    seen = np.unique(network.point_of[active])
    free_points = seen[network.loose[seen] > 0.0]
    points[free_points] = np.arange(len(free_points))
    order = np.nonzero(active)[0]
    keys = np.stack(
        [network.lens_of[order], network.station_of[order], network.body_of[order], network.photo_of[order]]
    )
    order = order[np.lexsort(keys)]
    keys = np.stack(
        [network.lens_of[order], network.station_of[order], network.body_of[order], network.photo_of[order]]
    )
    ends = np.nonzero((keys[:, 1:] != keys[:, :-1]).any(axis=0))[0] + 1
    edges = [0, *ends.tolist(), len(order)] if len(order) else [0]
    groups = tuple(slice(first, last) for first, last in pairwise(edges))
    return Layout(lenses, stations, bodies, points, counter, free_points, groups, order)


def group_columns(problem: Problem, layout: Layout, group: slice) -> Ints:
    """(20,) columns that the observations of a group touch."""
    network, first = problem.network, layout.order[group.start]
    return np.concatenate(
        [
            layout.lenses[network.lens_of[first]],
            layout.stations[network.station_of[first]],
            layout.bodies[network.body_of[first]],
        ]
    )


def differ(problem: Problem, state: State, layout: Layout) -> tuple[Points, Points, Points, Points] | None:
    """What is off (A, 2) and its slopes by columns (A, 2, 20) and point (A, 2, 3), in standard deviations, and weights.

    None where a point lies behind a camera that sees it.
    """
    network, order = problem.network, layout.order
    station, body, point = network.station_of[order], network.body_of[order], network.point_of[order]
    turned = np.einsum("nij,nj->ni", state.body_rotations[body], state.points[point])
    rotations = state.rotations[station]
    frame = np.einsum("nij,nj->ni", rotations, turned + state.body_places[body] - state.places[station])
    if not (frame[:, 2] > 1e-12).all():
        return None
    seen, by_lens, by_frame = see_slopes(state.lenses[network.lens_of[order]], frame)
    inverse = 1.0 / network.sigmas[order]
    by_frame *= inverse[:, None, None]
    by_world = by_frame @ rotations
    by_columns = np.concatenate(
        [
            by_lens * inverse[:, None, None],
            turn_slopes(frame, by_frame),
            -by_world,
            turn_slopes(turned, by_world),
            by_world,
        ],
        axis=2,
    )
    off = (network.pictures[order] - seen) * inverse[:, None]
    return off, by_columns, by_world @ state.body_rotations[body], inverse


def cost_of(problem: Problem, state: State, layout: Layout) -> float:
    """χ² of a state with what is assumed; infinite where a point lies behind a camera, or a lens is none."""
    if not (state.lenses[np.unique(problem.network.lens_of[layout.order]), 0] > 0.0).all():
        return np.inf
    with np.errstate(over="ignore", invalid="ignore"):
        found = differ(problem, state, layout)
        if found is None:
            return np.inf
        cost = float((found[0] ** 2).sum()) + _assumed_cost(problem, state, layout)
    return cost if np.isfinite(cost) else np.inf


def _loose_points(problem: Problem, layout: Layout) -> Ints:
    """Numbers of free points that are references of a standard deviation."""
    return layout.free_points[np.isfinite(problem.network.loose[layout.free_points])]


def _assumed_cost(problem: Problem, state: State, layout: Layout) -> float:
    network = problem.network
    free = layout.lenses >= 0
    lens = (((state.lenses - problem.lens_means) / problem.lens_sigmas)[free] ** 2).sum()
    loose = _loose_points(problem, layout)
    off = (state.points[loose] - network.told[loose]) / network.loose[loose, None]
    return float(lens + (off * off).sum())


def equate(problem: Problem, state: State, layout: Layout) -> Equations:
    """The normal equations at a state.

    Raises:
        MienError: a point lies behind a camera that sees it.
    """
    found = differ(problem, state, layout)
    if found is None:
        raise MienError(
            "the cameras cannot be placed: a point would lie behind one that sees it"
            " — look for names of points that are exchanged, and for references measured along a mirrored axis"
        )
    off, by_columns, by_point, _ = found
    network = problem.network
    count, free = layout.columns, len(layout.free_points)
    cameras = np.zeros((count + 1, count + 1))
    camera_right = np.zeros(count + 1)
    ties = np.zeros((free, 3, count + 1))
    numbers = layout.points[network.point_of[layout.order]]
    for group in layout.groups:
        columns = group_columns(problem, layout, group)
        flat = by_columns[group].reshape(-1, BLOCK)
        # What is held lands in a row too many, which is dropped.
        np.add.at(cameras, (columns[:, None], columns[None, :]), flat.T @ flat)
        np.add.at(camera_right, columns, flat.T @ off[group].reshape(-1))
        here = numbers[group]
        inside = np.nonzero(here >= 0)[0]
        if len(inside):
            tie = np.einsum("nki,nkc->nic", by_point[group][inside], by_columns[group][inside])
            kept = columns >= 0
            ties[here[inside][:, None, None], np.arange(3)[None, :, None], columns[kept][None, None, :]] += tie[
                :, :, kept
            ]
    points, point_right = np.zeros((free, 3, 3)), np.zeros((free, 3))
    tied = np.nonzero(numbers >= 0)[0]
    np.add.at(points, numbers[tied], np.einsum("nki,nkj->nij", by_point[tied], by_point[tied]))
    np.add.at(point_right, numbers[tied], np.einsum("nki,nk->ni", by_point[tied], off[tied]))
    cameras, camera_right, ties = cameras[:count, :count], camera_right[:count], ties[:, :, :count]
    _assume(problem, state, layout, cameras, camera_right, points, point_right)
    chi2 = float((off * off).sum())
    cost = chi2 + _assumed_cost(problem, state, layout)
    return Equations(layout, cost, chi2, off, by_columns, by_point, cameras, ties, points, camera_right, point_right)


def _assume(
    problem: Problem,
    state: State,
    layout: Layout,
    cameras: Points,
    camera_right: Points,
    points: Points,
    point_right: Points,
) -> None:
    """Adds what is assumed about lenses and loose references to the equations."""
    network = problem.network
    free = layout.lenses >= 0
    weights = problem.lens_sigmas[free] ** -2.0
    columns = layout.lenses[free]
    cameras[columns, columns] += weights
    camera_right[columns] += weights * (problem.lens_means - state.lenses)[free]
    loose = _loose_points(problem, layout)
    numbers, weights = layout.points[loose], network.loose[loose] ** -2.0
    points[numbers] += weights[:, None, None] * np.eye(3)
    point_right[numbers] += weights[:, None] * (network.told[loose] - state.points[loose])


def solve_step(equations: Equations, damping: float) -> tuple[Points, Points]:
    """The step of columns (C,) and of free points (F, 3) that the damped equations ask for.

    Raises:
        numpy.linalg.LinAlgError: the equations do not tell.
    """
    from scipy.linalg import cho_factor, cho_solve

    diagonal = np.einsum("fii->fi", equations.points)
    floor = 1e-12 * diagonal.max(axis=1, keepdims=True) + 1e-300 if len(diagonal) else diagonal
    damped = equations.points + np.einsum("fi,ij->fij", damping * diagonal + floor, np.eye(3))
    inverse = np.linalg.inv(damped)
    width = equations.layout.columns
    carried = np.einsum("fij,fjc->fic", inverse, equations.ties)
    reduced = equations.cameras - equations.ties.reshape(-1, width).T @ carried.reshape(-1, width)
    reduced[np.diag_indices(width)] += damping * np.diag(equations.cameras)
    right = equations.camera_right - carried.reshape(-1, width).T @ equations.point_right.reshape(-1)
    columns = cho_solve(cho_factor(reduced, lower=True), right) if width else right
    points = np.einsum("fij,fj->fi", inverse, equations.point_right - equations.ties @ columns)
    return columns, points


def moved(state: State, layout: Layout, columns: Points, points: Points) -> State:
    """A state after a step."""
    result = state.copy()
    free = layout.lenses >= 0
    result.lenses[free] += columns[layout.lenses[free]]
    for blocks, rotations, places in (
        (layout.stations, result.rotations, result.places),
        (layout.bodies, result.body_rotations, result.body_places),
    ):
        which = np.nonzero(blocks[:, 0] >= 0)[0]
        steps = columns[blocks[which]]
        rotations[which] = turn(steps[:, :3]) @ rotations[which]
        places[which] += steps[:, 3:]
    result.points[layout.free_points] += points
    return result


def refine(problem: Problem, state: State, *, rounds: int = ROUNDS, close: float = 1e-9) -> Refined:
    """The state of least χ² that is reached from ``state``.

    Args:
        problem: what takes part and what is let go.
        state: where to begin.
        rounds: of steps, at most.
        close: it has arrived when a step promises less than this part of χ² (and less than as much of 1).

    Raises:
        MienError: a point lies behind a camera at the start.
    """
    layout = lay_out(problem)
    equations = equate(problem, state, layout)
    damping = 1e-4
    for _ in range(rounds):
        taken = None
        for _ in range(12):
            try:
                columns, points = solve_step(equations, damping)
            except np.linalg.LinAlgError:
                damping = max(10.0 * damping, 1e-8)
                continue
            promised = float(columns @ equations.camera_right + (points * equations.point_right).sum())
            if promised < close * (1.0 + equations.cost):
                break
            candidate = moved(state, layout, columns, points)
            if cost_of(problem, candidate, layout) < equations.cost:
                taken = candidate
                break
            damping *= 8.0
        if taken is None:
            break
        state = taken
        damping = max(damping * 0.1, 1e-12)
        equations = equate(problem, state, layout)
    return Refined(problem, state, equations)
