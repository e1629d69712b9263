"""Tables of a report: photographs with their lenses, suspects, points."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from html import escape

import numpy as np

from .records import Camera, Residual, Solution, SolvedPoint
from .report_numbers import Unit, fixed, significant
from .report_photographs import format_crop
from .report_pictures import Embedded
from .summaries import errors_by_photo, measured, sigma_m

CROPS = 60
"""Suspects that are shown in a picture; the others are in the table."""

ENDLESS = 1e6
"""Focal lengths (px) and distances (units) from here on stand for parallel rays."""

Cell = tuple[str, str]
"""HTML of a cell, and what it is sorted by."""


def format_lenses(solution: Solution) -> str:
    """Lenses: one row for each camera, its terms told apart by whether they were found or assumed."""
    heads = [
        "camera",
        "photographs",
        "size, px",
        "focal length, px",
        "principal point, px",
        "k1",
        "k2",
        "p1, p2",
        "aspect",
    ]
    rows = []
    for name in dict.fromkeys(each.camera for each in solution.survey.photographs):
        own = [each for each in solution.survey.photographs if each.camera == name]
        camera = next((solution.cameras[each.name] for each in own if each.name in solution.cameras), None)
        size = "{} × {}".format(*own[0].size_px)
        row = [_text(name), _integer(len(own)), (size, str(own[0].size_px[0]))]
        rows.append(row + (_lens_cells(camera, own[0].size_px) if camera else [("not placed", "")] + [("", "")] * 5))
    return _format_table(heads, rows, texts=1)


def format_photographs(solution: Solution, unit: Unit) -> str:
    """Photographs: how far away, how many clicks, how well they fit."""
    heads = ["photograph", "moment", "camera", f"distance, {unit.name}", "clicks", "suspect", "RMS, px"]
    errors = errors_by_photo(solution)
    clicks = Counter(each.photo for each in solution.survey.observations)
    suspects = Counter(each.observation.photo for each in solution.suspects)
    rows = []
    for each in solution.survey.photographs:
        name = each.name
        distance = _distance(solution.cameras[name], solution, each.moment) if name in solution.cameras else math.nan
        rows.append(
            [
                _text(name),
                _text(each.moment),
                _text(each.camera),
                (_far(distance / unit.metres), str(distance)) if math.isfinite(distance) else ("not placed", ""),
                _integer(clicks[name]),
                (f'<b class="bad">{suspects[name]}</b>', str(suspects[name])) if suspects[name] else _integer(0),
                (fixed(errors[name], 2), str(errors[name])) if name in errors else ("", ""),
            ]
        )
    return _format_table(heads, rows, texts=3)


def _far(length: float) -> str:
    return significant(length) if length < ENDLESS else "very far"


def _lens_cells(camera: Camera, size_px: tuple[int, int]) -> list[Cell]:
    lens, (width, height) = camera.lens, size_px
    u, v = lens.principal_px
    angle = 2.0 * math.degrees(math.atan(max(width, height) / 2.0 / lens.focal_px))
    focal = f"{fixed(lens.focal_px, 1)} <small>{angle:.0f}°</small>"
    values = {
        "focal": (focal if lens.focal_px < ENDLESS else "orthographic", lens.focal_px),
        "principal": (f"{fixed(u, 1)}, {fixed(v, 1)}", math.hypot(u - width / 2.0, v - height / 2.0)),
        "k1": (fixed(lens.k1, 4), lens.k1),
        "k2": (fixed(lens.k2, 4), lens.k2),
        "decentring": (f"{fixed(lens.p1, 4)}, {fixed(lens.p2, 4)}", math.hypot(lens.p1, lens.p2)),
        "aspect": (fixed(lens.aspect, 4), lens.aspect),
    }
    return [
        (told if term in lens.freed else f'<span class="assumed">{told}</span>', str(value))
        for term, (told, value) in values.items()
    ]


def _distance(camera: Camera, solution: Solution, moment: str) -> float:
    """From the camera to the middle of the points, m."""
    places = [point.place for point in measured(solution) if point.moment == moment]
    places = places or [point.place for (at, _), point in solution.points.items() if at == moment]
    if not places:
        return math.nan
    return float(np.linalg.norm(np.mean(places, axis=0) - camera.place))


def format_suspects(suspects: Sequence[Residual]) -> str:
    """Clicks that do not fit, with the places where the others have them."""
    heads = ("photograph", "point", "line", "clicked, px", "expected, px", "off, px", "off, sigmas")
    rows = []
    for each in suspects:
        seen = each.observation
        off = math.hypot(each.du, each.dv)
        rows.append(
            [
                _text(seen.photo),
                _text(seen.point),
                (str(seen.line) if seen.line else "", str(seen.line)),
                (f"{fixed(seen.u, 1)}, {fixed(seen.v, 1)}", str(seen.u)),
                (f"{fixed(seen.u - each.du, 1)}, {fixed(seen.v - each.dv, 1)}", str(seen.u - each.du)),
                (fixed(off, 1), str(off)),
                (significant(math.sqrt(max(each.statistic, 0.0)), 2), str(each.statistic)),
            ]
        )
    return _format_table(heads, rows, texts=2)


def format_crops(suspects: Sequence[Residual], embedded: Mapping[str, Embedded]) -> str:
    """Pictures of suspects at full size, the worst first."""
    left = {name: iter(each.crops) for name, each in embedded.items()}
    figures: list[str] = []
    for each in suspects:
        seen = each.observation
        crop = next(left[seen.photo], None) if seen.photo in left else None
        if crop is None or not crop.uri or len(figures) == CROPS:
            continue
        figures.append(
            f"<figure>{format_crop(each, crop)}<figcaption><b>{escape(seen.point)}</b> in {escape(seen.photo)}, "
            f"{significant(math.hypot(each.du, each.dv), 2)} px off</figcaption></figure>"
        )
    return f'<div class="crops">{"".join(figures)}</div>\n' if figures else ""


def format_points(points: Sequence[SolvedPoint], unit: Unit) -> str:
    """Points with their places, standard deviations and what they were found from."""
    heads = ("moment", "point", *(f"{axis}, {unit.name}" for axis in "xyz"))
    heads += (*(f"σ{axis}" for axis in "xyz"), "σ", "kind", "photographs")
    rows = []
    for each in points:
        deviations = np.sqrt(np.maximum(np.diag(each.covariance), 0.0)).tolist()
        lengths = [*each.place.tolist(), *deviations, sigma_m(each)]
        cells = [(unit.number(value), repr(float(value))) for value in lengths]
        seen = f'<span title="{escape(", ".join(each.photos), quote=True)}">{len(each.photos)}</span>'
        rows.append([_text(each.moment), _text(each.name), *cells, _text(each.kind), (seen, str(len(each.photos)))])
    return _format_table(heads, rows, texts=2)


def _text(text: str) -> Cell:
    return escape(text), ""


def _integer(number: int) -> Cell:
    return str(number), str(number)


def _format_table(heads: Sequence[str], rows: Sequence[Sequence[Cell]], texts: int) -> str:
    """A table that is sorted by a click on a head; the first cells of a row are words, the others numbers."""
    titles = "".join(
        f'<th scope="col"{_class(k, texts)}><button type="button">{escape(head)}</button></th>'
        for k, head in enumerate(heads)
    )
    lines = []
    for row in rows:
        cells = "".join(f"<td{_class(k, texts)}{_key(key)}>{content}</td>" for k, (content, key) in enumerate(row))
        lines.append(f"<tr>{cells}</tr>\n")
    return (
        f'<div class="scroll"><table class="sortable"><thead><tr>{titles}</tr></thead>\n<tbody>\n'
        f"{''.join(lines)}</tbody></table></div>\n"
    )


def _class(column: int, texts: int) -> str:
    return "" if column < texts else ' class="number"'


def _key(key: str) -> str:
    return f' data-key="{escape(key, quote=True)}"' if key else ""
