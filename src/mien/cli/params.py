"""``mien params``: what a face can do."""

from __future__ import annotations

from . import options


def params(face: options.FaceName, as_json: options.Json = False) -> None:
    """List the parameters of a face: names, ranges, meanings.

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
                    }
                    for row in subject.parameters
                ],
            }
        )
        return
    print_table(
        ("parameter", "default", "from", "to", "unit", "what it does"),
        [
            (row.name, f"{row.default:g}", f"{row.low:g}", f"{row.high:g}", row.unit, row.doc)
            for row in subject.parameters
        ],
        numbers=(1, 2, 3),
    )
