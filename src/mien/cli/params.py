"""``mien params``: what a face can do."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import options

if TYPE_CHECKING:
    from mien.core import Parameter


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
        print_json(
            {
                "face": subject.name,
                "parameters": [
                    {
                        "name": row.name,
                        "default": row.default,
                        "low": row.low,
                        "high": row.high,
                        "unit": row.unit,
                        "group": row.group,
                        "mirror": row.mirror,
                        "doc": row.doc,
                        "source": row.source,
                        "reach_mm": row.reach_mm,
                    }
                    for row in subject.parameters
                ],
            }
        )
        return
    print_table(
        ("parameter", "default", "from", "to", "unit", "moves, mm", "what it does"),
        [
            (row.name, f"{row.default:g}", f"{row.low:g}", f"{row.high:g}", row.unit, _reach(row), row.doc)
            for row in subject.parameters
        ],
        numbers=(1, 2, 3, 5),
    )


def _reach(row: Parameter) -> str:
    """How far the point that moves most goes at both ends."""
    return "{:.1f} {:.1f}".format(*row.reach_mm) if row.reach_mm else ""
