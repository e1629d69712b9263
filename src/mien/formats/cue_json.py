"""Cues as JSON of our own: versioned, exact to the last bit, every tier, a line a cue."""

from __future__ import annotations

import json
from collections.abc import Iterator

from mien.core import Cue
from mien.timeline.json_reader import Node

from .cue_sheet import CueSheet, place_of
from .cue_text import Interval, check_intervals

FORMAT = "mien-cues"
VERSION = 1
"""Version that is written. It is the first; a later one brings the step from each earlier one with it."""


def format_json(sheet: CueSheet) -> Iterator[str]:
    """Lines of the document; numbers are written as the shortest texts that read back as the same."""
    head = {"format": FORMAT, "version": VERSION, "length_s": sheet.length_s, "sound": sheet.sound, "text": sheet.text}
    yield "{\n"
    yield from (f"  {_dump(key)}: {_dump(value)},\n" for key, value in head.items())
    yield '  "tiers": {'
    for number, (name, cues) in enumerate(sheet.tiers.items()):
        yield f"{',' if number else ''}\n    {_dump(name)}: ["
        for row, cue in enumerate(cues):
            yield f"{',' if row else ''}\n      {_dump([cue.start_s, cue.end_s, cue.symbol])}"
        yield "\n    ]"
    yield "\n  }\n}\n"


def read_json(document: Node) -> CueSheet:
    """The sheet of a document.

    Raises:
        LoadError: it is none of ours, of another version, or something in it is missing, unknown or out of order.
    """
    kinds = dict(document.entries())
    if "format" not in kinds or kinds["format"].value != FORMAT:
        raise document.error(
            f'holds no cues: want "format": "{FORMAT}", or the "mouthCues" of Rhubarb',
            "was it written by something else?",
        )
    members = document.members(("format", "version", "length_s", "tiers"), ("sound", "text"))
    version = members["version"].integer()
    if version != VERSION:
        raise members["version"].error(f"want version {VERSION}, got {version}", "is this mien up to date?")
    length_s = members["length_s"].number()
    tiers = {
        name: check_intervals(document.source, _intervals(name, node), length_s)
        for name, node in members["tiers"].entries()
    }
    sound, text = (members[key].text() if key in members else "" for key in ("sound", "text"))
    return CueSheet(length_s, tiers, sound, text)


def _intervals(name: str, node: Node) -> Iterator[Interval]:
    for number, item in enumerate(node.items(), start=1):
        start, end, symbol = item.items(3)
        yield Interval(place_of(name, number), None, Cue(start.number(), end.number(), symbol.text()))


def _dump(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)
