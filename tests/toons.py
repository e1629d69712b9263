"""A small drawn face to test with, as the dict of its file."""

from __future__ import annotations

import copy
import json
from typing import Any

from mien.faces.toon.reader import parse_toon
from mien.faces.toon.toon import ToonFace


def _square(x: float, y: float, half: float) -> list[list[float]]:
    return [[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]]


def _motors() -> dict[str, dict[str, float]]:
    brows = {f"B{side}{place}": {"min": -5, "max": 15} for side in "RL" for place in "LCM"}
    lids = {f"E{side}U": {"min": -20, "max": 5} for side in "RL"} | {
        f"E{side}L": {"min": -2, "max": 18} for side in "RL"
    }
    pupils = {f"P{side}{way}": {"min": -6, "max": 6, "min_deg": -30, "max_deg": 30} for side in "LR" for way in "HV"}
    corners = {f"M{side}{way}": {"min": -10, "max": 10} for side in "LR" for way in "HV"}
    head = {code: {"min_deg": -20, "max_deg": 20} for code in ("HH", "HV")}
    return brows | lids | pupils | corners | {"MB": {"min": -2, "max": 38}} | head


SMALL: dict[str, Any] = {
    "format": "mien-toon",
    "version": 1,
    "name": "small",
    "mode": "strict",
    "size": [200, 200],
    "background": "#FFFFFF",
    "palette": {"skin": "#F3B997", "ink": "#202020", "white": "#FFFFFF"},
    "head": {"center": [100, 100], "radius": [80, 90], "pivot": [100, 180]},
    "features": {
        "BR": {"points": {"BRL": [40, 60], "BRC": [60, 60], "BRM": [80, 60]}},
        "BL": {"points": {"BLL": [160, 60], "BLC": [140, 60], "BLM": [120, 60]}},
        "ER": {"points": {"ERO": [40, 90], "ERU": [60, 80], "ERI": [80, 90], "ERL": [60, 100]}},
        "EL": {"points": {"ELO": [160, 90], "ELU": [140, 80], "ELI": [120, 90], "ELL": [140, 100]}},
        "PR": {"points": {"PR": [60, 90]}},
        "PL": {"points": {"PL": [140, 90]}},
        "M": {"points": {"MR": [70, 140], "MT": [100, 140], "ML": [130, 140], "MB": [100, 140]}},
    },
    "motors": _motors(),
    "polygons": [
        {"id": "face", "kind": "face", "fill": "skin", "path": "M20 20 H180 V190 H20 Z"},
        {"id": "eye_R", "kind": "hole", "fill": "white", "feature": "ER", "path": "M40 90 L60 80 L80 90 L60 100 Z"},
        {"id": "eye_L", "kind": "hole", "fill": "white", "feature": "EL", "path": "M160 90 L140 80 L120 90 L140 100 Z"},
        {"id": "pupil_R", "kind": "pupil", "fill": "ink", "feature": "PR", "path": _square(60, 90, 3)},
        {"id": "pupil_L", "kind": "pupil", "fill": "ink", "feature": "PL", "path": _square(140, 90, 3)},
        {"id": "brow_R", "kind": "feature", "fill": "ink", "feature": "BR", "path": "M40 57 H80 V61 H40 Z"},
        {"id": "brow_L", "kind": "feature", "fill": "ink", "feature": "BL", "path": "M120 57 H160 V61 H120 Z"},
        {
            "id": "lips", "kind": "point", "fill": "ink", "motor": "MB",
            "min": "M70 138 L130 138 L130 142 L70 142 Z", "max": "M70 138 L130 138 L120 180 L80 180 Z",
        },
        {"id": "hat", "kind": "free", "fill": "ink", "path": "M60 10 H140 V30 H60 Z"},
    ],
}  # fmt: skip


def small(**changes: Any) -> dict[str, Any]:
    """A copy of the small face with other values of some keys."""
    return {**copy.deepcopy(SMALL), **copy.deepcopy(changes)}


def extended(*polygons: dict[str, Any], **changes: Any) -> dict[str, Any]:
    """The small face as an extended one, with more polygons."""
    document = small(mode="extended", **changes)
    document["polygons"] += copy.deepcopy(list(polygons))
    return document


def face_of(document: dict[str, Any]) -> ToonFace:
    """The face that a dict describes."""
    return ToonFace(parse_toon(json.dumps(document), "small.toon.json"), "small.toon.json")
