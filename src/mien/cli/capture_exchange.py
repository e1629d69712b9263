"""``mien capture import`` and ``export``: clicks of other programs, and ours for them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from . import options
from .capture_solve import Folder

Origin = Annotated[
    str,
    typer.Option(
        "--origin", metavar="CORNER", help="Where pixels count from: upper-left (DLTdv8) or lower-left (older, Argus)."
    ),
]


def import_points(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Clicks of DLTdv or Argus, such as trial_xypts.csv.")],
    folder: Folder,
    origin: Origin = "upper-left",
    frames: Annotated[
        str | None, typer.Option("--frames", metavar="N,N…", help="Rows of the file, from 1, one for each moment.")
    ] = None,
    names: Annotated[
        str | None, typer.Option("--names", metavar="A,B,…", help="What its points are called, in their order.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace points that are there.")] = False,
    quiet: options.Quiet = False,
) -> None:
    """Add clicks of DLTdv or Argus to the points.csv of a project.

    Camera 1, 2, … are those of project.toml in their order, and rows its moments. A file trial_pointnames.csv beside
    trial_xypts.csv (columns point, name) names the points, or --names.

    \b
    mien capture import trial_xypts.csv anna
    mien capture import argus-xypts.csv anna --origin lower-left --frames 12,340
    """
    from mien.capture.exchanging import add_points
    from mien.capture.project import read_project

    from .stages import Stages

    rows = [] if frames is None else _parse_frames(frames)
    called = [] if names is None else [name.strip() for name in names.split(",")]
    added, points = add_points(
        read_project(folder), file, origin=origin, frames=rows, names=called, replace_points=force
    )
    stages = Stages(quiet)
    stages.say(f"{folder / 'points.csv'}: clicks added: {added}; {', '.join(points[:8])}{' …' * (len(points) > 8)}")


def _parse_frames(text: str) -> list[int]:
    from mien.core import MienError

    parts = [part.strip() for part in text.split(",")]
    if not all(part.isdecimal() and int(part) > 0 for part in parts) or len(set(parts)) != len(parts):
        raise MienError(f"--frames: want different rows from 1, as in 12,340, got {text!r}")
    return [int(part) for part in parts]


def export_points(
    folder: Folder,
    out: Annotated[
        Path, typer.Option("-o", "--out", metavar="OUT", help="Its name ends in xypts.csv, xyzpts.csv or dltCoefs.csv.")
    ],
    origin: Origin = "upper-left",
    quiet: options.Quiet = False,
) -> None:
    """Write clicks, points or cameras of a project for DLTdv, Argus and easyWand.

    The name of OUT picks what: …xypts.csv clicks, …xyzpts.csv points in the unit of the project, …dltCoefs.csv the 11
    coefficients of each camera, without the distortion of its lens. A file …_pointnames.csv beside it names the points.

    \b
    mien capture export anna -o anna_xypts.csv
    mien capture export anna -o anna_dltCoefs.csv
    """
    from mien.capture.exchanging import export

    from .stages import Stages

    for text in export(folder, out, origin=origin):
        Stages(quiet).say(text)
