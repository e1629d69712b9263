"""Lists and tables on standard output."""

from __future__ import annotations

import json
import sys
from collections.abc import Collection, Sequence

import typer

WIDE = 200
"""Columns where there is no terminal that knows better, so that a line stays a line."""


def print_json(value: object) -> None:
    """A value as indented JSON."""
    typer.echo(json.dumps(value, ensure_ascii=False, indent=1))


def print_lines(rows: Sequence[tuple[str, str]]) -> None:
    """One line each: name, then what it is, in columns."""
    width = max((len(name) for name, _ in rows), default=0)
    for name, doc in rows:
        typer.echo(f"{name:<{width}}  {doc}".rstrip())


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
    Console(file=sys.stdout, width=None if sys.stdout.isatty() else WIDE, highlight=False, markup=False).print(table)
