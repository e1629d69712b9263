"""Faults that show when the face is drawn at rest: holes outside the face, pupils outside their eyes, things unseen."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from .checks_faults import Fault, Place
from .lines import EYES, Moment, Stretch, rest_of
from .polygons import Contours, Shape
from .records import Character, Floats, Line

SAMPLES = 400
"""Vertices of an outline that are looked for in another one."""


def find_misplaced(character: Character, places: Mapping[str, Place]) -> Iterator[Fault]:
    """Faults of places at rest.

    Args:
        character: of the document, perhaps without polygons that cannot be read.
        places: of the polygons in the document, by id.
    """
    rest = rest_of(character)
    outlines = {polygon.id: Shape(polygon, rest).rest for polygon in character.polygons}
    yield from _holes(character, outlines, places)
    for eye in EYES:
        yield from _pupil(character, rest, eye, outlines, places)
    yield from _unseen(character, outlines, places)


def _holes(character: Character, outlines: dict[str, Contours], places: Mapping[str, Place]) -> Iterator[Fault]:
    faces = [outlines[polygon.id] for polygon in character.polygons if polygon.kind == "face"]
    holes = [polygon for polygon in character.polygons if polygon.kind == "hole"]
    if holes and not faces and character.mode == "strict":
        yield Fault("missing", ("polygons",), "there are holes, but no polygon of kind face that they are cut out of")
    for polygon in holes if faces else ():
        vertices = _sample(np.concatenate(outlines[polygon.id]))
        inside = np.logical_or.reduce([find_inside(vertices, face) for face in faces])
        if inside.all():
            continue
        place = places[polygon.id]
        x, y = vertices[~inside][0]
        what = "crosses the outline of the face" if inside.any() else "lies wholly outside the face"
        strict = character.mode == "strict" or not inside.any()
        yield Fault("hole", place, f"{what}, as at ({x:g}, {y:g})", severity="error" if strict else "warning")


def _pupil(
    character: Character, rest: Moment, eye: str, outlines: dict[str, Contours], places: Mapping[str, Place]
) -> Iterator[Fault]:
    pupil = f"P{eye[1]}"
    lids = (Stretch(Line(eye, lower=lower), character.features[eye]) for lower in (False, True))
    upper, lower = (lid.points(rest) for lid in lids)
    opening = (np.concatenate([upper, lower[::-1]]),)
    point = np.array(character.features[pupil].points[pupil])
    place: Place = ("features", pupil, "points", pupil)
    if not find_inside(point[None], opening)[0]:
        yield Fault("pupil", place, f"is not inside the eye {eye}", got=f"({point[0]:g}, {point[1]:g})")
        return
    drawn = [polygon for polygon in character.polygons if polygon.kind == "pupil" and polygon.feature == pupil]
    for polygon in drawn:
        corners = np.concatenate(outlines[polygon.id])
        middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
        if not polygon.clip and not find_inside(middle[None], opening)[0]:
            what = f"its middle is not inside the eye {eye}"
            yield Fault("pupil", places[polygon.id], what, got=f"({middle[0]:g}, {middle[1]:g})")
    if character.mode == "strict" or not any(not polygon.clip for polygon in drawn):
        return
    for code in (f"{pupil}H", f"{pupil}V"):
        limits = character.motors[code]
        for key, offset in (("min", limits.low), ("max", limits.high)):
            moved = point - (np.array([offset, 0.0]) if code.endswith("H") else np.array([0.0, offset]))
            if not find_inside(moved[None], opening)[0]:
                yield Fault("gaze", ("motors", code, key), f"takes the pupil out of the eye {eye}", got=f"{offset:g}")


def _unseen(character: Character, outlines: dict[str, Contours], places: Mapping[str, Place]) -> Iterator[Fault]:
    size = np.array(character.size)
    for polygon in character.polygons:
        vertices = np.concatenate(outlines[polygon.id])
        moving = polygon.drivers or polygon.part or polygon.low
        if not moving and ((vertices.max(axis=0) < 0.0) | (vertices.min(axis=0) > size)).any():
            x, y = vertices.mean(axis=0)
            what = "lies outside the canvas"
            wanted = f"something within {size[0]:g} x {size[1]:g}"
            yield Fault("canvas", places[polygon.id], what, wanted, f"about ({x:.4g}, {y:.4g})")
    if ((np.array(character.head.center) < 0.0) | (np.array(character.head.center) > size)).any():
        yield Fault("canvas", ("head", "center"), "lies outside the canvas", f"within {size[0]:g} x {size[1]:g}")


def find_inside(points: Floats, contours: Contours) -> np.ndarray:
    """(N,) whether points (N, 2) are inside contours, by how often these wind about them."""
    winding = np.zeros(len(points), dtype=np.int64)
    x, y = points[:, :1], points[:, 1:]
    for contour in contours:
        start, end = contour, np.roll(contour, -1, axis=0)
        side = (end[:, 0] - start[:, 0]) * (y - start[:, 1]) - (x - start[:, 0]) * (end[:, 1] - start[:, 1])
        rising = (start[:, 1] <= y) & (y < end[:, 1]) & (side > 0.0)
        falling = (end[:, 1] <= y) & (y < start[:, 1]) & (side < 0.0)
        winding += rising.sum(axis=1) - falling.sum(axis=1)
    return winding != 0


def _sample(vertices: Floats) -> Floats:
    return vertices[:: max(1, len(vertices) // SAMPLES)]
