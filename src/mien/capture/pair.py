"""A face from a front and a side photograph, as in 1972: without a cube, half of it mirrored.

What a pair tells: sizes in each photograph up to one told length, and from the heights, which are measured twice, how
much nearer parts of the face are to each camera, thus the distance of both cameras and the turns of the head that
change heights. The focal length need not be known: it is the size of the picture of the face times the distance. What a
pair tells badly is how far the side photograph is turned from exact profile: it shears cheeks forwards or back. A told
camera distance, or one lens for both photographs, helps.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from mien.core import MienError, UnknownNameError

from .pair_clicks import FRONT, SIDE, Bools, Clicks, gather, twin_name
from .pair_refining import DISTANCE_M, Fit, Known, apart, refine
from .pair_results import mirrored, points_of, remarks_of, residuals_of, words_of_suspects
from .pair_start import SIDES, place_roughly
from .pair_views import FLAT, NEARNESS, SCALE, View
from .project_records import DISTANCE_SIGMA_M
from .records import WORLD, Solution, Survey

FEWEST, FEWEST_PERSPECTIVE = 3, 6
"""Points seen in both photographs, without and with perspective."""

SHORTEST = 0.08
"""Of the extent of the face: the length that it is scaled by."""
FAULTY = 18.0
"""χ² of one degree of freedom beyond which a click is taken for a mistake: one of 45 000 right ones."""
MOST_FAULTY = 0.1
ALIKE = 0.8
"""Of their χ²: two clicks of a point nearer than this are not told apart."""
USUAL = 0.455
"""Median of χ² of one degree of freedom."""


def solve_pair(
    survey: Survey,
    *,
    front: str,
    side: str,
    scale: tuple[str, str, float] | None = None,
    camera_distance_m: Mapping[str, float | tuple[float, float]] | None = None,
    orthographic: bool = False,
    midline: Sequence[str] = (),
    mirror: bool = True,
    twins: Mapping[str, str] | None = None,
    side_from: str | None = None,
    side_turn_deg: float = 3.0,
) -> Solution:
    """Points of a face in the frame of its head, x to its own left, y up (in the side photograph), z forward.

    Args:
        survey: that has both photographs.
        front, side: names of the photographs.
        scale: two points and the metres between them; without it, two references that both photographs show.
        camera_distance_m: by photograph, from the lens to the nearest marked point, and its standard deviation (2 cm).
        orthographic: as in 1972: x and y from the front, z and y from the side, perspective left in.
        midline: points of the symmetry plane; without, points without a side half way between twins.
        mirror: points of one half get a twin in the other.
        twins: left point -> right point; without, names that end in ``.left`` and ``.right``.
        side_from: the face's own side that the side photograph shows, ``left`` or ``right``; found when not told.
        side_turn_deg: standard deviation of how far the side photograph is turned from exact profile.

    Points that one photograph shows get the rest from their twin (``symmetric``), else from a smooth surface through
    their neighbours (``modelled``); points that none shows are the mirror image of their twin (``mirrored``).

    Raises:
        MienError: what cannot be solved, and what to add.
        UnknownNameError: a photograph, point or side that is not there.

    Source: Parke 1972, "Data acquisition".
    """
    if side_from is not None and side_from not in SIDES:
        raise UnknownNameError("side of the face", side_from, SIDES)
    if not 0.0 < side_turn_deg <= 45.0:
        raise MienError(f"side_turn_deg is {side_turn_deg:g} — want degrees, more than 0, at most 45")
    clicks, remarks = gather(survey, front, side, midline, twins)
    _check_enough(clicks, orthographic, (front, side))
    one, other, length = scale or _reference_length(survey, clicks)
    known = Known(
        ends=(_end(clicks, one, twins), _end(clicks, other, twins)),
        length_m=_positive(length, f"the length from {one!r} to {other!r}"),
        tape_m=_tape(camera_distance_m or {}, front, side),
        same_lens=_one_lens(survey, front, side),
        turn_rad=math.radians(side_turn_deg),
        orthographic=orthographic,
    )
    if known.ends[0] == known.ends[1]:
        raise MienError(f"the told length goes from {one!r} to itself — name two points")
    fit, kept, strain = _fit_without_faults(clicks, known, side_from, (front, side))
    used = clicks.only(kept)
    photographs = (front, side)
    points = points_of(survey.photograph(front).moment, used, fit, photographs)
    if mirror:
        points |= mirrored(points, twins, clicks)
    residuals, suspects = residuals_of(survey, clicks, used, kept, fit, points, photographs)
    remarks += remarks_of(used, known, fit, photographs) + words_of_suspects(suspects)
    return Solution(
        survey,
        {name: view.camera(survey.photograph(name).size_px) for name, view in zip(photographs, fit.views, strict=True)},
        points,
        tuple(residuals),
        tuple(suspects),
        strain,
        tuple(remarks),
        "pair-1972" if orthographic else "pair",
    )


def _check_enough(clicks: Clicks, orthographic: bool, names: tuple[str, str]) -> None:
    count, fewest = int(clicks.double.sum()), FEWEST if orthographic else FEWEST_PERSPECTIVE
    if count < fewest:
        raise MienError(
            f"{names[FRONT]!r} and {names[SIDE]!r} have {count} points in common, want {fewest} or more — click more "
            "points in both, spread from forehead to chin and from nose to ear"
            + ("" if orthographic or count < FEWEST else ", or solve without perspective (orthographic = true)")
        )


def _reference_length(survey: Survey, clicks: Clicks) -> tuple[str, str, float]:
    """The longest length between two references that both photographs show."""
    shown = {name for name, both in zip(clicks.names, clicks.double, strict=True) if both}
    there = [each for each in survey.references if each.target == WORLD and each.name in shown]
    lengths = [
        (math.dist((a.x, a.y, a.z), (b.x, b.y, b.z)), a.name, b.name)
        for number, a in enumerate(there)
        for b in there[:number]
    ]
    if not lengths:
        raise MienError(
            "nothing tells how large the face is — measure one length on it and tell it, such as "
            'scale = ["endocanthion.left", "endocanthion.right", 33] in mm'
        )
    length, one, other = max(lengths)
    return one, other, length


def _end(clicks: Clicks, name: str, twins: Mapping[str, str] | None) -> tuple[int, bool]:
    """The point of that name, or of the name of its twin when only that is seen."""
    if name not in clicks.names and (twin := twin_name(name, twins, 1.0)) in clicks.names:
        return clicks.number(twin), True
    return clicks.number(name), False


def _positive(metres: float, what: str) -> float:
    if not (math.isfinite(metres) and metres > 0.0):
        raise MienError(f"{what} is {metres:g} m — want more than 0")
    return float(metres)


def _tape(told: Mapping[str, float | tuple[float, float]], front: str, side: str) -> dict[int, tuple[float, float]]:
    tape = {}
    for name, distance in told.items():
        if name not in (front, side):
            raise UnknownNameError("photograph of a camera distance", name, (front, side))
        metres, sigma = distance if isinstance(distance, tuple) else (distance, DISTANCE_SIGMA_M)
        what = f"the camera distance of {name!r}"
        tape[FRONT if name == front else SIDE] = _positive(metres, what), _positive(sigma, f"the deviation of {what}")
    return tape


def _one_lens(survey: Survey, front: str, side: str) -> bool:
    one, other = survey.photograph(front), survey.photograph(side)
    return one.camera == other.camera and sorted(one.size_px) == sorted(other.size_px)


def _fit_without_faults(
    clicks: Clicks, known: Known, side_from: str | None, names: tuple[str, str]
) -> tuple[Fit, Bools, float]:
    """The fit, which clicks (2, N) it rests on, and χ² per degree of freedom.

    Clicks that do not agree with all others are left out, the worst first; orthographic views have no such judgement,
    all clicks disagree there, and are taken for as unsure as they show themselves to be.
    """
    kept = clicks.visible.copy()
    ends = {clicks.names[number] for number, _ in known.ends}
    for left in reversed(range(1 + int(MOST_FAULTY * clicks.double.sum()))):
        used = clicks.only(kept)
        told = replace(known, ends=_renumbered(known, clicks, used))
        fit = _fit(used, told, side_from, names)
        strain = fit.chi2 / max(fit.redundancy, 1e-9)
        if known.orthographic:
            fit = _fit(used.blurred(math.sqrt(strain)), told, side_from, names) if strain > 1.0 else fit
            break
        fault = _worst(used, fit, ends)
        if fault is None or not left:
            break
        views, point = fault
        kept[views, clicks.names.index(point)] = False
        _check_enough(clicks.only(kept), known.orthographic, names)
    return fit, kept, strain


def _worst(clicks: Clicks, fit: Fit, ends: set[str]) -> tuple[list[int], str] | None:
    """The click that agrees least with all others, or both of its point if they are alike; None if all agree.

    The ends of the told length are left alone: it rests on them.
    """
    statistics = fit.statistics * clicks.double * [name not in ends for name in clicks.names]
    tested = statistics[statistics > 0.0]
    if not len(tested) or tested.max() < FAULTY * max(1.0, float(np.median(tested)) / USUAL):
        return None
    view, point = np.unravel_index(int(np.argmax(statistics)), statistics.shape)
    alike = statistics[1 - view, point] > ALIKE * statistics[view, point]
    return ([FRONT, SIDE] if alike else [int(view)]), clicks.names[point]


def _renumbered(known: Known, clicks: Clicks, used: Clicks) -> tuple[tuple[int, bool], tuple[int, bool]]:
    (one, first), (other, second) = known.ends
    return (used.number(clicks.names[one]), first), (used.number(clicks.names[other]), second)


def _fit(clicks: Clicks, known: Known, side_from: str | None, names: tuple[str, str]) -> Fit:
    front, side, places = place_roughly(clicks, side_from, names)
    pictured, extent = float(np.linalg.norm(apart(known, places))), float(np.ptp(places, axis=0).max())
    if pictured < SHORTEST * extent:
        one, other = (clicks.names[number] for number, _ in known.ends)
        raise MienError(
            f"the told length from {one!r} to {other!r} is {pictured / extent:.1%} of the clicked face, want "
            f"{SHORTEST:.0%} or more to scale by — tell a longer one"
        )
    metres = known.length_m / pictured
    nearness = [FLAT if known.orthographic else -math.log(known.tape_m.get(v, (DISTANCE_M,))[0]) for v in (FRONT, SIDE)]
    views = [_in_metres(view, metres, near) for view, near in zip((front, side), nearness, strict=True)]
    return refine(clicks, known, views[FRONT], views[SIDE], places * metres)


def _in_metres(view: View, metres: float, nearness: float) -> View:
    values = view.values.copy()
    values[SCALE] -= math.log(metres)
    values[NEARNESS] = nearness
    return replace(view, values=values)
