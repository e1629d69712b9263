"""The records of a solved pair, and what to say about it."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from mien.core.mesh import Points

from .pair_clicks import SIDE, Bools, Clicks, twin_name
from .pair_refining import FLIP, TWINS_M, Fit, Known, deviation, side_turn
from .pair_views import NEARNESS, YAW
from .records import Observation, Residual, SolvedPoint, Survey

ENOUGH = 12
"""Points seen in both photographs before we stop saying that more would help."""
VAGUE = 0.25
"""Of a camera's distance: worse than this, the data do not tell it."""
UNTOLD = 0.7
"""Share of the assumed deviation of the side's turn that is left when the data do not tell it."""
STRAINED = 2.0
"""Clicks miss by so many times their variance."""

STEPS = 8
"""Of a place between two rays; three would do."""

Solved = dict[tuple[str, str], SolvedPoint]


def points_of(moment: str, clicks: Clicks, fit: Fit, photographs: tuple[str, str]) -> Solved:
    """All points that are seen."""
    points: Solved = {}
    missing, double = clicks.missing, clicks.double
    for number, name in enumerate(clicks.names):
        kind = "measured" if double[number] else "symmetric" if missing[number] < 0 else "modelled"
        photos = tuple(photo for photo, seen in zip(photographs, clicks.visible[:, number], strict=True) if seen)
        points[moment, name] = SolvedPoint(name, moment, fit.places[number], fit.of_point(number), photos, kind)
    return points


def mirrored(points: Solved, twins: Mapping[str, str] | None, clicks: Clicks) -> Solved:
    """The twins of all points off the midline that no photograph shows."""
    midline = {name for name, on in zip(clicks.names, clicks.midline, strict=True) if on}
    images: Solved = {}
    for (moment, name), point in points.items():
        twin = twin_name(name, twins, float(point.place[0]))
        if name in midline or (moment, twin) in points:
            continue
        covariance = point.covariance * np.outer(FLIP, FLIP) + TWINS_M**2 * np.eye(3)
        images[moment, twin] = SolvedPoint(twin, moment, point.place * FLIP, covariance, point.photos, "mirrored")
    return images


def residuals_of(
    survey: Survey, clicks: Clicks, used: Clicks, kept: Bools, fit: Fit, points: Solved, photographs: tuple[str, str]
) -> tuple[list[Residual], list[Residual]]:
    """Residuals of all clicks of the pair, and of those left out."""
    all_of_them: list[Residual] = []
    suspects: list[Residual] = []
    for each in survey.observations:
        if each.photo not in photographs:
            continue
        view = photographs.index(each.photo)
        number = clicks.names.index(each.point)
        if kept[view, number]:
            at = used.names.index(each.point)
            du, dv = fit.residuals[view, at].tolist()
            all_of_them.append(Residual(each, du, dv, float(fit.statistics[view, at])))
        else:
            suspects.append(_left_out(each, view, clicks, number, fit, points, survey))
            all_of_them.append(suspects[-1])
    return all_of_them, sorted(suspects, key=lambda suspect: -suspect.statistic)


def _left_out(
    each: Observation, view: int, clicks: Clicks, number: int, fit: Fit, points: Solved, survey: Survey
) -> Residual:
    """How far a click is off from where its point is without it; where both were left out, from half way between."""
    point = points.get((survey.photograph(each.photo).moment, each.point))
    if point is None:
        place, covariance = _half_way(clicks, number, fit), np.zeros((3, 3))
    else:
        place, covariance = point.place, point.covariance
    off = clicks.seen[view, number] - fit.views[view].seen(place[None])[0]
    slope = fit.views[view].slopes(place[None])[0]
    variance = slope @ covariance @ slope.T + clicks.sigma[view, number] ** 2 * np.eye(2)
    return Residual(each, float(off[0]), float(off[1]), float(off @ np.linalg.solve(variance, off)))


def _half_way(clicks: Clicks, number: int, fit: Fit) -> Points:
    """(3,) m, the place that both clicks of a point miss least (Gauss-Newton)."""
    place = np.zeros(3)
    for _ in range(STEPS):
        off, slopes = [], []
        for view, seen, sigma in zip(fit.views, clicks.seen[:, number], clicks.sigma[:, number], strict=True):
            off.append((seen - view.seen(place[None])[0]) / sigma)
            slopes.append(view.slopes(place[None])[0] / sigma)
        place = place + np.linalg.lstsq(np.concatenate(slopes), np.concatenate(off), rcond=None)[0]
    return place


def remarks_of(clicks: Clicks, known: Known, fit: Fit, photographs: tuple[str, str]) -> list[str]:
    """What was found of the cameras, what was assumed, and what to do better."""
    shown = "left" if fit.views[SIDE].base[2, 0] < 0 else "right"
    remarks = [f"the side photograph {photographs[SIDE]!r} shows the face's own {shown} side"]
    if (count := int(clicks.double.sum())) < ENOUGH:
        remarks.append(f"only {count} points are seen in both photographs: {ENOUGH} or more make the cameras surer")
    if known.orthographic:
        remarks.append(
            "perspective is left in, as in 1972: about 1 % of the face; standard deviations are widened by how badly "
            "the heights of both photographs agree"
        )
    else:
        for view, name in enumerate(photographs):
            remarks.append(_words_of_distance(view, name, known, fit))
        remarks.append(_words_of_turn(known, fit, photographs[SIDE]))
        if fit.chi2 > STRAINED * fit.redundancy:
            remarks.append(
                f"clicks miss by {math.sqrt(fit.chi2 / fit.redundancy):.1f} times what their sigma says: marks are "
                "less sure than told, or the face moved between the photographs"
            )
    if kinds := int((clicks.missing >= 0).sum()):
        remarks.append(
            f"{kinds} points are seen once and have no twin: the rest is a smooth guess from their neighbours"
        )
    return remarks


def _words_of_distance(view: int, name: str, known: Known, fit: Fit) -> str:
    metres, vague = 1.0 / fit.views[view].nearness, deviation(fit, known, view, NEARNESS)
    if vague > VAGUE:
        return (
            f"the data hardly tell how far the camera of {name!r} stood: about {metres:.1f} m assumed — "
            "measure it (camera_distance), or click more points in both photographs"
        )
    told = " (with the tape)" if view in known.tape_m else ""
    return f"the camera of {name!r} stood {metres:.2f} ± {metres * vague:.2f} m from the head{told}"


def _words_of_turn(known: Known, fit: Fit, name: str) -> str:
    turn, sigma = math.degrees(side_turn(fit.views[SIDE])), deviation(fit, known, SIDE, YAW)
    if sigma > UNTOLD * known.turn_rad:
        return (
            f"nothing tells whether {name!r} is exactly in profile: within {math.degrees(known.turn_rad):g}° assumed, "
            "which moves a point 6 cm off the midline by up to "
            f"{60.0 * math.tan(sigma):.0f} mm forwards or back — one lens for both photographs, or measured camera "
            "distances, tell more; where it may be turned further, set side_turn_deg"
        )
    return f"the camera of {name!r} is turned {abs(turn):.1f} ± {math.degrees(sigma):.1f}° from exact profile"


def words_of_suspects(suspects: list[Residual]) -> list[str]:
    """Points of which both clicks were left out."""
    names = [each.observation.point for each in suspects]
    return [
        f"the heights of {name!r} in the two photographs do not agree: one of its clicks is wrong, either may be"
        for name in sorted(set(names))
        if names.count(name) > 1
    ]
