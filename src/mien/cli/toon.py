"""``mien toon``: files of drawn faces."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from . import toon_svg

app = typer.Typer(no_args_is_help=True, rich_markup_mode=None)
"""The commands about drawn faces."""

app.command("from-svg")(toon_svg.from_svg)

Out = Annotated[Path, typer.Option("-o", "--out", metavar="FILE|-", help="File to write; - is standard output.")]


@app.callback()
def toon() -> None:
    """Files of drawn faces: begin one, check it, bring drawings in and out."""


@app.command()
def schema(out: Out = Path("-")) -> None:
    """Write the JSON Schema of name.toon.json, for editors that complete and check while one writes.

    \b
    mien toon schema -o toon.schema.json
    """
    from mien.faces.toon.schema import schema_text

    _write(schema_text(), out)


def _write(text: str, out: Path) -> None:
    from mien.formats.atomic import writing

    from .listing import show

    if str(out) == "-":
        show(text.splitlines())
        return
    with writing(out) as place:
        place.write_text(text, encoding="utf-8", newline="\n")
