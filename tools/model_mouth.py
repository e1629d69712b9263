"""Teeth, gums and tongue: the trial's measured arches, made symmetric and softer, and a tongue that fills the floor."""

from __future__ import annotations

import numpy as np

CM = 0.01
FLIP = np.array([-1.0, 1.0, 1.0])

TOOTH_RING = 8
TOOTH_POINTS = 33
LABIAL = np.array([1.0, 1.0, 1.0, 0.55, 0.1, 0.08, 0.1, 0.55])
"""Light that reaches each of the eight corners around a crown: full on the side of the lips, little on the tongue's."""

RING_LIGHT = np.array([0.80, 0.92, 1.0, 1.0])
"""From the gum to the edge."""

WIDER = 1.035

TONGUE = np.array(
    [  # z, y of the middle, half width, half height; cm
        (8.62, -7.06, 0.12, 0.05),
        (8.50, -7.00, 0.66, 0.17),
        (8.15, -6.93, 1.06, 0.29),
        (7.50, -6.84, 1.36, 0.42),
        (6.60, -6.78, 1.55, 0.56),
        (5.60, -6.80, 1.66, 0.68),
        (4.70, -7.00, 1.70, 0.78),
        (3.90, -7.40, 1.66, 0.80),
    ]
)
TONGUE_RINGS, TONGUE_SIDES = 14, 16
GROOVE = 0.16


def build(head: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Arrays that go into the data file, metres."""
    return {**_teeth(head), **_gums(head), **_tongue()}


def _teeth(head: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    names = [str(name) for name in head["teeth_names"]]
    points, quads, lower, shade = [], [], [], []
    for number, name in enumerate(names):
        if name[1] != "L":
            continue
        start, end = head["teeth_start"][number], head["teeth_start"][number + 1]
        crown = head["teeth_v"][start:end].astype(np.float64)
        faces = head["teeth_q"]
        faces = faces[(faces[:, 0] >= start) & (faces[:, 0] < end)] - start
        crown = _soften(crown)
        light = np.concatenate([np.outer(RING_LIGHT, LABIAL).ravel(), [0.35 if int(name[2]) >= 4 else 0.9]])
        for mirrored in (False, True):
            first = sum(len(p) for p in points)
            points.append(crown * FLIP if mirrored else crown)
            quads.append((faces[:, ::-1] if mirrored else faces) + first)
            lower.append(np.full(len(crown), name[0] == "L"))
            shade.append(light)
    return {
        "teeth_points": (np.concatenate(points) * CM).astype(np.float32),
        "teeth_quads": np.concatenate(quads).astype(np.int16),
        "teeth_lower": np.concatenate(lower),
        "teeth_shade": np.concatenate(shade).astype(np.float16),
    }


def _soften(crown: np.ndarray) -> np.ndarray:
    """A crown a little wider, so that neighbours touch, its rings rounded towards ovals."""
    rings = crown[: 4 * TOOTH_RING].reshape(4, TOOTH_RING, 3)
    middle = rings.mean(axis=1, keepdims=True)
    side = rings[:, 2] - rings[:, 0]
    side = side / np.linalg.norm(side, axis=1, keepdims=True)
    across = ((rings - middle) * side[:, None]).sum(axis=2, keepdims=True)
    rings = rings + across * side[:, None] * (WIDER - 1.0)
    before, after = np.roll(rings, 1, axis=1), np.roll(rings, -1, axis=1)
    rounded = 0.72 * rings + 0.14 * (before + after)
    grown = middle + (rounded - middle) * 1.09
    return np.concatenate([grown.reshape(-1, 3), crown[-1:]])


def _gums(head: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    points = head["gums_v"].astype(np.float64)
    half = len(points) // 2
    out = []
    for arch in (points[:half], points[half:]):
        stations = arch.reshape(-1, 6, 3)
        # Stations run from the left molar to the right one.
        out.append((0.5 * (stations + stations[::-1] * FLIP)).reshape(-1, 3))
    return {
        "gums_points": (np.concatenate(out) * CM).astype(np.float32),
        "gums_quads": head["gums_q"].astype(np.int16),
        "gums_lower": np.arange(len(points)) >= half,
    }


def _tongue() -> dict[str, np.ndarray]:
    along = np.linspace(0.0, 1.0, TONGUE_RINGS)
    rows = np.stack([np.interp(along, np.linspace(0.0, 1.0, len(TONGUE)), column) for column in TONGUE.T], axis=1)
    angle = np.arange(TONGUE_SIDES) * 2.0 * np.pi / TONGUE_SIDES
    twin = (TONGUE_SIDES // 2 - np.arange(TONGUE_SIDES)) % TONGUE_SIDES
    points = []
    for z, y, wide, high in rows:
        up = np.sin(angle)
        groove = GROOVE * high * np.exp(-((np.cos(angle) / 0.3) ** 2)) * (up > 0)
        ring = np.stack([wide * np.cos(angle), y + high * up - groove, np.full(TONGUE_SIDES, z)], axis=1)
        points.append(0.5 * (ring + ring[twin] * FLIP))
    around = np.arange(TONGUE_SIDES)
    quads = [
        np.stack([a + around, a + (around + 1) % TONGUE_SIDES, b + (around + 1) % TONGUE_SIDES, b + around], axis=1)
        for a, b in ((r * TONGUE_SIDES, (r + 1) * TONGUE_SIDES) for r in range(TONGUE_RINGS - 1))
    ]
    tip = np.stack([[0, i, i + 1, i + 1] for i in range(1, TONGUE_SIDES - 1)])
    return {
        "tongue_points": (np.concatenate(points) * CM).astype(np.float32),
        "tongue_quads": np.concatenate([*(quad[:, ::-1] for quad in quads), tip]).astype(np.int16),
    }
