"""Photographs with what was clicked on them: arrows of residuals, names, suspects in red."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from html import escape

import numpy as np

from .records import Photograph, Residual, Solution
from .report_numbers import count, fixed, round_down, significant
from .report_pictures import Crop, Embedded
from .summaries import fitted, rms

Box = tuple[float, float, float, float]

ARROW = 0.025
"""Length of the usual arrow at most, of the width of a photograph."""

LETTER = 1 / 62
"""Height of letters on a photograph, of its width."""

LETTER_SHAPE = 0.58
"""Width of a letter, of its height."""

NAMED = 40
"""Clicks of a photograph up to which names of all are shown at first."""


LABELLED = 150
"""Clicks of a photograph up to which there is room for names; of more, the pointer tells them."""


def arrow_magnification(solution: Solution) -> float:
    """How much longer than they are residuals are drawn, in all photographs alike: 1, 2, 5, 10 …"""
    lengths = [
        math.hypot(each.du, each.dv) / solution.survey.photograph(each.observation.photo).size_px[0]
        for each in fitted(solution)
    ]
    usual = float(np.sqrt(np.mean(np.square(lengths)))) if lengths else 0.0
    return max(round_down(ARROW / usual), 1.0) if usual > 0.0 else 1.0


def format_photograph(photograph: Photograph, solution: Solution, embedded: Embedded, times: float) -> str:
    """A figure: the picture with its arrows, and a line about it."""
    name = photograph.name
    suspects = [each for each in solution.suspects if each.observation.photo == name]
    good = [each for each in fitted(solution) if each.observation.photo == name]
    width, height = photograph.size_px
    unit = max(width, height * 0.75) * LETTER
    picture = (
        f'<image href="{embedded.uri}" width="{width}" height="{height}"/>'
        if embedded.uri
        else f'<rect class="missing" width="{width}" height="{height}"/>'
    )
    known = {reference.name for reference in solution.survey.references}
    marks = "".join(_format_arrow(each, times, unit, each.observation.point in known) for each in good)
    crosses = "".join(_format_suspect(each, unit) for each in suspects)
    names = "".join(_format_names(good, suspects, width, height, unit))
    facts = [count(len(good) + len(suspects), "click"), f"RMS {significant(rms(good), 2)} px"]
    if suspects:
        facts.append(f'<b class="bad">{count(len(suspects), "suspect")}</b>')
    remark = f'<p class="remark">{escape(embedded.remark)}</p>' if embedded.remark else ""
    return (
        f'<figure class="photograph"><svg viewBox="0 0 {width} {height}" style="--px: {unit / 12:.3f}" role="img">'
        f"<title>{escape(name)} with residuals</title>{picture}<g>{marks}</g><g>{crosses}</g>"
        f'<g class="names" font-size="{unit:.1f}">{names}</g></svg>'
        f"<figcaption><b>{escape(name)}</b> {' · '.join(facts)}</figcaption>{remark}</figure>\n"
    )


def _format_arrow(residual: Residual, times: float, unit: float, known: bool) -> str:
    """From where the solution has the point to where it was clicked, magnified; a ring, of references a square."""
    seen = residual.observation
    u, v = seen.u - residual.du, seen.v - residual.dv
    end = (u + residual.du * times, v + residual.dv * times)
    told = escape(f"{seen.point}: {fixed(math.hypot(residual.du, residual.dv), 1)} px")
    size = 0.32 * unit
    mark = (
        f'<rect x="{u - size:.1f}" y="{v - size:.1f}" width="{2 * size:.1f}" height="{2 * size:.1f}"/>'
        if known
        else f'<circle cx="{u:.1f}" cy="{v:.1f}" r="{size:.1f}"/>'
    )
    path = f"M{u:.1f} {v:.1f}L{end[0]:.1f} {end[1]:.1f}{_head((u, v), end, 0.45 * unit)}"
    return f'<g class="arrow"><title>{told}</title>{mark}<path d="{path}"/></g>'


def _head(start: tuple[float, float], end: tuple[float, float], size: float) -> str:
    """The two strokes at the tip of an arrow; none where it is too short for them."""
    length = math.hypot(end[0] - start[0], end[1] - start[1])
    if length < 1.5 * size:
        return ""
    x, y = (end[0] - start[0]) / length * size, (end[1] - start[1]) / length * size
    tips = [(end[0] - x + side * y * 0.5, end[1] - y - side * x * 0.5) for side in (1, -1)]
    return f"M{tips[0][0]:.1f} {tips[0][1]:.1f}L{end[0]:.1f} {end[1]:.1f}L{tips[1][0]:.1f} {tips[1][1]:.1f}"


def _format_suspect(residual: Residual, unit: float) -> str:
    """A cross where it was clicked, a dashed line to a ring where it should have been; not magnified."""
    seen, size = residual.observation, 0.5 * unit
    u, v = seen.u - residual.du, seen.v - residual.dv
    cross = (
        f"M{seen.u - size:.1f} {seen.v - size:.1f}l{2 * size:.1f} {2 * size:.1f}"
        f"M{seen.u - size:.1f} {seen.v + size:.1f}l{2 * size:.1f} {-2 * size:.1f}"
    )
    return (
        f'<g class="suspect"><title>{escape(seen.point)}</title><path class="way" d="M{u:.1f} {v:.1f}L{seen.u:.1f} '
        f'{seen.v:.1f}"/><circle cx="{u:.1f}" cy="{v:.1f}" r="{0.45 * unit:.1f}"/><path d="{cross}"/></g>'
    )


def _format_names(
    good: Sequence[Residual], suspects: Sequence[Residual], width: float, height: float, unit: float
) -> Iterator[str]:
    """Names where there is room: those of suspects always, of others unless they would lie on one another."""
    named = good if len(good) <= LABELLED else []
    taken: list[Box] = [
        (each.observation.u - 0.3 * unit, each.observation.v - 0.3 * unit, 0.6 * unit, 0.6 * unit)
        for each in (*good, *suspects)
    ]
    for each, bad in [(each, True) for each in suspects] + [(each, False) for each in named]:
        seen = each.observation
        place = _room(seen.u, seen.v, len(seen.point) * LETTER_SHAPE * unit, unit, taken, (width, height), bad)
        if place is None:
            continue
        taken.append(place)
        marked = ' class="suspect"' if bad else ""
        yield f'<text{marked} x="{place[0]:.1f}" y="{place[1] + 0.8 * place[3]:.1f}">{escape(seen.point)}</text>'


def _room(
    u: float, v: float, width: float, unit: float, taken: Sequence[Box], paper: tuple[float, float], always: bool
) -> Box | None:
    """A free place for a name around a point: right, left, above, below, the first of them where it must be said."""
    gap = 0.55 * unit
    places: list[Box] = [
        (u + gap, v - unit / 2.0, width, unit),
        (u - gap - width, v - unit / 2.0, width, unit),
        (u - width / 2.0, v - gap - unit, width, unit),
        (u - width / 2.0, v + gap, width, unit),
        (u + gap, v - gap - unit, width, unit),
        (u + gap, v + gap, width, unit),
        (u - gap - width, v - gap - unit, width, unit),
        (u - gap - width, v + gap, width, unit),
    ]
    inside = [box for box in places if box[0] >= 0 and box[1] >= 0 and box[0] + width <= paper[0] and v <= paper[1]]
    free = (box for box in inside if not any(_overlap(box, other) for other in taken))
    return next(free, (inside or places)[0] if always else None)


def _overlap(a: Box, b: Box) -> bool:
    return a[0] < b[0] + b[2] and b[0] < a[0] + a[2] and a[1] < b[1] + b[3] and b[1] < a[1] + a[3]


def format_crop(residual: Residual, crop: Crop) -> str:
    """A piece of a photograph at full size, with where it was clicked and where it should have been."""
    width, height = crop.size_px
    picture = f'<image href="{crop.uri}" x="{crop.u:g}" y="{crop.v:g}" width="{width:g}" height="{height:g}"/>'
    missing = f'<rect class="missing" x="{crop.u:g}" y="{crop.v:g}" width="{width:g}" height="{height:g}"/>'
    unit = width / 18.0
    return (
        f'<svg class="crop" viewBox="{crop.u:g} {crop.v:g} {width:g} {height:g}" style="--px: {unit / 12:.3f}">'
        f"{picture if crop.uri else missing}{_format_suspect(residual, unit)}</svg>"
    )
