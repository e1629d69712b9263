"""What a solution is worth, as one page that needs nothing else: photographs with residuals, ellipsoids, tables."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from importlib import resources
from pathlib import Path

import numpy as np

from mien.formats.atomic import writing
from mien.formats.notes import software

from .records import Residual, Solution, SolvedPoint
from .report_lines import Edges, edges_of
from .report_numbers import REFERENCE, Exactness, Unit, count, significant
from .report_photographs import NAMED, arrow_magnification, format_photograph
from .report_pictures import Embedded, embed
from .report_tables import format_crops, format_lenses, format_photographs, format_points, format_suspects
from .report_views import CHI2_95, Standpoint, format_plan, format_views, references_of, standpoint
from .report_words import explanations, lead
from .summaries import measured

POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
"""The page asks no other machine for anything."""

MANY = 24
"""Photographs from which on their table is folded away."""

LONG = 400
"""Rows of a table from which on it is folded away."""


def write_report(
    solution: Solution,
    out: Path | str,
    *,
    name: str = "",
    unit: str = "mm",
    pictures: Mapping[str, Path] | None = None,
    polygons: Sequence[Sequence[str]] = (),
    report: Callable[[int, int], None] | None = None,
) -> tuple[str, ...]:
    """Writes the page; what could not be shown, a sentence each.

    Args:
        solution: what was found.
        out: the HTML file to write.
        name: of the project, its title.
        unit: of lengths: m, cm, mm or inch.
        pictures: files of photographs by name; those of others are where the survey says.
        polygons: of names of points, drawn as lines between them; without any, neighbours are joined.
        report: is told how many photographs are done, of how many.

    Raises:
        UnknownNameError: there is no such unit.
        MienError: the file cannot be written.
    """
    measure = Unit.of(unit, solution)
    embedded = embed(solution.survey.photographs, pictures or {}, solution.suspects, report)
    sheet = _Sheet(solution, name, measure, embedded, polygons)
    with writing(out) as place:
        place.write_text("".join(sheet.format()), encoding="utf-8", newline="\n")
    return sheet.missing


@dataclass(frozen=True, eq=False)
class _Sheet:
    """A page to be written."""

    solution: Solution
    name: str
    unit: Unit
    embedded: Mapping[str, Embedded]
    polygons: Sequence[Sequence[str]]

    @property
    def missing(self) -> tuple[str, ...]:
        return tuple(each.remark for each in self.embedded.values() if each.remark)

    @property
    def title(self) -> str:
        return self.name or "Points from photographs"

    def format(self) -> Iterator[str]:
        exactness = Exactness.of(self.solution)
        yield _format_head(self.title)
        yield from self._format_summary(exactness)
        yield _section("Lenses", format_lenses(self.solution) + _ASSUMED)
        number = len(self.solution.survey.photographs)
        table = format_photographs(self.solution, self.unit)
        yield _section("Photographs", _folded(number > MANY, count(number, "photograph"), table, False))
        if self.solution.suspects:
            yield self._format_suspects(self.solution.suspects)
        yield self._format_pictures()
        yield self._format_moments()
        points = sorted(measured(self.solution), key=lambda each: (each.moment, each.name))
        known = sorted(
            (each for each in self.solution.points.values() if each.kind == REFERENCE),
            key=lambda each: (each.moment, each.name),
        )
        if points:
            table = _folded(len(points) > LONG, count(len(points), "point"), format_points(points, self.unit), False)
            yield _section("Points", _POINTS + table)
        if known:
            yield _folded(True, count(len(known), "reference"), format_points(known, self.unit), False)
        yield f"</main>\n<footer>{escape(software())}</footer>\n<script>\n{_data('report.js')}</script>\n"
        yield "</body>\n</html>\n"

    def _format_summary(self, exactness: Exactness) -> Iterator[str]:
        yield f'<header><p class="kind">Points from photographs</p><h1>{escape(self.title)}</h1>'
        yield f'<p class="lead">{escape(lead(exactness, self.unit))}</p>'
        yield "".join(f"<p>{escape(text)}</p>" for text in explanations(self.solution, exactness))
        figures = [
            (f"{self.unit.length(exactness.point_rms_m)}", "σ of a coordinate, RMS"),
            (f"{significant(100 * exactness.share, 2)} %", f"of what the {exactness.spanned} span"),
            (f"{significant(exactness.residual_rms_px, 2)} px", "residuals, RMS"),
            (significant(exactness.chi2_per_dof), "χ² per degree of freedom"),
            (str(len(self.solution.cameras)), "photographs placed"),
            (f"{exactness.suspects} of {exactness.clicks}", "clicks suspect"),
        ]
        shown = figures if exactness.points else figures[2:]
        yield "<dl>" + "".join(f"<div><dt>{escape(t)}</dt><dd>{escape(v)}</dd></div>" for v, t in shown) + "</dl>"
        remarks = (*self.solution.remarks, *self.missing)
        if remarks:
            items = "".join(f"<li>{escape(remark)}</li>" for remark in remarks)
            yield f'<section class="remarks"><h2>What was assumed, what to do better</h2><ul>{items}</ul></section>'
        yield "</header>\n<main>\n"

    def _format_suspects(self, suspects: Sequence[Residual]) -> str:
        told = (
            "<p>These clicks took no part. The cross is where it was clicked, the ring where all others have the "
            "point. Click them again, or look whether two names were exchanged.</p>"
        )
        return _section("Suspects", told + format_crops(suspects, self.embedded) + format_suspects(suspects))

    def _format_pictures(self) -> str:
        times = arrow_magnification(self.solution)
        most = max(Counter(each.photo for each in self.solution.survey.observations).values(), default=0)
        checked = " checked" if most <= NAMED else ""
        told = (
            f"<p>Arrows lead from where the solution has a point to where it was clicked, <b>{times:g} times</b> as "
            "long as they are. Rings are points, squares are references; suspects are red and not magnified. "
            "A click makes a photograph large. "
            f'<label><input type="checkbox" id="names"{checked}> names</label></p>'
        )
        groups: dict[str, list[str]] = {}
        for each in self.solution.survey.photographs:
            figure = format_photograph(each, self.solution, self.embedded[each.name], times)
            groups.setdefault(each.moment, []).append(figure)
        shown = (
            _folded(len(groups) > 1, moment, f'<div class="photographs">\n{"".join(figures)}</div>\n', number == 0)
            for number, (moment, figures) in enumerate(groups.items())
        )
        return _section("Residuals", told + "".join(shown))

    def _format_moments(self) -> str:
        moments = list(dict.fromkeys(each.moment for each in self.solution.survey.photographs))
        drawn: list[str] = []
        for moment in moments:
            references = references_of(self.solution, moment)
            own = [each for each in measured(self.solution) if each.moment == moment]
            if not (own or references):
                continue
            inside = self._format_moment(own or references, references if own else [], moment)
            drawn.append(_folded(len(moments) > 1, moment, inside, not drawn))
        return _section("In space", "".join(drawn)) if drawn else ""

    def _format_moment(self, points: list[SolvedPoint], references: list[SolvedPoint], moment: str) -> str:
        names = [each.name for each in points]
        edges = edges_of(names, np.array([each.place for each in points]), self.polygons)
        center = standpoint(self.solution, points)
        figures, times = format_views(center, points, edges, self.unit, references)
        joined = "the topology" if self.polygons else "neighbours, to guide the eye"
        magnified = f", drawn <b>{times:g} times</b> as large as they are" if times > 1.0 else ""
        kinds = "".join(_KINDS[kind] for kind in dict.fromkeys(each.kind for each in points) if kind in _KINDS)
        told = (
            f"<p>The true place lies within its ellipsoid 19 times in 20{magnified}. Lines join {joined}; front is "
            f"where the cameras are. {kinds}</p>"
        )
        data = self._data_of(center, points, references, edges, times)
        orbit = (
            '<figure class="orbit" hidden><canvas width="800" height="560" tabindex="0" role="img" '
            'aria-label="Points in space; drag or use the arrow keys to turn, plus and minus to come nearer">'
            "</canvas><figcaption>drag to turn, scroll to come nearer · <span></span></figcaption>"
            f'<script type="application/json">{data}</script></figure>'
        )
        own = {
            each.name: self.solution.cameras[each.name]
            for each in self.solution.survey.photographs
            if each.moment == moment and each.name in self.solution.cameras
        }
        plan = format_plan(own, center, [*points, *references], self.unit)
        if plan:
            plan = f'<figure class="plan">{plan}<figcaption>from above, with cameras</figcaption></figure>'
        return f'{told}<div class="views">{figures}</div><div class="spaces">{orbit}{plan}</div>'

    def _data_of(
        self,
        center: Standpoint,
        points: Sequence[SolvedPoint],
        references: Sequence[SolvedPoint],
        edges: Edges,
        times: float,
    ) -> str:
        """What the canvas draws, in the frame of the view and units of the report."""
        scale = 1.0 / self.unit.metres

        def described(point: SolvedPoint) -> dict[str, object]:
            place = center.places(point.place[None])[0] * scale
            covariance = center.rows @ point.covariance @ center.rows.T * scale**2
            upper = covariance[np.triu_indices(3)]
            return {
                "name": point.name,
                "kind": point.kind,
                "at": [float(f"{value:.7g}") for value in place],
                "spread": [float(f"{value:.4g}") for value in upper],
            }

        data = {
            "points": [described(each) for each in points],
            "references": [described(each) for each in references],
            "edges": edges,
            "times": times,
            "reach": CHI2_95**0.5,
            "unit": self.unit.name,
            "decimals": self.unit.decimals,
        }
        return json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")


_ASSUMED = (
    '<p class="note"><span class="assumed">Grey and slanted</span>: assumed, not found from the clicks. '
    "Degrees are the angle of view of the longer side.</p>"
)

_POINTS = (
    '<p class="note">A click on a head sorts by it. σ is the standard deviation of a coordinate, in the unit of '
    "the places; the last one is the root mean square of the three.</p>"
)

_KINDS: Mapping[str, str] = {
    "mirrored": "Mirrored points (green) are images of their twins. ",
    "symmetric": "Symmetric points (violet) are seen once, their depth is their twin's. ",
    "modelled": "Modelled points (orange) are seen once, their depth is guessed from neighbours. ",
}


def _format_head(title: str) -> str:
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f'<meta name="color-scheme" content="light dark">\n<title>{escape(title)}</title>\n'
        f'<meta name="generator" content="{escape(software())}">\n'
        f"<style>\n{_data('report.css')}</style>\n</head>\n<body>\n"
    )


def _folded(folds: bool, title: str, inside: str, is_open: bool) -> str:
    """What can be folded away under its title, if it is to be."""
    opened = " open" if is_open else ""
    return f"<details{opened}><summary>{escape(title)}</summary>\n{inside}</details>\n" if folds else inside


def _section(title: str, inside: str) -> str:
    return f"<section><h2>{escape(title)}</h2>\n{inside}</section>\n"


def _data(name: str) -> str:
    return resources.files(__package__).joinpath(f"data/{name}").read_text(encoding="utf-8")
