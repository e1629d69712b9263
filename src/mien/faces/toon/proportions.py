"""Proportions of a drawn face: features that grow and move as a whole, with all that is attached to them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mien.core import Pose

from .records import Character, Floats, Polygon

GROUPS = {"ER": "eye", "PR": "eye", "EL": "eye", "PL": "eye", "BR": "brow", "BL": "brow", "M": "mouth", "N": "nose"}
EARS = ("AR", "AL")


class Proportions:
    """Which vertices of a drawing move with which proportion."""

    def __init__(self, character: Character, polygons: Sequence[tuple[Polygon, int]]) -> None:
        """Polygons in drawing order, each with the number of its vertices."""
        self._character = character
        self._features = ["body" if polygon.body else feature_of(polygon, character) for polygon, _ in polygons]
        self._counts = [count for _, count in polygons]

    def apply(self, points: Floats, pose: Pose) -> Floats:
        """(N, 2) vertices, y down, with the proportions of a pose."""
        given = {name: pose[name] for name in self._character.proportions if pose[name] != pose.table[name].default}
        if not given:
            return points
        rows = np.array([self._affine(feature, given) for feature in self._features])
        scale, shift = (np.repeat(part, self._counts, axis=0) for part in (rows[:, :2], rows[:, 2:]))
        return points * scale + shift

    def _affine(self, feature: str, given: dict[str, float]) -> tuple[float, float, float, float]:
        """Factors and shifts (sx, sy, dx, dy) of what belongs to a feature."""
        if feature == "body":
            return 1.0, 1.0, 0.0, 0.0
        kind = "ear" if feature in EARS else GROUPS.get(feature, "")
        width, height, right, down = 1.0, 1.0, 0.0, 0.0
        if kind == "eye":
            width = height = given.get("eyes.size", 1.0)
            aside = given.get("eyes.spacing", 0.0)
            right, down = (-aside if feature.endswith("R") else aside), -given.get("eyes.up", 0.0)
        elif kind == "brow":
            aside = given.get("eyes.spacing", 0.0)
            right = -aside if feature.endswith("R") else aside
            down = -given.get("brows.up", 0.0) - given.get("eyes.up", 0.0)
        elif kind == "mouth":
            width, down = given.get("mouth.width", 1.0), -given.get("mouth.up", 0.0)
        elif kind:
            width = height = given.get(f"{kind}s.size" if kind == "ear" else "nose.size", 1.0)
        x, y = center(self._character, feature) if kind else (0.0, 0.0)
        right, down = right + x * (1.0 - width), down + y * (1.0 - height)
        # The whole head grows about its centre, after the features within it.
        (cx, cy), wide, tall = self._character.head.center, given.get("face.width", 1.0), given.get("face.height", 1.0)
        return width * wide, height * tall, right * wide + cx * (1.0 - wide), down * tall + cy * (1.0 - tall)


def feature_of(polygon: Polygon, character: Character) -> str:
    """The feature that a polygon belongs to, empty for none."""
    lines = [line for line in (polygon.stroke, *(polygon.span or ())) if line is not None]
    if polygon.feature or lines:
        return polygon.feature or lines[0].feature
    return next((name for name, each in character.features.items() if polygon.point in each.points), "")


def center(character: Character, feature: str) -> tuple[float, float]:
    """The middle of a feature's control points; of a pupil that of its eye, so that both grow together."""
    points = list(character.features[feature.replace("P", "E")].points.values())
    return sum(x for x, _ in points) / len(points), sum(y for _, y in points) / len(points)
