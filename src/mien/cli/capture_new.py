"""``mien capture new``: a folder to fill in."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from . import options

CUBE_INCHES = 10.0
"""Edge of the cube of 1974."""


def new(
    folder: Annotated[
        Path, typer.Argument(metavar="DIR", help="Folder to make, or the one that holds the photographs.")
    ],
    photos: Annotated[list[Path], typer.Argument(metavar="PHOTO…", help="Pictures: JPEG, PNG, TIFF, WebP.")],
    unit: Annotated[
        str, typer.Option("--unit", metavar="U", help="Of lengths in its files: mm, cm, m or inch.")
    ] = "mm",
    cube: Annotated[
        float | None,
        typer.Option("--cube", metavar="EDGE", help="Edge of the cube in the pictures.  [default: 10 inches]"),
    ] = None,
    pair: Annotated[bool, typer.Option("--pair", help="A front and a side photograph, without a cube.")] = False,
    quiet: options.Quiet = False,
) -> None:
    """Begin a project: a folder with the photographs, what can be guessed about them, and files to fill in.

    Names tell moments: smile-1.jpg and smile-2.jpg are two views of the moment smile. references.csv gets the corners
    of a cube, to be edited; whatever else has known places (surveyed marks) goes there too, and boards go into
    project.toml.

    \b
    mien capture new anna photos/*.jpg
    mien capture new anna photos/*.jpg --cube 300
    mien capture new anna front.jpg side.jpg --pair
    """
    from mien.capture.project_new import begin_project
    from mien.capture.project_records import METRES
    from mien.core import MienError, UnknownNameError

    from .stages import Stages

    if unit not in METRES:
        raise UnknownNameError("unit", unit, METRES)
    if cube is not None and pair:
        raise MienError("--cube: a --pair has no cube — leave one of the two out")
    if cube is not None and not 0.0 < cube < 1e6:
        raise MienError(f"--cube: want the length of its edge in {unit}, got {cube:g}")
    edge_m = CUBE_INCHES * METRES["inch"] if cube is None else cube * METRES[unit]
    project = begin_project(folder, photos, unit=unit, cube_m=edge_m, pair=pair)
    moments = dict.fromkeys(each.moment for each in project.photographs)
    cameras = dict.fromkeys(each.camera for each in project.photographs)
    stages = Stages(quiet)
    stages.say(f"{folder}: {len(photos)} photographs; moments {', '.join(moments)}; cameras {', '.join(cameras)}")
    stages.say(f"next: see {folder / 'project.toml'}, fill in points.csv, then mien capture solve {folder}")
