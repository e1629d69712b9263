"""Named poses of the head: the expressions of ``data/expressions.json``, and the palettes."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from importlib.resources import files

from mien.core import Preset

from .palettes import palette_presets


@cache
def head_presets() -> Mapping[str, Preset]:
    """Expressions first, then palettes."""
    text = files(__package__).joinpath("data/expressions.json").read_text(encoding="utf-8")
    expressions = {
        row["name"]: Preset(row["name"], "expression", row["values"], row["doc"], row["source"])
        for row in json.loads(text)
    }
    return {**expressions, **palette_presets()}
