"""Faults that show only when the face moves, found by playing poses drawn by chance and poses with motors at an end."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import count, islice

import numpy as np

from mien.core import MienError, Pose

from .checks_faults import Fault, Place
from .lines import rest_of
from .motors import motors
from .polygons import Shape
from .toon import ToonFace

POSES, SEED = 300, 1996

WILD = 1.0
"""How far out of the canvas a polygon may go, in sizes of the canvas: our choice."""

Values = Mapping[str, float]


def find_wild_poses(face: ToonFace, places: Mapping[str, Place], poses: int = POSES) -> Iterator[Fault]:
    """Polygons that have no finite place in some pose, or one far away; each with the least that makes it so.

    Args:
        face: without faults at rest.
        places: of the polygons in the document, by id.
        poses: how many are tried.
    """
    reach = _reaches(face)
    told: set[str] = set()
    for values in islice(_poses(reach), poses):
        for name, rule in _misbehaving(face, values).items():
            if name in told:
                continue
            told.add(name)
            least = _simplify(face, values, name, rule)
            pose = ", ".join(f"{code} {value:.3g}" for code, value in least.items())
            what = "has no finite place" if rule == "pose" else "goes far out of the canvas"
            yield Fault(rule, places[name], f"{name!r} {what}", got=pose or "the pose at rest")


def _reaches(face: ToonFace) -> dict[str, tuple[float, float]]:
    table = face.parameters
    rows = {code: table[motors()[code].parameter] for code in face.character.motors}
    return {code: (row.low, row.high) for code, row in rows.items()}


def _poses(reach: Mapping[str, tuple[float, float]]) -> Iterator[dict[str, float]]:
    """Each motor at each end, then without end poses in which every motor is at an end or anywhere."""
    for code, ends in reach.items():
        yield from ({code: end} for end in ends)
    generator = np.random.default_rng(SEED)
    for number in count():
        shares = generator.uniform(0.0, 1.0, len(reach))
        if number % 2:
            shares = np.round(shares)
        yield {
            code: low + float(share) * (high - low)
            for (code, (low, high)), share in zip(reach.items(), shares, strict=True)
        }


def _misbehaving(face: ToonFace, values: Values) -> dict[str, str]:
    """The rule that each polygon breaks in a pose, by id."""
    pose = face.neutral.replace({motors()[code].parameter: value for code, value in values.items()})
    with np.errstate(all="ignore"):
        return _broken(face, pose)


def _broken(face: ToonFace, pose: Pose) -> dict[str, str]:
    try:
        drawing = face.shape(pose)
    except MienError:
        return dict.fromkeys(_infinite(face, pose), "pose")
    low, high = -WILD * np.array(face.character.size), (1.0 + WILD) * np.array(face.character.size)
    spans = {path.name: np.concatenate(path.contours) for path in drawing.paths}
    return {
        name: "wild" for name, points in spans.items() if (points.min(0) < low).any() or (points.max(0) > high).any()
    }


def _infinite(face: ToonFace, pose: Pose) -> list[str]:
    """Ids of the polygons that are not finite before the head turns, or of all when only the turn makes them so."""
    moment = face.moment(pose)
    rest = rest_of(face.character)
    traced = {polygon.id: Shape(polygon, rest).contours(moment) for polygon in face.character.polygons}
    found = [name for name, each in traced.items() if not all(np.isfinite(contour).all() for contour in each)]
    return found or list(traced)


def _simplify(face: ToonFace, values: Values, name: str, rule: str) -> Values:
    """The values without those that have no part in the fault."""
    least = dict(values)
    for code in values:
        fewer = {key: value for key, value in least.items() if key != code}
        if _misbehaving(face, fewer).get(name) == rule:
            least = fewer
    return least
