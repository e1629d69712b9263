"""``mien toon from-svg`` and ``mien toon to-svg``: drawings in and out."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from . import options
from .stages import Stages

SUFFIX = ".toon.json"

REMARKS = 12
"""Remarks on a drawing that are told one by one."""

Drawing = Annotated[Path, typer.Argument(metavar="DRAWING", help="An SVG file with a face in it.")]
ToonOut = Annotated[Path, typer.Option("-o", "--out", metavar="FILE", help="The character to write, name.toon.json.")]
SvgOut = Annotated[Path, typer.Option("-o", "--out", metavar="FILE", help="The drawing to write, name.svg.")]
Tolerance = Annotated[
    float, typer.Option("--tolerance", help="How far outlines may depart from the drawing's, in drawing units.")
]
Guessed = Annotated[
    Path | None, typer.Option("--picture", metavar="FILE", help="A picture of what was guessed, .png or .jpg.")
]


def to_svg(
    face: options.FaceName,
    out: SvgOut,
    values: options.Sets = None,
    preset: options.Presets = None,
    units: options.Units = None,
    person: options.Random = None,
    quiet: options.Quiet = False,
) -> None:
    """Write a drawn face as an SVG with layers named after features, to draw on; from-svg reads it again.

    At rest curves stay curves and strokes of one width stay strokes; in other poses outlines are fine polygons.

    \b
    mien toon to-svg toon:olav -o olav.svg
    mien toon to-svg mina.toon.json -o smile.svg --preset smile
    """
    from mien import api
    from mien.core import MienError
    from mien.faces.toon.toon import ToonFace
    from mien.formats.atomic import check_file, writing
    from mien.formats.toon_to_svg import toon_to_svg

    from . import settings

    if out.suffix.lower() != ".svg":
        raise MienError(f"{out}: a drawing wants a name that ends in .svg")
    check_file(out)
    subject = api.load_face(face)
    if not isinstance(subject, ToonFace):
        raise MienError(f"{face}: is no drawn face — a picture of it as SVG: mien render {face} -o {out}")
    text = toon_to_svg(subject, settings.make_pose(subject, values, preset, units, None, person))
    with writing(out) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")
    Stages(quiet).say(f"{out}: {text.count('<path id=')} shapes")


def from_svg(
    drawing: Drawing,
    out: ToonOut,
    tolerance: Tolerance = 0.25,
    picture: Guessed = None,
    quiet: options.Quiet = False,
) -> None:
    """Make a character from a drawing: shapes named after features, or two eyes and a mouth, become playable.

    Layers and ids may be called eye_right, eye_left, pupil, brow, mouth, lip, teeth, tongue, nose, ear, head, hair, or
    ER, EL, PR, PL, BR, BL, M. Without names, eyes and mouth are found by where they lie. Motors are guessed; look at
    the picture, then edit the file.

    \b
    mien toon from-svg sunny.svg -o sunny.toon.json
    mien toon from-svg mina.svg -o mina.toon.json --picture guessed.png
    """
    from mien.core import MienError
    from mien.faces.toon.reader import parse_toon
    from mien.faces.toon.toon import ToonFace
    from mien.formats.atomic import check_file, writing
    from mien.formats.table import find_format
    from mien.formats.toon_from_svg import toon_from_svg

    if not out.name.endswith(SUFFIX) or out.name == SUFFIX:
        raise MienError(f"{out}: a drawn face wants a name that ends in {SUFFIX}, as in {drawing.stem}{SUFFIX}")
    for place in (out, *([] if picture is None else [picture])):
        check_file(place)
    if picture is not None:
        find_format(picture, "pixels")
    stages = Stages(quiet)
    guessed = toon_from_svg(drawing, out.name.removesuffix(SUFFIX), tolerance)
    text = guessed.to_text()
    face = ToonFace(parse_toon(text, str(out)), str(out))
    if picture is not None:
        from mien.formats.toon_from_svg_picture import guess_sheet

        from .writing import prepare

        prepare(stages)
        guess_sheet(guessed, face).write(picture)
        stages.say(f"{picture}: what was guessed")
    with writing(out) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")
    for remark in guessed.remarks[:REMARKS]:
        stages.say(remark)
    if len(guessed.remarks) > REMARKS:
        stages.say(f"{drawing}: and {len(guessed.remarks) - REMARKS} more such remarks")
    stages.say(f"{out}: {guessed.summary()}")
