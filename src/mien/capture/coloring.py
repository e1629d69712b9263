"""Colours of polygons, taken from photographs; what does not belong to them is ignored."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from mien.faces.keypose.records import KeyposeTopology, Polygon

from .guessing import edges_of
from .projecting import project
from .records import Solution

Floats = NDArray[np.float64]
Picture = NDArray[np.uint8]

SEEN_SHARE, SQUARE = 0.6, 4
"""Share of a polygon's corners that must be seen in a photograph for its colour to be taken there; of one with no more
corners than a square all."""
INNER = (0.15, 0.35, 0.55)
"""How far from its middle towards its corners a polygon is looked at: dots at the corners are not its colour."""
LEAST_PX = 3.0
"""A polygon that is narrower, or turns its back, is not looked at."""
OUTLIER = 2.5
"""Colours farther from the median than so many median distances are ignored."""
MOST = 0.5
"""Share of the polygons drafted alike that must be seen for the others to be coloured like them."""
STEPS, SHARE = 4, 0.5
"""Steps of evening out, and how far each goes."""


def sample_colors(
    solution: Solution,
    topology: KeyposeTopology,
    names: Sequence[str],
    picture_of: Callable[[str], Picture],
    report: Callable[[str], None] = lambda _: None,
) -> tuple[Floats, NDArray[np.int64]]:
    """Colours (F, 3) sRGB 0..255, nan where a polygon is nowhere seen, and how many looks they come from (F,).

    A polygon is looked at in those photographs in which most of its corners were clicked.

    Args:
        solution: cameras and points.
        topology: of the face.
        names: of its points, by number.
        picture_of: gives the (H, W, 3) sRGB picture of a photograph.
        report: is told which photograph is looked at.
    """
    rows = [np.array(polygon.points) - 1 for polygon in topology.polygons]
    looks: list[list[Floats]] = [[] for _ in rows]
    clicked: dict[str, set[str]] = {}
    for observation in solution.survey.observations:
        clicked.setdefault(observation.photo, set()).add(observation.point)
    for photograph in solution.survey.photographs:
        camera = solution.cameras.get(photograph.name)
        if camera is None:
            continue
        report(photograph.name)
        picture = picture_of(photograph.name)
        places = {name: point.place for (moment, name), point in solution.points.items() if moment == photograph.moment}
        seen = np.array([name in clicked.get(photograph.name, ()) and name in places for name in names])
        at = np.full((len(names), 2), np.nan)
        known = [k for k, name in enumerate(names) if name in places]
        at[known] = project(camera, np.array([places[names[k]] for k in known]))
        for row, found in zip(rows, looks, strict=True):
            if seen[row].mean() >= (SEEN_SHARE if len(row) > SQUARE else 1.0):
                found += _looks(at[row[np.isfinite(at[row, 0])]], picture)
    colors = np.array([middle_color(np.array(found)) if found else np.full(3, np.nan) for found in looks])
    return colors, np.array([len(found) for found in looks])


def _looks(corners: Floats, picture: Picture) -> Iterator[Floats]:
    """Colours of pixels inside of a polygon whose corners (n, 2) px are."""
    middle = corners.mean(axis=0)
    if len(corners) < 3 or _area(corners) < LEAST_PX * 2.0 * np.linalg.norm(corners - middle, axis=1).max():
        return
    height, width = picture.shape[:2]
    for share in INNER:
        for corner in corners:
            u, v = np.floor(middle + share * (corner - middle)).astype(int)
            if 0 <= u < width and 0 <= v < height:
                yield picture[v, u].astype(np.float64)


def _area(corners: Floats) -> float:
    """Px², negative where corners (n, 2) px, clockwise from outside, are seen from behind."""
    u, v = corners.T
    return 0.5 * float((u * np.roll(v, -1) - np.roll(u, -1) * v).sum())


def middle_color(looks: Floats) -> Floats:
    """(3,) mean of colours (n, 3) without those that lie far from their median."""
    median = np.median(looks, axis=0)
    away = np.linalg.norm(looks - median, axis=1)
    kept = away <= OUTLIER * max(float(np.median(away)), 2.0)
    return np.asarray(looks[kept].mean(axis=0))


def even_out(colors: Floats, topology: KeyposeTopology) -> Floats:
    """Colours (F, 3) of polygons, evened out among neighbours that were drafted in the same colour.

    Polygons that were not seen (nan) get the middle of those drafted alike, or where most of them hide as well, such as
    the inside of a mouth, the colour that they were drafted in.
    """
    polygons = topology.polygons
    groups: dict[tuple[str, str], list[int]] = {}
    for number, (part, polygon) in enumerate(_with_parts(topology)):
        groups.setdefault((part, polygon.color), []).append(number)
    out = colors.copy()
    for (_, draft), numbers in groups.items():
        index = np.array(numbers)
        seen = index[np.isfinite(colors[index, 0])]
        usual = np.median(colors[seen], axis=0) if len(seen) >= MOST * len(index) else _rgb(draft)
        out[index[~np.isfinite(colors[index, 0])]] = usual
        pairs = _beside([polygons[number] for number in numbers])
        for _ in range(STEPS if len(pairs) else 0):
            total, count = np.zeros((len(index), 3)), np.zeros(len(index))
            for a, b in ((0, 1), (1, 0)):
                np.add.at(total, pairs[:, a], out[index[pairs[:, b]]])
                np.add.at(count, pairs[:, a], 1.0)
            mean = total / np.maximum(count, 1.0)[:, None]
            out[index] += np.where(count[:, None] > 0, SHARE * (mean - out[index]), 0.0)
    return out


def hex_color(rgb: Floats) -> str:
    """``#rrggbb`` of a colour 0..255."""
    red, green, blue = np.clip(np.rint(rgb), 0, 255).astype(int).tolist()
    return f"#{red:02x}{green:02x}{blue:02x}"


def _rgb(code: str) -> Floats:
    return np.array([int(code[k : k + 2], 16) for k in (1, 3, 5)], dtype=np.float64)


def _with_parts(topology: KeyposeTopology) -> Iterator[tuple[str, Polygon]]:
    for part in topology.parts:
        for polygon in part.polygons:
            yield part.name, polygon


def _beside(polygons: Sequence[Polygon]) -> NDArray[np.int64]:
    """(P, 2) pairs of polygons with an edge in common."""
    at: dict[tuple[int, int], int] = {}
    pairs = []
    for number, polygon in enumerate(polygons):
        for a, b in edges_of([polygon.points]).tolist():
            other = at.setdefault((a, b), number)
            if other != number:
                pairs.append((other, number))
    return np.array(pairs, dtype=np.int64).reshape(-1, 2)
