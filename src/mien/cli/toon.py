"""``mien toon``: files of drawn faces."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import options, toon_svg

if TYPE_CHECKING:
    from mien.faces.toon.checks import Report

app = typer.Typer(no_args_is_help=True, rich_markup_mode=None)
"""The commands about drawn faces."""

app.command("from-svg")(toon_svg.from_svg)
app.command("to-svg")(toon_svg.to_svg)

SHOWN = 40
"""Faults of a file that a person is shown."""

Schema = Annotated[Path, typer.Option("-o", "--out", metavar="FILE|-", help="File to write; - is standard output.")]


@app.callback()
def toon() -> None:
    """Files of drawn faces: begin one, check it, bring drawings in and out."""


@app.command()
def check(
    files: Annotated[list[Path], typer.Argument(metavar="FILE…", help="Files of drawn faces, name.toon.json.")],
    as_json: options.Json = False,
) -> None:
    """Tell all that is wrong with files of drawn faces: line, place, what was wanted, and what to try.

    Errors keep a face from being used, warnings do not; the exit status is 2 if there is an error. A file without
    errors is also played, in poses drawn by chance. docs/toon-format.md says what each fault means.

    \b
    mien toon check gus.toon.json
    mien toon check *.toon.json --json
    """
    from mien.faces.toon.checks import check_file

    from .listing import print_json, show

    reports = {path: check_file(path) for path in files}
    if as_json:
        print_json([_described(path, report) for path, report in reports.items()])
    else:
        for path, report in reports.items():
            show(_lines(path, report))
    if any(report.errors for report in reports.values()):
        raise typer.Exit(2)


@app.command()
def new(
    out: Annotated[Path, typer.Option("-o", "--out", metavar="FILE", help="File to write, name.toon.json.")],
    like: Annotated[
        str | None, typer.Option("--like", metavar="NAME", help="Start from a character that ships, as in --like olav.")
    ] = None,
    strict: Annotated[bool, typer.Option("--strict", help="A face by the rules of the paper alone.")] = False,
    force: Annotated[bool, typer.Option("--force", help="Replace a file that is there.")] = False,
) -> None:
    """Begin a drawn face: a small file that already speaks, to change as you like.

    \b
    mien toon new -o kim.toon.json
    mien say "Hello." --face kim.toon.json -o hello.mp4
    """
    from mien.core import MienError
    from mien.faces.toon.shipped import SUFFIX
    from mien.faces.toon.starters import copied_text, starter_text

    if not out.name.endswith(SUFFIX) or out.name == SUFFIX:
        raise MienError(f"{out}: want a name that ends in {SUFFIX} — as in -o kim{SUFFIX}")
    if like is not None and strict:
        raise MienError(f"--strict --like {like}: a character is what it is — leave one of the two out")
    if out.exists() and not force:
        raise MienError(f"{out}: is there already, and perhaps somebody's work — another name, or --force")
    name = out.name.removesuffix(SUFFIX)
    text = starter_text(name, "strict" if strict else "extended") if like is None else copied_text(name, like)
    _write(text, out)


@app.command()
def schema(out: Schema = Path("-")) -> None:
    """Write the JSON Schema of name.toon.json, for editors that complete and check while one writes.

    \b
    mien toon schema -o toon.schema.json
    """
    from mien.faces.toon.schema import schema_text

    from .listing import show

    if str(out) == "-":
        show(schema_text().splitlines())
    else:
        _write(schema_text(), out)


def _write(text: str, out: Path) -> None:
    from mien.formats.atomic import writing

    with writing(out) as place:
        place.write_text(text, encoding="utf-8", newline="\n")


def _lines(path: Path, report: Report) -> list[str]:
    """What a person is told of a file."""
    lines = [f"{path}{':' * bool(fault.line)}{fault.line or ''}: {fault.text()}" for fault in report.faults[:SHOWN]]
    if len(report.faults) > SHOWN:
        lines.append(f"{path}: … and {len(report.faults) - SHOWN} more, which --json shows")
    warnings = len(report.faults) - report.errors
    counts = [
        f"{count} {word}{'s' * (count != 1)}"
        for count, word in ((report.errors, "error"), (warnings, "warning"))
        if count
    ]
    return [*lines, f"{path}: {' and '.join(counts) or 'no faults'}"]


def _described(path: Path, report: Report) -> dict[str, object]:
    return {
        "file": str(path),
        "errors": report.errors,
        "faults": [
            {
                "line": fault.line,
                "severity": "error" if fault.grave else "warning",
                "rule": fault.rule,
                "place": list(fault.place),
                "polygon": fault.who or None,
                "what": fault.what,
                "wanted": fault.wanted,
                "got": fault.got,
                "try": fault.advice,
            }
            for fault in report.faults
        ],
    }
