"""What a measured face can show by name: its phases, and the emotions that they allow."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from importlib import resources
from typing import Any

from mien.core import ParameterTable, Preset

from .records import Keypose
from .table import PARKE, phase_of

EXPRESSION = "expression"


def keypose_presets(keypose: Keypose, table: ParameterTable) -> Mapping[str, Preset]:
    """The phases in their order, then the emotions of ``data/expressions.json`` whose phases the face has.

    A phase comes before an emotion of its name; of emotions of one name the first comes that the face can show.
    """
    found = {
        name: Preset(name, EXPRESSION, {}, "The first phase: at rest.", PARKE)
        for name in (keypose.phases[0], "neutral")
    }
    for own in keypose.phases[1:]:
        phase = phase_of(keypose, own)
        for name in (own, phase.name):
            found[name] = Preset(name, EXPRESSION, {f"phase.{phase.name}": 1.0}, phase.shown, phase.source)
    for row in _emotions():
        if all(name in table for name in row["values"]):
            preset = Preset(row["name"], EXPRESSION, row["values"], row["doc"], row["source"])
            found.setdefault(preset.name, preset)
    return found


@cache
def _emotions() -> tuple[Mapping[str, Any], ...]:
    text = resources.files(__package__).joinpath("data", "expressions.json").read_text(encoding="utf-8")
    return tuple(json.loads(text))
