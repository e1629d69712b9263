"""``mien fit``: the parametric head of a person from points of the face."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import options

if TYPE_CHECKING:
    from mien.capture.fitting import FittedHead

MM_PER_M = 1000.0


def fit(
    points: Annotated[Path, typer.Argument(metavar="POINTS", help="A solved capture project, or point,x,y,z[,sigma].")],
    out: Annotated[Path, typer.Option("-o", "--out", metavar="OUT", help="File to write: person.face.json.")],
    landmarks: Annotated[
        Path | None,
        typer.Option("--landmarks", metavar="FILE", help="Which point is which: a table point,landmark."),
    ] = None,
    residual: Annotated[
        bool | None,
        typer.Option(
            "--residual/--no-residual",
            help="Points of the person's own beside the parameters.  [default: if the points are precise]",
        ),
    ] = None,
    unit: Annotated[str, typer.Option("--unit", metavar="UNIT", help="Of a table: m, cm, mm or inch.")] = "m",
    sigma: Annotated[
        float, typer.Option("--sigma", metavar="MM", help="How exact points are that do not say so, mm.")
    ] = 1.0,
    moment: Annotated[
        str, typer.Option("--moment", metavar="NAME", help="Of a project: when the face was neutral.")
    ] = "",
    any_size: Annotated[bool, typer.Option("--any-size", help="Do not trust the scale of the points.")] = False,
    hair: Annotated[str, typer.Option("--hair", metavar="STYLE", help="Hair of the face.")] = "side_part",
    palette: Annotated[str, typer.Option("--palette", metavar="NAME", help="Colours of the face.")] = "beige",
    name: Annotated[str, typer.Option("--name", metavar="NAME", help="Of the person.")] = "",
    quiet: options.Quiet = False,
    as_json: options.Json = False,
) -> None:
    """Make the head of a person from measured points of the neutral face.

    Points are called by landmarks (pronasale, cheilion_L), by the 68 numbers of 300-W (ibug_0 to ibug_67) or by
    vertices of the head (m0_5, m0_5.right); left is the person's own left. Twenty make a likeness, two hundred a
    portrait. What was not measured is what it most likely is among people.

    \b
    mien capture solve anna
    mien fit anna -o anna.face.json
    mien fit points.csv --unit mm -o anna.face.json
    mien say "Good morning." --face anna.face.json -o anna.mp4
    """
    from mien.capture.fitting import fit_head, write_head
    from mien.capture.fitting_files import read_face, read_names
    from mien.core import RangeError

    from .listing import print_json, show
    from .stages import Stages

    if not 0.0 < sigma < MM_PER_M:
        raise RangeError(f"--sigma {sigma:g}: want millimetres, more than 0")
    stages = Stages(quiet)
    names = read_names(landmarks) if landmarks else None
    face = read_face(points, unit=unit, sigma_m=sigma / MM_PER_M, names=names, moment=moment)
    with stages.stage("fitted"):
        fitted = fit_head(
            face.points, face.covariances, residual="auto" if residual is None else residual, scaled=any_size
        )
    choices = {"name": name, "hair": hair, "palette": palette}
    written = write_head(fitted, out, choices={key: value for key, value in choices.items() if value})
    remarks = [*face.remarks, *fitted.remarks]
    if as_json:
        print_json({"files": [str(path) for path in written if path], **_described(fitted), "remarks": remarks})
    elif not quiet:
        show([_summary(fitted), *(f"  {remark}" for remark in remarks)])
        stages.say(", ".join(str(path) for path in written if path))


def _summary(fitted: FittedHead) -> str:
    used = len(fitted.misses) - len(fitted.suspects)
    kinds = f"{len(fitted.values)} parameters" + (" and points of its own" if fitted.residual else "")
    return f"{used} points, {fitted.rms_m * MM_PER_M:.2f} mm (RMS) from the head; {kinds}"


def _described(fitted: FittedHead) -> dict[str, object]:
    return {
        "points": len(fitted.misses) - len(fitted.suspects),
        "rms_mm": round(fitted.rms_m * MM_PER_M, 3),
        "chi2_per_dof": round(fitted.chi2_per_dof, 3),
        "suspects": list(fitted.suspects),
        "misses_mm": {
            point: [round(float(x) * MM_PER_M, 3) for x in miss] for point, miss in sorted(fitted.misses.items())
        },
        "values": dict(sorted(fitted.values.items())),
        "residual": fitted.residual is not None,
    }
