"""Lists and tables on standard output."""

from __future__ import annotations

import io
import json
import shutil
import sys
from collections.abc import Collection, Iterable, Sequence

import typer

from .streams import let_go

WIDE = 200
"""Columns where there is no terminal that knows better, so that a line stays a line."""

LEAST_TEXT = 24
"""Columns that the text at the end of a line gets at least."""


def show(lines: Iterable[str]) -> None:
    """Lines on standard output, until whoever reads them has had enough, as in ``mien params head | head -1``.

    Raises:
        MienError: standard output goes to a disk that is full.
    """
    from mien.formats.atomic import full_disk_error, is_full_disk

    try:
        for line in lines:
            typer.echo(line.rstrip())
    except BrokenPipeError:
        let_go(sys.stdout)
    except OSError as error:
        if not is_full_disk(error):
            raise
        let_go(sys.stdout)
        raise full_disk_error("standard output") from error


def print_json(value: object) -> None:
    """A value as indented JSON."""
    show([json.dumps(value, ensure_ascii=False, indent=1)])


def print_lines(rows: Sequence[tuple[str, str]]) -> None:
    """One line each: name, then what it is, in columns."""
    width = max((len(name) for name, _ in rows), default=0)
    show(f"{name:<{width}}  {doc}" for name, doc in rows)


def print_table(headings: Sequence[str], rows: Sequence[Sequence[str]], numbers: Collection[int] = ()) -> None:
    """A table with headings; the columns in ``numbers`` are set to the right."""
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    for place, heading in enumerate(headings):
        last = place == len(headings) - 1
        table.add_column(heading, justify="right" if place in numbers else "left", no_wrap=not last, overflow="fold")
    for row in rows:
        table.add_row(*row)
    # Where a terminal is too narrow it breaks the lines itself; rich would leave out whole columns.
    names = sum(max(map(len, column)) + 2 for column in zip(headings[:-1], *(row[:-1] for row in rows), strict=True))
    terminal, text = sys.stdout.isatty(), io.StringIO()
    width = max(shutil.get_terminal_size().columns, names + LEAST_TEXT) if terminal else WIDE
    Console(file=text, force_terminal=terminal, width=width, highlight=False, markup=False).print(table)
    show(text.getvalue().splitlines())
