"""Named poses of the head: the expressions of ``data/expressions.json``, and the palettes."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache

from mien.core import Preset

from .palettes import palette_presets
from .shipped import shipped_text


@cache
def head_presets() -> Mapping[str, Preset]:
    """Expressions first, then palettes."""
    expressions = {
        row["name"]: Preset(row["name"], "expression", row["values"], row["doc"], row["source"])
        for row in json.loads(shipped_text("expressions.json"))
    }
    return {**expressions, **palette_presets()}
