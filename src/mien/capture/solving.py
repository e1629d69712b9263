"""From a survey to cameras and points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mien.capture.checking import check
from mien.capture.checking_solved import remarks_on
from mien.capture.covariances import Covariances
from mien.capture.homogeneous import FEWEST
from mien.capture.lenses import (
    ALL_TERMS,
    FIRST_TERMS,
    assumptions,
    borne_terms,
    evident_terms,
    freed_names,
    remarks_on_lenses,
    with_cropped,
)
from mien.capture.networks import Bools, Network, State, connect
from mien.capture.placing import FAR
from mien.capture.projecting import cross_matrices, see
from mien.capture.records import Camera, Residual, Solution, SolvedPoint, Survey
from mien.capture.refining import Problem, Refined, refine
from mien.capture.screening import astray, put_back, without
from mien.capture.snooping import CONTRADICTED, LEAST_SCALE, Judgement, judge, worst
from mien.capture.solving_appendix_c import solve_appendix_c
from mien.capture.starting import FEWEST_PLACED, begin
from mien.capture.weighing import both_kinds, remarks_on_scatter, weighed
from mien.core.errors import MienError, UnknownNameError
from mien.core.mesh import Points

ENOUGH_TO_COMPARE = 12
"""Clicks of references, and of measured points, from which it is seen which of them fit worse."""
WORSE = 3.0
"""How much larger χ² of references must be for them to be doubted."""
ROUGHLY = 1e-5
"""Part of χ² by which a solution may still fall when mis-clicks are looked for."""
METHODS = ("metric", "appendix-c")
Report = Callable[[str], None]


def solve(survey: Survey, *, method: str = "metric", report: Report | None = None) -> Solution:
    """Cameras and points of a survey, with covariances, residuals and suspected mis-clicks.

    Args:
        survey: what was clicked, and references.
        method: ``metric`` (places, lenses and points refined together), or ``appendix-c`` (Parke 1974 as he wrote it).
        report: is told what is being done.

    Raises:
        MienError: too little was clicked, or it contradicts itself; it says what to add or mend.
    """
    if method not in METHODS:
        raise UnknownNameError("method", method, METHODS)
    connect(survey)
    wrong = astray(survey) if method == "metric" else ()
    screened = without(survey, wrong)
    weak = check(screened)
    if method == "appendix-c":
        solution = solve_appendix_c(survey)
    else:
        solution = put_back(_solve_metric(screened, report or _say_nothing), survey, wrong)
    return replace(solution, remarks=(*weak, *solution.remarks, *remarks_on(solution)))


def _say_nothing(_text: str) -> None:
    pass


@dataclass(frozen=True, eq=False)
class _Solved:
    """A refined network without the observations that were left out."""

    refined: Refined
    judgement: Judgement
    left_out: Bools


def _solve_metric(survey: Survey, say: Report) -> Solution:
    network = connect(survey)
    say("placing photographs")
    state, roots = begin(network)
    means, sigmas = assumptions(network, state.lenses)
    sigmas = with_cropped(network, state.lenses, sigmas)
    held = np.zeros(len(network.bodies), dtype=bool)
    held[roots] = True
    left_out = np.zeros(len(network.pictures), dtype=bool)
    problem = Problem(network, _active(network, state, left_out), _terms(network, FIRST_TERMS), held, means, sigmas)
    say("refining cameras and points")
    first = refine(problem, state, rounds=30, close=1e-4)
    problem, state = replace(problem, free_terms=_terms(network, ALL_TERMS)), first.state
    if both_kinds(network):
        rough = refine(problem, state, close=ROUGHLY)
        problem, state = replace(problem, network=weighed(network, rough, judge(rough))), rough.state
    solved = _clean(problem, state, left_out, say)
    sigmas = with_cropped(network, solved.refined.state.lenses, problem.lens_sigmas)
    if (sigmas != problem.lens_sigmas).any():
        solved = _clean(replace(problem, lens_sigmas=sigmas), solved.refined.state, left_out, say)
    say("choosing what the lenses can be asked for")
    solved = _choose_terms(solved, say)
    return _solution(solved)


def _terms(network: Network, terms: Bools) -> Bools:
    return np.tile(terms, (len(network.lenses), 1))


def _active(network: Network, state: State, left_out: Bools) -> Bools:
    """(N,) observations that take part: placed, not left out, of points and photographs that enough tell of."""
    active = state.placed(network) & ~left_out
    while True:
        before = active.sum()
        seen = np.bincount(network.point_of[active], minlength=len(network.points))
        active &= network.known[network.point_of] | (seen[network.point_of] >= 2)
        shown = np.bincount(network.station_of[active], minlength=len(network.stations))
        active &= shown[network.station_of] >= FEWEST_PLACED
        if active.sum() == before:
            return active


def _clean(problem: Problem, state: State, left_out: Bools, say: Report) -> _Solved:
    """A solution without mis-clicks: the worst are left out, and those that agree in the end are taken back."""
    network, left_out = problem.network, left_out.copy()
    taken_back = False
    while True:
        now = replace(problem, active=_active(network, state, left_out))
        # Near enough to see the worst; the whole way when there is none.
        refined = refine(now, state, close=ROUGHLY)
        if not len(worst(network, refined, judge(refined))):
            refined = refine(now, refined.state)
        state, judgement = refined.state, judge(refined)
        wrong = worst(network, refined, judgement)
        if len(wrong):
            say(f"leaving out {int(left_out.sum()) + len(wrong)} suspects")
            left_out[wrong] = True
            continue
        if taken_back or not left_out.any():
            return _Solved(refined, judgement, left_out)
        taken_back = True
        again = left_out & _agrees(network, state, judgement.scale)
        if not again.any():
            return _Solved(refined, judgement, left_out)
        left_out &= ~again


def _agrees(network: Network, state: State, scale: float) -> Bools:
    """(N,) whether observations of points that others still tell lie where those have them."""
    off = _off(network, state) / network.sigmas[:, None]
    with np.errstate(invalid="ignore"):
        return (off * off).sum(axis=1) < CONTRADICTED * scale


def _off(network: Network, state: State) -> Points:
    """(N, 2) px seen less solved; NaN where not placed, or behind the camera."""
    station = network.station_of
    frame = np.einsum("nij,nj->ni", state.rotations[station], state.world_places(network) - state.places[station])
    frame[~(frame[:, 2] > 0.0)] = np.nan
    return network.pictures - see(state.lenses[network.lens_of], frame)


def _choose_terms(solved: _Solved, say: Report) -> _Solved:
    """A solution in which lens terms that the data do not tell are held at what is assumed."""
    problem = solved.refined.problem
    terms = problem.free_terms.copy()
    terms &= evident_terms(solved.refined, solved.judgement)
    if (terms != problem.free_terms).any():
        problem, state = _hold(problem, solved.refined.state, terms)
        solved = _clean(problem, state, solved.left_out, say)
    terms = borne_terms(solved.refined, solved.judgement)
    if (terms != solved.refined.problem.free_terms).any():
        problem, state = _hold(solved.refined.problem, solved.refined.state, terms)
        solved = _clean(problem, state, solved.left_out, say)
    return solved


def _hold(problem: Problem, state: State, terms: Bools) -> tuple[Problem, State]:
    """The problem of fewer lens terms, with the others at what is assumed."""
    state = state.copy()
    state.lenses[~terms] = problem.lens_means[~terms]
    return replace(problem, free_terms=terms), state


def _solution(solved: _Solved) -> Solution:
    refined, judgement = solved.refined, solved.judgement
    network, state = refined.problem.network, refined.state
    active = refined.problem.active
    covariances = judgement.covariances
    chi2_per_degree = refined.equations.chi2 / judgement.redundancy if judgement.redundancy > 0.5 else 1.0
    factor = max(chi2_per_degree, LEAST_SCALE) if judgement.scale != 1.0 else 1.0
    photos = sorted(set(network.photo_of[active].tolist()))
    cameras: dict[str, Camera] = {
        network.photo_name(photo): state.camera(
            network, photo, freed_names(refined.problem.free_terms[network.lens_at[photo]])
        )
        for photo in photos
    }
    _check_nearness(network, refined)
    residuals = _residuals(network, refined, judgement)
    out = [number for number in np.nonzero(solved.left_out)[0].tolist() if number in residuals]
    suspects = sorted((residuals[number] for number in out), key=lambda each: -each.statistic)
    remarks = [*_remarks_on_missing(network, active, solved.left_out)]
    remarks += [*remarks_on_lenses(network, refined, judgement), *remarks_on_scatter(network)]
    if factor != 1.0:
        remarks.append(
            f"clicks scatter {np.sqrt(factor):.2g} times as far as their sigmas say: covariances count with that"
        )
    remarks += _remarks_on_references(network, refined, judgement, suspects)
    return Solution(
        survey=network.survey,
        cameras=cameras,
        points=_points(network, refined, covariances, factor),
        residuals=tuple(residuals[number] for number in sorted(residuals)),
        suspects=tuple(suspects),
        chi2_per_dof=chi2_per_degree,
        remarks=tuple(remarks),
    )


def _check_nearness(network: Network, refined: Refined) -> None:
    """Raises where half of the clicks of a photograph are far from where the solution has them."""
    order = refined.equations.layout.order
    off = np.linalg.norm(refined.equations.off, axis=1) * network.sigmas[order]
    share = off / network.sizes[network.lens_of[order]].max(axis=1)
    photos = np.unique(network.photo_of[order])
    far = [float(np.median(share[network.photo_of[order] == photo])) for photo in photos]
    if max(far, default=0.0) > FAR:
        worst_photo = int(photos[int(np.argmax(far))])
        median_px = float(np.median(off[network.photo_of[order] == worst_photo]))
        raise MienError(
            f"photograph {network.photo_name(worst_photo)!r}: half of its clicks lie {median_px:.0f} px or more from"
            " where references and the other photographs have them — look at the names of its points, at the references"
            " and whether its camera and moment are told rightly"
        )


def _residuals(network: Network, refined: Refined, judgement: Judgement) -> dict[int, Residual]:
    """By number of the observation; those of what could not be placed are missing."""
    off = _off(network, refined.state)
    statistics = (off * off).sum(axis=1) / network.sigmas**2
    statistics[refined.equations.layout.order] = judgement.statistics
    statistics /= judgement.scale
    return {
        number: Residual(seen, float(off[number, 0]), float(off[number, 1]), float(statistics[number]))
        for number, seen in enumerate(network.survey.observations)
        if np.isfinite(off[number]).all()
    }


def _points(
    network: Network, refined: Refined, covariances: Covariances, factor: float
) -> dict[tuple[str, str], SolvedPoint]:
    """Measured points and references at each moment that they are seen at."""
    state, layout = refined.state, refined.equations.layout
    world = state.world_places(network)
    found: dict[tuple[str, str], tuple[int, list[str]]] = {}
    for number in np.nonzero(refined.problem.active)[0].tolist():
        photograph = network.survey.photographs[network.photo_of[number]]
        key = (photograph.moment, network.survey.observations[number].point)
        found.setdefault(key, (number, []))[1].append(photograph.name)
    points = {}
    for (moment, name), (number, photos) in sorted(found.items()):
        point, body = network.point_of[number], network.body_of[number]
        rotation = state.body_rotations[body]
        rows = np.zeros((3, layout.columns))
        if layout.bodies[body, 0] >= 0:
            rows[:, layout.bodies[body, :3]] = -cross_matrices(rotation @ state.points[point])
            rows[:, layout.bodies[body, 3:]] = np.eye(3)
        own, alone = layout.points[point], np.zeros((3, 3))
        if own >= 0:
            rows -= rotation @ covariances.carried[own]
            alone = rotation @ covariances.alone[own] @ rotation.T
        covariance = factor * (rows @ covariances.cameras @ rows.T + alone)
        kind = "reference" if network.known[point] else "measured"
        points[moment, name] = SolvedPoint(
            name, moment, world[number].copy(), (covariance + covariance.T) / 2.0, tuple(photos), kind
        )
    return points


def _remarks_on_references(
    network: Network, refined: Refined, judgement: Judgement, suspects: list[Residual]
) -> list[str]:
    """Whether references fit worse than what is measured does: then they are not where they are said to be."""
    order = refined.equations.layout.order
    known = network.known[network.point_of[order]]
    if min(known.sum(), (~known).sum()) < ENOUGH_TO_COMPARE:
        return []
    names = {each.name for each in network.survey.references}
    doubted = sum(each.observation.point in names for each in suspects)
    median = [float(np.median(judgement.statistics[which])) for which in (known, ~known)]
    if median[0] < WORSE * median[1] and doubted < known.sum() / 5.0:
        return []
    times = np.sqrt(median[0] / median[1])
    farther = f"references are seen {times:.1f} times as far off as measured points, and " if times > 1.0 else ""
    return [
        f"{farther}{doubted} clicks of references are suspects: they are not quite where they are said to be, or"
        " have wrong names — look at the names, measure them again, or tell their sigma (0.5 mm for beads on strings),"
        " for cameras to count with that"
    ]


def _remarks_on_missing(network: Network, active: Bools, left_out: Bools) -> list[str]:
    """Photographs and points that got no place."""
    remarks = []
    shown = set(network.photo_of[active].tolist())
    for photo, photograph in enumerate(network.survey.photographs):
        if photo not in shown:
            references = int((network.known[network.point_of] & (network.photo_of == photo)).sum())
            remarks.append(
                f"photograph {photograph.name!r} was left out: it shows too few points of known place"
                " — click six references in it, or four of a camera that other photographs tell"
                if references < FEWEST
                else f"photograph {photograph.name!r} was left out: its {references} references contradict one another"
                " — look at their names and clicks"
            )
    placed = set(network.point_of[active].tolist())
    for point in sorted(set(network.point_of.tolist()) - placed):
        moment, name = network.points[point]
        if network.known[point] or (network.point_of == point).sum() < 2:
            continue  # what one photograph alone shows was told before
        views = (network.point_of == point) & np.isin(network.photo_of, list(shown))
        if (views & left_out).any():
            remarks.append(
                f"point {name!r} ({moment}) was left out: its clicks contradict one another — click it again"
            )
        elif views.sum() < 2:
            remarks.append(
                f"point {name!r} ({moment}) was left out: it is seen in {views.sum()} of the placed photographs"
                " — click it in another one"
            )
        else:
            remarks.append(f"point {name!r} ({moment}) was left out: its rays do not meet before the cameras")
    return remarks
