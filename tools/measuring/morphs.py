"""Expressions that ICT-FaceKit lacks, measured on MakeHuman's head: fields on our skin."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from .reference import CM, Reference
from .skin import Skin

TABLE = Path(__file__).with_name("morphs.csv")
SMOOTHING, SMOOTHING_SHARE = 2, 0.25
"""Steps: the polygons of that head are as large as ours, and ours show where theirs end."""


def measure_morphs(reference: Reference, skin: Skin) -> dict[str, np.ndarray]:
    """Expression -> (S, 3) m; those that end in ``_L`` have a mirror image, the others are symmetric."""
    arrays = reference.read("mh_expressions")
    fields = reference.models.on_skin(arrays["deltas"].astype(np.float64) * CM)
    by_name = dict(zip(arrays["names"].tolist(), fields, strict=True))
    out: dict[str, np.ndarray] = {}
    with TABLE.open(encoding="utf-8", newline="") as lines:
        for row in csv.DictReader(lines):
            field = float(row["gain"]) * sum(by_name[name] for name in row["expression"].split())
            mask = skin.region(row["path"], float(row["full_mm"]), float(row["reach_mm"]), row["still"].split())
            if row["relative"] == "yes":
                field = skin.relative(field, mask == 0.0)
            field = skin.smoothed(field, SMOOTHING, SMOOTHING_SHARE) * mask[:, None]
            for name, moved in _sides(row["name"], row["expression"], field, skin):
                out[name] = moved
    return out


def _sides(name: str, expression: str, field: np.ndarray, skin: Skin) -> list[tuple[str, np.ndarray]]:
    if not name.endswith("_L"):
        return [(name, skin.symmetric(field))]
    # What moves both sides of that head is symmetric; what moves one already ends before the midline.
    left = field if "-left-" in expression else skin.symmetric(field) * skin.left_share[:, None]
    return [(name, left), (name[:-1] + "R", skin.mirrored(left))]
