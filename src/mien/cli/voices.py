"""``mien voices``: who can speak."""

from __future__ import annotations

from . import options


def voices(as_json: options.Json = False) -> None:
    """List the voices that can speak here, one a line, name first.

    \b
    mien voices
    mien voices --json
    """
    from mien import api

    from .listing import print_json, print_lines

    found = api.voices().values()
    if as_json:
        print_json(
            [
                {
                    "name": voice.name,
                    "language": voice.language,
                    "rate_hz": voice.rate_hz,
                    "description": voice.description,
                }
                for voice in found
            ]
        )
    else:
        print_lines([(voice.name, f"{voice.language}  {voice.description}") for voice in found])
