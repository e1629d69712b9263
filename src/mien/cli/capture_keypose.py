"""``mien capture keypose``: a solved project of several moments as a face that can be played."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from . import options

Folder = Annotated[Path, typer.Argument(metavar="DIR", help="A solved capture project with a topology.txt.")]


def keypose(
    folder: Folder,
    out: Annotated[Path, typer.Option("-o", "--out", metavar="OUT", help="Folder to write: person.keypose.")],
    name: Annotated[str, typer.Option("--name", metavar="NAME", help="Of the face; else that of the project.")] = "",
    quiet: options.Quiet = False,
    as_json: options.Json = False,
) -> None:
    """Make a measured face of a solved project: each moment of its photographs becomes a phase.

    The moments are laid onto one another by points that do not move with expression: those of [still] in project.toml,
    or, without any, those that move together. Polygons are those of topology.txt; their colours are taken from the
    photographs. Points that no two photographs show are guessed from their neighbours, and from marks.csv if there is
    one: names of the points, parts that keep their shape, places on another head.

    \b
    mien capture solve anna
    mien capture keypose anna -o anna.keypose
    mien say "Good morning." --face anna.keypose -o anna.mp4
    """
    from mien.capture.making import make_keypose

    from .listing import print_json, show
    from .stages import Stages

    stages = Stages(quiet)
    with stages.stage("made"):
        made = make_keypose(folder, out, name=name, report=None)
    measured = made.phases.measured
    if as_json:
        print_json(
            {
                "face": str(out),
                "phases": list(made.keypose.phases),
                "points": int(measured.shape[1]),
                "measured": {phase: int(row.sum()) for phase, row in zip(made.keypose.phases, measured, strict=True)},
                "polygons": made.polygons,
                "colored": made.colored,
                "remarks": list(made.remarks),
            }
        )
    elif not quiet:
        count = f"{len(made.keypose.phases)} phases, {measured.shape[1]} points, {made.polygons} polygons"
        show([f"{out}: {count}", *(f"  {remark}" for remark in made.remarks)])
