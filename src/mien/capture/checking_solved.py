"""What a solution tells about its survey: views that are nearly parallel, exchanged names, a size that cannot be."""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations

import numpy as np

from mien.core.mesh import Points

from .checking import listed
from .projecting import project, rays
from .records import WORLD, Camera, Observation, Residual, Solution, SolvedPoint
from .summaries import measured

NARROW_DEG = 8.0
"""Angle between the outermost rays to a point below which its depth is weak."""

WIDE_DEG = 20.0
"""Angle that is asked for."""

NEAR_SIGMAS = 5.0
"""A click within so many sigmas of a point is a click of it."""

FARTHER = 5.0
"""How many times farther it must be from the point of its own name."""

USUAL_M = (0.02, 3.0)
"""What measured points span, of heads and what is like them."""

Key = tuple[str, str]
"""A photograph and a point."""


def remarks_on(solution: Solution) -> tuple[str, ...]:
    """What to look at and what to add, a sentence each."""
    return (
        *_remarks_on_angles(solution),
        *_remarks_on_names(solution),
        *_remarks_on_places(solution),
        *_remarks_on_size(solution),
    )


def _remarks_on_angles(solution: Solution) -> Iterator[str]:
    """Points whose rays meet at small angles."""
    narrow: dict[str, tuple[float, SolvedPoint]] = {}
    points = measured(solution)
    for point in points:
        angle = _angle_deg(point, solution.cameras)
        if angle is not None and angle < NARROW_DEG:
            label = point.name if len({each.moment for each in points}) == 1 else f"{point.name} ({point.moment})"
            narrow[label] = (angle, point)
    if not narrow:
        return
    worst = min(narrow, key=lambda label: narrow[label][0])
    angle, point = narrow[worst]
    among = f"all {len(points)} points" if len(narrow) == len(points) > 1 else f"{len(narrow)} of {len(points)} points"
    photos = " and ".join(repr(name) for name in point.photos[:3])
    yield (
        f"{among} ({listed(narrow)}): rays from the photographs meet at less than {NARROW_DEG:g}°, of {worst!r} "
        f"({photos}) at {angle:.1f}°, so that depth is known {_weakness(point):.0f} times worse than what lies "
        f"across — add a photograph from {WIDE_DEG:g}° or more to the side that shows them"
    )


def _angle_deg(point: SolvedPoint, cameras: Mapping[str, Camera]) -> float | None:
    """The largest angle between two of the rays that a point was found from; None of fewer than two."""
    towards = [point.place - cameras[name].place for name in point.photos if name in cameras]
    if len(towards) < 2:
        return None
    units = np.array(towards) / np.linalg.norm(towards, axis=1, keepdims=True)
    chord = float(np.linalg.norm(units[:, None] - units[None], axis=2).max())
    return math.degrees(2.0 * math.asin(min(0.5 * chord, 1.0)))


def _weakness(point: SolvedPoint) -> float:
    """How much larger than in the other directions the standard deviation is in the worst."""
    values = np.sqrt(np.maximum(np.linalg.eigvalsh(point.covariance), 0.0))
    return float(values[2] / max(values[1], 1e-12))


def _remarks_on_names(solution: Solution) -> Iterator[str]:
    """Suspects that lie where another point is, with the exchange or the name that mends them."""
    named: set[Key] = set()
    suspects = [each for each in solution.suspects if each.observation.photo in solution.cameras]
    seen = {(each.photo, each.point): each for each in solution.survey.observations}
    meant = {_key(each): _meant(each, solution) for each in suspects}
    for each in suspects:
        key = photo, point = _key(each)
        other = meant[key]
        if other is None or key in named:
            continue
        there = seen.get((photo, other))
        if there is None:
            yield f"photograph {photo!r}{_line(each.observation)}: {point!r} is clicked where {other!r} is — rename it"
        elif meant.get((photo, other)) == point:
            named.add((photo, other))
            yield _exchange([photo], point, other, [each.observation, there])
        else:
            yield (
                f"photograph {photo!r}{_line(each.observation)}: {point!r} is clicked where {other!r} is — look at the "
                "names there"
            )
    yield from _remarks_on_pairs(solution, suspects, seen, meant)


def _key(residual: Residual) -> Key:
    return residual.observation.photo, residual.observation.point


def _meant(residual: Residual, solution: Solution) -> str | None:
    """The point that a suspect lies on; None where it lies on none, or not much nearer than on its own."""
    seen = residual.observation
    moment = solution.survey.photograph(seen.photo).moment
    others = [point for (at, name), point in solution.points.items() if at == moment and name != seen.point]
    if not others:
        return None
    places = project(solution.cameras[seen.photo], np.array([point.place for point in others]))
    distances = np.nan_to_num(np.hypot(places[:, 0] - seen.u, places[:, 1] - seen.v), nan=np.inf)
    nearest = int(np.argmin(distances))
    limit = min(NEAR_SIGMAS * _scatter(solution) * seen.sigma_px, math.hypot(residual.du, residual.dv) / FARTHER)
    return others[nearest].name if distances[nearest] < limit else None


def _scatter(solution: Solution) -> float:
    """How much larger than told clicks scatter; 1 at least."""
    return max(math.sqrt(solution.chi2_per_dof), 1.0) if math.isfinite(solution.chi2_per_dof) else 1.0


def _remarks_on_places(solution: Solution) -> Iterator[str]:
    """References that no photograph sees where they are said to be, while their clicks agree on another place."""
    wrong: dict[str, list[Observation]] = defaultdict(list)
    for each in solution.suspects:
        wrong[each.observation.point].append(each.observation)
    clicks = Counter(each.observation.point for each in solution.residuals)
    for reference in solution.survey.references:
        seen = wrong[reference.name]
        if reference.target != WORLD or not 2 <= clicks[reference.name] == len(seen):
            continue
        place = _meeting(seen, solution)
        if place is None:
            continue
        off = 1000.0 * (place - (reference.x, reference.y, reference.z))
        yield (
            f"reference {reference.name!r}: all of its {len(seen)} clicks are suspects, and they agree on a place "
            f"{math.hypot(*off):.1f} mm from the one told ({off[0]:+.1f}, {off[1]:+.1f}, {off[2]:+.1f} mm along x, y "
            "and z) — measure it again"
        )


def _remarks_on_pairs(
    solution: Solution, suspects: Sequence[Residual], seen: Mapping[Key, Observation], meant: Mapping[Key, str | None]
) -> Iterator[str]:
    """Exchanged names of points that two photographs show: nobody knows which of the two is wrong."""
    contradicted: dict[str, set[str]] = defaultdict(set)
    for each in suspects:
        photograph = solution.survey.photograph(each.observation.photo)
        point = each.observation.point
        if meant[_key(each)] is None and (photograph.moment, point) not in solution.points:
            contradicted[photograph.moment].add(point)
    for moment, points in contradicted.items():
        photos = [each.name for each in solution.survey.photographs if each.moment == moment]
        for one, other in combinations(sorted(points), 2):
            shared = [
                name for name in photos if name in solution.cameras and {(name, one), (name, other)} <= seen.keys()
            ]
            if len(shared) != 2:
                continue
            first, second = shared
            told = [(seen[first, name], seen[second, name]) for name in (one, other)]
            crossed = [(seen[first, one], seen[second, other]), (seen[first, other], seen[second, one])]
            if all(_meets(pair, solution) for pair in crossed) and not any(_meets(pair, solution) for pair in told):
                yield _exchange(shared, one, other, [seen[name, point] for name in shared for point in (one, other)])


def _meeting(clicks: Sequence[Observation], solution: Solution) -> Points | None:
    """(3,) m where the rays of clicks meet before their cameras; None where they do not."""
    cameras = [solution.cameras[each.photo] for each in clicks]
    directions = [rays(c, np.array([[each.u, each.v]]))[0] for c, each in zip(cameras, clicks, strict=True)]
    place = _nearest([camera.place for camera in cameras], directions)
    for camera, each in zip(cameras, clicks, strict=True):
        u, v = project(camera, place[None])[0]
        if not math.hypot(u - each.u, v - each.v) < NEAR_SIGMAS / 2.0 * _scatter(solution) * each.sigma_px:
            return None
    return place


def _meets(clicks: Sequence[Observation], solution: Solution) -> bool:
    return _meeting(clicks, solution) is not None


def _nearest(places: Sequence[Points], directions: Sequence[Points]) -> Points:
    """(3,) the place nearest to lines."""
    across = [np.eye(3) - np.outer(direction, direction) for direction in directions]
    right = sum((a @ place for a, place in zip(across, places, strict=True)), np.zeros(3))
    return np.asarray(np.linalg.lstsq(np.sum(across, axis=0), right, rcond=None)[0], dtype=np.float64)


def _exchange(photos: Sequence[str], one: str, other: str, clicks: Sequence[Observation]) -> str:
    where = " or ".join(repr(photo) for photo in photos)
    return f"photograph {where}{_line(*clicks)}: {one!r} and {other!r} seem exchanged — swap their names there"


def _line(*clicks: Observation) -> str:
    lines = [str(each.line) for each in clicks if each.line]
    return f" ({'lines' if len(lines) > 1 else 'line'} {', '.join(lines)})" if lines else ""


def _remarks_on_size(solution: Solution) -> Iterator[str]:
    """Points that span what no face does: a wrong unit."""
    points = measured(solution)
    if len(points) < 2 or not solution.survey.references:
        return
    places = np.array([point.place for point in points])
    span = float(np.linalg.norm(np.ptp(places, axis=0)))
    low, high = USUAL_M
    if not low <= span <= high:
        yield (
            f"the measured points span {span:.3g} m, a head is 0.2 to 0.3 m — is the unit of the references in "
            "project.toml right?"
        )
