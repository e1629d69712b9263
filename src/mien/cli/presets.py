"""``mien presets``: named expressions, gestures and palettes of a face."""

from __future__ import annotations

from . import options


def presets(face: options.FaceName, as_json: options.Json = False) -> None:
    """List the presets of a face, one a line, name first.

    \b
    mien presets head
    mien presets head --json
    """
    from mien import api

    from .listing import print_json, print_table

    subject = api.load_face(face)
    if as_json:
        print_json(
            {
                "face": subject.name,
                "presets": [
                    {
                        "name": preset.name,
                        "kind": preset.kind,
                        "doc": preset.doc,
                        "source": preset.source,
                        "values": dict(preset.values),
                        **({"keys": [[time_s, dict(values)] for time_s, values in preset.keys]} if preset.keys else {}),
                    }
                    for preset in subject.presets.values()
                ],
            }
        )
        return
    print_table(
        ("preset", "kind", "what it is"),
        [(preset.name, preset.kind, preset.doc) for preset in subject.presets.values()],
    )
