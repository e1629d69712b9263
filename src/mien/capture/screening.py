"""Clicks of references that are so far astray that no camera could be begun with them: exchanged names above all.

Mis-clicks are found by leaving each out of a solution. Where two references of one photograph have exchanged their
names and few photographs are there, the solution that this starts from is already that of no camera; so they are looked
for before, photograph by photograph.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations, permutations

import numpy as np
from numpy.typing import NDArray

from mien.core.errors import MienError
from mien.core.mesh import Points

from .homogeneous import homogeneous_matrix
from .placing import focal_lenses, likely_poses, refine_poses
from .projecting import project
from .records import WORLD, Observation, Residual, Solution, Survey

UNKNOWNS = 11
FEWEST = 10
"""References in a photograph: without two of them, five equations more than unknowns are left."""
FEWEST_EXCHANGED = 6
"""References in a photograph, corners of a cube, of which two that are exchanged are found."""
METRIC_UNKNOWNS = 8
"""Of a camera of square pixels with its middle in the middle: its pose, focal length and bend."""
SUSPECT_PX = 10.0
"""Times their sigma: clicks that fit worse than this are looked into; lens distortion alone stays below."""
CURED = 6.0
"""Times: so much better the others must fit without a click or two, by the variance of what is left over."""
ALONE = 3.0
"""Times: so much better all must fit by one exchange of names than by any other."""
WORST = 16
"""Clicks of a photograph that are tried: those that fit worst."""
AGREES = 16.0
"""χ² of two degrees of freedom up to which a click that was left out is not called a mistake after all."""


def astray(survey: Survey) -> tuple[Observation, ...]:
    """Clicks of references without which, one or two in a photograph, all others of it suddenly fit a camera."""
    places = {each.name: (each.x, each.y, each.z) for each in survey.references if each.target == WORLD}
    found: list[Observation] = []
    for photo in survey.photographs:
        clicks = [each for each in survey.observations if each.photo == photo.name and each.point in places]
        if len(clicks) >= FEWEST_EXCHANGED:
            at = np.array([places[each.point] for each in clicks])
            worst = _worst(at, clicks) if len(clicks) >= FEWEST else _exchanged(at, clicks, photo.size_px)
            found += [clicks[number] for number in worst]
    return tuple(found)


def without(survey: Survey, clicks: Sequence[Observation]) -> Survey:
    """The survey without those clicks; where a photograph cannot spare two, they have each other's name instead."""
    references = {each.name for each in survey.references}
    shown = Counter(each.photo for each in survey.observations if each.point in references)
    partner = {
        (one.photo, one.point): other.point
        for one, other in permutations(clicks, 2)
        if one.photo == other.photo and shown[one.photo] < FEWEST
    }
    left_out = {(each.photo, each.point) for each in clicks} - partner.keys()
    kept = [each for each in survey.observations if (each.photo, each.point) not in left_out]
    named = [replace(each, point=partner.get((each.photo, each.point), each.point)) for each in kept]
    return replace(survey, observations=tuple(named))


def put_back(solution: Solution, survey: Survey, clicks: Sequence[Observation]) -> Solution:
    """The solution of the whole survey, in which those clicks took no part; those that do not agree are suspects."""
    residuals = {(each.observation.photo, each.observation.point): each for each in solution.residuals}
    suspects = list(solution.suspects)
    for each in clicks:
        point = solution.points.get((survey.photograph(each.photo).moment, each.point))
        camera = solution.cameras.get(each.photo)
        if point is None or camera is None:
            continue
        u, v = project(camera, point.place[None])[0].tolist()
        du, dv = each.u - u, each.v - v
        residual = Residual(each, du, dv, (du * du + dv * dv) / each.sigma_px**2)
        residuals[each.photo, each.point] = residual
        if residual.statistic > AGREES:
            suspects.append(residual)
    ordered = [residuals[key] for each in survey.observations if (key := (each.photo, each.point)) in residuals]
    suspects.sort(key=lambda suspect: -suspect.statistic)
    return replace(solution, survey=survey, residuals=tuple(ordered), suspects=tuple(suspects))


def _worst(places: Points, clicks: Sequence[Observation]) -> tuple[int, ...]:
    """Numbers of the click or the two clicks that no camera explains together with all others; none if one does."""
    pictures = np.array([[each.u, each.v] for each in clicks])
    sigma = float(np.median([each.sigma_px for each in clicks]))
    everything = np.ones(len(clicks), dtype=bool)
    try:
        off, scatter = _fit(places, pictures, everything)
        if scatter < SUSPECT_PX * sigma:
            return ()
        candidates = np.argsort(-off)[:WORST].tolist()
        best: tuple[int, ...] = ()
        least = scatter / CURED
        for leave in (1, 2):
            for numbers in combinations(candidates, leave):
                kept = everything.copy()
                kept[list(numbers)] = False
                now = _fit(places, pictures, kept)[1]
                if now < least:
                    best, least = numbers, now
            if best:
                return best
    except MienError:  # references on a plane tell no camera of their own
        return ()
    return best


def _exchanged(places: Points, clicks: Sequence[Observation], size_px: tuple[int, int]) -> tuple[int, ...]:
    """Numbers of the two clicks whose exchange alone lets all fit a camera; none if all do, or no exchange does.

    Few references fit some homogeneous matrix whatever they are called; so a camera with a lens is asked for.
    """
    pictures = np.array([[each.u, each.v] for each in clicks])
    scatter = _metric_scatter(places, pictures, size_px)
    if scatter < SUSPECT_PX * float(np.median([each.sigma_px for each in clicks])):
        return ()
    tried = []
    for one, other in combinations(range(len(pictures)), 2):
        mended = pictures.copy()
        mended[[one, other]] = pictures[[other, one]]
        tried.append((_metric_scatter(places, mended, size_px), (one, other)))
    (least, best), (second, _) = sorted(tried)[:2]
    return best if least < min(scatter / CURED, second / ALONE) else ()


def _metric_scatter(places: Points, pictures: Points, size_px: tuple[int, int]) -> float:
    """How far clicks (N, 2) are off the likeliest camera of all of them, px; infinite where none is."""
    greater = max(size_px)
    found = [
        pose
        for poses in likely_poses(focal_lenses(size_px), places, pictures, greater, keep=2, rounds=8)
        for pose in poses
    ]
    if not found:
        return np.inf
    likely = sorted(found, key=lambda pose: pose.cost)[:2]
    best = min(refine_poses(likely, places, pictures, greater, free=(0, 3)), key=lambda pose: pose.cost)
    off = project(best.camera(), places) - pictures
    return float(np.sqrt(np.nan_to_num(off * off, nan=np.inf).sum() / (2 * len(places) - METRIC_UNKNOWNS)))


def _fit(places: Points, pictures: Points, kept: NDArray[np.bool_]) -> tuple[Points, float]:
    """How far clicks (N,) are off a camera of those kept, px, and the scatter of these, px."""
    matrix = homogeneous_matrix(places[kept], pictures[kept])
    x, y, z = matrix @ np.column_stack([places, np.ones(len(places))]).T
    off = np.hypot(x / z - pictures[:, 0], y / z - pictures[:, 1])
    return off, float(np.sqrt(np.sum(off[kept] ** 2) / (2 * kept.sum() - UNKNOWNS)))
