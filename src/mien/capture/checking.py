"""What is wrong or weak with a survey before anything is solved: who, where, what was wanted, what to add."""

from __future__ import annotations

import difflib
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise

import numpy as np

from mien.core.errors import MienError
from mien.core.mesh import Points

from .checking_mirror import check_handedness
from .networks import connect
from .records import WORLD, Observation, Reference, Survey

FEWEST, FEWEST_FLAT = 6, 4
"""References that the first photograph must show: in space, and of a board."""

FLAT = 0.03
"""Thickness of references over their length, below which they lie on one plane."""

LINE = 1e-3
"""Width of references over their length, below which they lie on one line."""

SPREAD = 0.4
"""Share of what all clicks reach over that references do at least: lenses are known where references are seen."""

SAME_PX = 1e-6
"""Clicks nearer than this are one click that was copied."""

COPIED = 4
"""Equal clicks of two photographs that are no chance."""

SHOWN = 6
"""Names of a list in a sentence, at most."""


def check(survey: Survey) -> tuple[str, ...]:
    """What is weak, a sentence each, with what to add.

    Raises:
        MienError: what cannot be solved, and what to mend.
    """
    connect(survey)
    targets: dict[str, list[Reference]] = defaultdict(list)
    for each in survey.references:
        targets[each.target].append(each)
    _check_copies(survey)
    _check_enough(survey, targets)
    for target, references in targets.items():
        _check_line(target, references)
    check_handedness(survey)
    return (*_remarks_on_shape(targets), *_remarks_on_spread(survey), *_remarks_on_unseen(survey))


def listed(names: Iterable[str]) -> str:
    """Names in a sentence; the first few of many."""
    names = list(names)
    return ", ".join(names[:SHOWN]) + (f" and {len(names) - SHOWN} more" if len(names) > SHOWN else "")


def _places(references: Sequence[Reference]) -> Points:
    return np.array([(each.x, each.y, each.z) for each in references], dtype=np.float64)


def _extents(places: Points) -> Points:
    """(3,) root mean square extents along the axes of places, the largest first; 0 of fewer points than axes."""
    spread = np.linalg.svd(places - places.mean(axis=0), compute_uv=False) / np.sqrt(len(places))
    return np.append(spread, np.zeros(3))[:3]


def _check_copies(survey: Survey) -> None:
    """Two photographs whose clicks are all alike are one photograph."""
    clicks: dict[str, dict[str, Observation]] = defaultdict(dict)
    for each in survey.observations:
        clicks[each.photo][each.point] = each
    photographs = [each for each in survey.photographs if len(clicks[each.name]) >= COPIED]
    for number, one in enumerate(photographs):
        for other in photographs[number + 1 :]:
            if one.camera == other.camera and one.fixed and other.fixed and one.moment != other.moment:
                continue  # what lies still is seen in the same place by a camera on its stand
            pairs = [(seen, clicks[other.name].get(name)) for name, seen in clicks[one.name].items()]
            shared = [(a, b) for a, b in pairs if b is not None]
            if len(shared) >= COPIED and all(abs(a.u - b.u) + abs(a.v - b.v) < SAME_PX for a, b in shared):
                raise MienError(
                    f"photographs {one.name!r} and {other.name!r}: all {len(shared)} points that both show are clicked "
                    "in the same places, so they are one photograph — take one of them out and add one from another "
                    "side; seen twice from one place, nothing is learnt about depth"
                )


def _check_enough(survey: Survey, targets: Mapping[str, Sequence[Reference]]) -> None:
    """Whether any photograph shows enough references to be placed."""
    if not targets:
        raise MienError(
            "there are no references, so neither cameras nor size can be found — put known places into references.csv "
            "(the eight corners of a cube, say), or tell a [[board]], or of two photographs a [pair] with its scale"
        )
    target_of = {each.name: each.target for each in survey.references}
    shown: dict[tuple[str, str], list[str]] = defaultdict(list)
    for seen in survey.observations:
        if seen.point in target_of:
            shown[seen.photo, target_of[seen.point]].append(seen.point)
    if not shown:
        points = sorted({each.point for each in survey.observations})
        raise MienError(
            f"no photograph shows a reference: references are {listed(each.name for each in survey.references)}, "
            f"clicked are {listed(points) or 'no points at all'} — click the references under their names"
        )
    known = {each.name: each for each in survey.references}
    wanted = {key: _wanted([known[name] for name in names]) for key, names in shown.items()}
    if any(len(names) >= wanted[key] for key, names in shown.items()):
        return
    photo, target = max(shown, key=lambda key: len(shown[key]))
    names = shown[photo, target]
    there = [each.name for each in targets[target] if each.name not in names]
    more = f"click {listed(there)} too" if there else "measure more of them, and click them"
    raise MienError(
        f"photograph {photo!r} shows {len(names)} {'reference' if len(names) == 1 else 'references'} "
        f"({listed(names)}), and no other photograph more — want {wanted[photo, target]} in one photograph at "
        f"least, so that its camera can be found: {more}"
    )


def _wanted(references: Sequence[Reference]) -> int:
    """References that the first photograph must show; fewer where they lie on one plane, which tells less at once."""
    extents = _extents(_places(references))
    flat = references[0].target != WORLD and extents[2] <= FLAT * extents[0]
    return FEWEST_FLAT if flat else FEWEST


def _check_line(target: str, references: Sequence[Reference]) -> None:
    extents = _extents(_places(references))
    if len(references) >= 3 and extents[1] <= LINE * extents[0]:
        where = "in one place" if extents[0] == 0.0 else "on one line"
        raise MienError(
            f"the references{_of(target)} ({listed(each.name for each in references)}) lie {where} — want them spread "
            "in width, height and depth around the face: add some beside it, above it, and before or behind it"
        )


def _of(target: str) -> str:
    return "" if target == WORLD else f" of {target!r}"


def _remarks_on_shape(targets: Mapping[str, Sequence[Reference]]) -> Iterator[str]:
    """References on one plane, or two in one place."""
    for target, references in targets.items():
        places = _places(references)
        extents = _extents(places)
        if target == WORLD and len(references) >= FEWEST_FLAT and extents[2] <= FLAT * extents[0]:
            yield (
                f"the {len(references)} references lie on one plane (within {significant_share(extents)} of their "
                "width): focal lengths and depth are told weakly — add two or more well before or behind it, or "
                "photographs from further to the side"
            )
        order = np.lexsort(places.T)
        for a, b in pairwise(order):
            if (places[a] == places[b]).all():
                yield (
                    f"references {references[a].name!r} and {references[b].name!r}{_of(target)} are said to be in one "
                    f"place ({', '.join(f'{value:g}' for value in places[a])} m) — was a row copied and not changed?"
                )


def significant_share(extents: Points) -> str:
    """The least extent over the largest, in words."""
    return f"{100.0 * extents[2] / extents[0]:.1g} %" if extents[0] > 0.0 else "0 %"


def _remarks_on_spread(survey: Survey) -> Iterator[str]:
    """Photographs in which references keep to a corner, while points lie elsewhere."""
    known = {each.name for each in survey.references}
    clicks: dict[str, list[Observation]] = defaultdict(list)
    for each in survey.observations:
        clicks[each.photo].append(each)
    weak: dict[str, float] = {}
    for photo, seen in clicks.items():
        references = np.array([(each.u, each.v) for each in seen if each.point in known])
        everything = np.array([(each.u, each.v) for each in seen])
        if len(references) < FEWEST_FLAT or len(references) == len(seen):
            continue
        share = float(np.min(np.ptp(references, axis=0) / np.maximum(np.ptp(everything, axis=0), 1.0)))
        if share < SPREAD:
            weak[photo] = share
    if weak:
        worst = min(weak, key=lambda photo: weak[photo])
        yield (
            f"references keep to a part of the picture in {listed(sorted(weak))}: in {worst!r} they reach over "
            f"{100.0 * weak[worst]:.0f} % of what all clicks do, want {100.0 * SPREAD:.0f} % — add references on the "
            "other sides of the face, so that nothing is measured far outside of them"
        )


def _remarks_on_unseen(survey: Survey) -> Iterator[str]:
    """References that nobody sees, and points that only one photograph does."""
    moments = {each.name: each.moment for each in survey.photographs}
    known = {each.name for each in survey.references}
    clicked = {each.point for each in survey.observations}
    unseen = [each.name for each in survey.references if each.name not in clicked and each.target == WORLD]
    if unseen:
        strangers = sorted(clicked - known)
        near = {name: difflib.get_close_matches(name, strangers, n=1, cutoff=0.75) for name in unseen}
        guesses = [f"{name!r} by {match[0]!r}" for name, match in near.items() if match]
        hint = f"; is {listed(guesses)} meant?" if guesses else ""
        pronoun = "it" if len(unseen) == 1 else "them"
        yield f"of the references no photograph shows {listed(unseen)} — click {pronoun}{hint}"
    times = Counter((moments[each.photo], each.point) for each in survey.observations if each.point not in known)
    once: dict[str, list[str]] = defaultdict(list)
    for (moment, point), number in sorted(times.items()):
        if number == 1:
            once[moment].append(point)
    if not once:
        return
    points = list(dict.fromkeys(point for names in once.values() for point in names))
    pronoun = "it" if len(points) == 1 else "them"
    where = f", {listed(f'{len(names)} of {moment}' for moment, names in once.items())}" if len(once) > 1 else ""
    yield (
        f"{_plural(sum(map(len, once.values())), 'point')} clicked in one photograph only{where}, without a place: "
        f"{listed(points)} — click {pronoun} in another one, or look whether names are spelt alike"
    )


def _plural(number: int, noun: str) -> str:
    return f"{number} {noun}{'s' * (number != 1)}"
