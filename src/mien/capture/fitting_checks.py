"""What can be wrong with points of a head: each told with what it looks like and what to try."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from mien.core import MienError

from .fitting_field import Estimate, Evidence, superpose
from .fitting_people import population

if TYPE_CHECKING:
    from mien.core.mesh import Points

FEWEST = 6
NARROW = 0.02
"""Share of the largest extent of points that the second one must reach, or they lie on a line."""

SMALLEST, LARGEST = 0.7, 1.4
"""Sizes of a head, over the mean one, that pass for a person's."""
NEARLY = 1.12
"""Sizes that are told, up or down, because few people have them."""

UNITS = {"mm": 0.001, "cm": 0.01, "m": 1.0, "inch": 0.0254, "foot": 0.3048}
HEAD_M = 0.22
"""From the crown to the chin."""

MIRRORED = 0.5
"""Where a mirror image fits by so much better, the points are one."""

CANDIDATES = 10
"""Suspicious points that are tried in each other's place."""
SHARE_LEFT = 0.5
"""Share of χ² that an exchange of two names must leave at most."""

EXPRESSIONS = (
    ("the mouth seems to be open by {0:.0f} degrees", {"jaw.rotation": 10.0}, 10.0, 3.0),
    ("the face seems to smile", {"mouth.expression": 0.5}, 1.0, 0.6),
    ("the brows seem to be raised", {"eyebrow.inner_raise": 1.0, "eyebrow.outer_raise": 1.0}, 1.0, 0.3),
    ("the eyes seem to be shut", {"eyelid.opening": 0.0}, 1.0, 0.5),
)
CERTAIN = 4.0
"""Standard deviations from which on an expression is told."""


def check_points(points: Mapping[str, Points]) -> None:
    """Makes sure that there are points enough, finite and not on a line.

    Raises:
        MienError: there are not.
    """
    for name, place in points.items():
        array = np.asarray(place, dtype=np.float64)
        if array.shape != (3,) or not np.isfinite(array).all():
            raise MienError(f"point {name!r}: want three finite numbers, x y z in metres, got {place!r}")
    if len(points) < FEWEST:
        raise MienError(
            f"a head needs at least {FEWEST} points, got {len(points)} — measure corners of eyes and mouth, nasion, "
            "pronasale, subnasale, pogonion and both tragia"
        )
    places = np.array([np.asarray(place, dtype=np.float64) for place in points.values()])
    extents = np.linalg.svd(places - places.mean(axis=0), compute_uv=False)
    if extents[1] <= NARROW * extents[0]:
        raise MienError(f"the {len(points)} points lie on a line — add points that lie aside: ears, corners of the jaw")


def check_size(evidence: Evidence, *, scaled: bool) -> list[str]:
    """Remarks about the size of the head; raises where points are mirrored or in another unit.

    Raises:
        MienError: with the unit or the exchange that would fit.
    """
    people = population()
    expected = people.at(evidence.weights)
    mean = expected.points + expected.mean
    fit, mirrored = (_superposed(mean * flip, evidence.places) for flip in ((1.0, 1.0, 1.0), (-1.0, 1.0, 1.0)))
    if mirrored[1] < MIRRORED * fit[1]:
        raise MienError(
            "the points are the mirror image of a face — left and right names are exchanged (left is the person's "
            "own left), or one axis of their frame points the other way"
        )
    if scaled:
        return ["the size of the head was taken from other people: the scale of the points was not trusted"]
    size = fit[0]
    if not SMALLEST < size < LARGEST:
        raise MienError(_unit_message(size))
    if not 1.0 / NEARLY < size < NEARLY:
        return [f"the head is {size:.2f} times as large as the mean person's: look at the scale of the references"]
    return []


def _superposed(points: Points, wanted: Points) -> tuple[float, float]:
    """Scale that brings points (N, 3) nearest to others, and the root mean square distance then, over the scale."""
    placing = superpose(points, wanted, scaled=True)
    left = placing.to_head(wanted) - points
    return placing.scale, float(np.sqrt((left**2).sum(axis=1).mean()))


def _unit_message(size: float) -> str:
    tall = f"the points make a head of {size * HEAD_M:.3g} m from chin to crown"
    fitting = [unit for unit, metres in UNITS.items() if SMALLEST < size * metres < LARGEST]
    if fitting:
        unit = fitting[0]
        return f"{tall} — they seem to be in {unit}: say so with --unit {unit}, or multiply them by {UNITS[unit]:g}"
    return f"{tall} — look at the scale of the references; or fit any size, without trusting the scale"


def find_swap(found: Estimate, names: list[str]) -> None:
    """Tries the most suspicious points in each other's place.

    Raises:
        MienError: two fit where the other one is.
    """
    worst = np.argsort(-found.statistics, kind="stable")[:CANDIDATES]
    best = (SHARE_LEFT * found.chi2, -1, -1)
    for a, b in combinations(sorted(worst.tolist()), 2):
        measured = found.measured.copy()
        measured[[a, b]] = measured[[b, a]]
        surprise = (measured - found.expected).ravel()
        best = min(best, (float(surprise @ found.free @ surprise), a, b))
    _, a, b = best
    if a >= 0:
        raise MienError(
            f"points {names[a]!r} and {names[b]!r} seem to be exchanged: each lies where the other is wanted — "
            "exchange their names"
        )


def expression_remarks(found: Estimate, evidence: Evidence) -> list[str]:
    """What makes the face look as if it were not neutral."""
    from mien.faces.head.head import Head

    head = Head(hair="bald")
    count = evidence.weights.shape[1] - 2
    skin = slice(0, count)
    rest = head.shape(head.neutral).points[skin]
    out = []
    for text, values, whole, least in EXPRESSIONS:
        moves = head.shape(head.neutral.replace(values)).points[skin] - rest
        change = evidence.weights[:, :count] @ moves
        if not change.any():
            continue
        share, deviation = found.amount(change)
        if share > CERTAIN * deviation and share * whole > least:
            out.append(f"{text.format(share * whole)}: the head takes what is measured for its rest")
    return out
