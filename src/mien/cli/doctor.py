"""``mien doctor``: whether all is well, and what to do where it is not."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import typer

from . import options
from .main import MISTAKE

if TYPE_CHECKING:
    from .checks import Line


def doctor(as_json: options.Json = False) -> None:
    """Tell versions, faces, voices, folders, and which live faces run here; and what to do where something is wrong.

    \b
    mien doctor
    mien doctor --json
    """
    from dataclasses import asdict

    from .checks import NOTE, PROBLEM, check_all
    from .listing import print_json, show

    found = dict(check_all())
    lines = [line for section in found.values() for line in section]
    problems, notes = (sum(line.status == status for line in lines) for status in (PROBLEM, NOTE))
    if as_json:
        print_json({"ok": not problems, "checks": {name: [asdict(line) for line in found[name]] for name in found}})
    else:
        show(_report(found))
        show([_sum_up(problems, notes)])
    if problems:
        raise typer.Exit(MISTAKE)


def _report(found: Mapping[str, Sequence[Line]]) -> Iterator[str]:
    width = max(len(line.about) for section in found.values() for line in section)
    for name, section in found.items():
        yield name
        for line in section:
            yield f"  {line.status:<7}  {line.about:<{width}}  {line.text}"
            if line.advice:
                yield f"  {'':<7}  {'':<{width}}  -> {line.advice}"


def _sum_up(problems: int, notes: int) -> str:
    if problems:
        return f"{problems} problem{'s' * (problems > 1)}: mien cannot be used like this"
    return "all is well" + (f", with {notes} note{'s' * (notes > 1)}" if notes else "")
