"""``mien capture report``: what a solution is worth, on one page."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from . import options

Folder = Annotated[Path, typer.Argument(metavar="DIR", help="A capture project that was solved.")]
Out = Annotated[
    Path | None, typer.Option("-o", "--out", metavar="FILE", help="Page to write.  [default: DIR/solution/report.html]")
]


def report(folder: Folder, out: Out = None, quiet: options.Quiet = False) -> None:
    """Write a page that tells how exact the points of a project are, and what to do better.

    One HTML file with all in it: photographs with residuals as arrows, suspects in red, error ellipsoids of the points,
    where the cameras stood, tables. It asks for nothing from elsewhere and can be sent and printed as it is.

    \b
    mien capture report anna
    mien capture report anna -o anna.html
    """
    from mien.capture.project import read_project, read_solution
    from mien.capture.project_records import SOLUTION
    from mien.capture.report import write_report
    from mien.capture.report_lines import polygons_of
    from mien.core import MienError
    from mien.formats.atomic import check_file

    from .stages import Stages

    stages = Stages(quiet)
    if out is not None and out.suffix.lower() not in (".html", ".htm"):
        raise MienError(f"{out}: the report is a page — want a name that ends in .html")
    project, solution = read_project(folder), read_solution(folder)
    place = out or folder / SOLUTION / "report.html"
    check_file(place)
    polygons = polygons_of(project)
    with stages.progress("photographs") as progress:
        missing = write_report(
            solution, place, name=project.name, unit=project.unit, polygons=polygons, report=progress
        )
    for remark in missing:
        stages.say(remark)
    stages.say(f"{place}: {place.stat().st_size / 1e6:.1f} MB")
