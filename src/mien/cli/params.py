"""``mien params``: what a face can do."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import options

if TYPE_CHECKING:
    from mien.core import Parameter


NUMBERS = ("default", "from", "to", "moves, mm")


def params(face: options.FaceName, as_json: options.Json = False) -> None:
    """List the parameters of a face: names, ranges, how far they move it at both ends, meanings.

    \b
    mien params head
    mien params head --json
    """
    from mien import api

    from .listing import print_json, print_table

    subject = api.load_face(face)
    if as_json:
        print_json({"face": subject.name, "parameters": [row.to_json() for row in subject.parameters]})
        return
    columns = {
        "parameter": [row.name for row in subject.parameters],
        "default": [f"{row.default:.4g}" for row in subject.parameters],
        "from": [f"{row.low:g}" for row in subject.parameters],
        "to": [f"{row.high:g}" for row in subject.parameters],
        "unit": [row.unit for row in subject.parameters],
        "moves, mm": [_reach(row) for row in subject.parameters],
        "what it does": [row.doc for row in subject.parameters],
    }
    shown = {name: cells for name, cells in columns.items() if any(cells)}
    numbers = tuple(number for number, name in enumerate(shown) if name in NUMBERS)
    print_table(tuple(shown), list(zip(*shown.values(), strict=True)), numbers=numbers)


def _reach(row: Parameter) -> str:
    """How far the point that moves most goes at both ends."""
    return "{:.1f} {:.1f}".format(*row.reach_mm) if row.reach_mm else ""
