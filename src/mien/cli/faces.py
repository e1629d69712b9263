"""``mien faces``: what can be played."""

from __future__ import annotations

from . import options


def faces(as_json: options.Json = False) -> None:
    """List the faces that are installed, one a line, name first.

    \b
    mien faces
    mien faces --json
    """
    from mien import api

    from .listing import print_json, print_lines

    rows = api.face_names()
    if as_json:
        print_json([{"name": name, "doc": doc} for name, doc in rows])
    else:
        print_lines(rows)
