"""Corrections of the measured cage."""

from __future__ import annotations

import numpy as np

FRIENDLIER = 0.10
"""Share of the measured smile in the neutral face: the reference's own rest looks stern."""

LIP = 2
"""Column of the lips in the region weights."""


def mend(head: dict[str, np.ndarray], morphs: dict[str, np.ndarray]) -> None:
    """Change the arrays of the trial in place."""
    relax(head, morphs)
    sharpen_lips(head)
    smooth_tragus(head)
    smooth_shade(head)


def relax(head: dict[str, np.ndarray], morphs: dict[str, np.ndarray]) -> None:
    """A hint of a smile at rest."""
    names = [str(name) for name in morphs["names"]]
    for points, kind in (("control", "control"), ("control_onsurface", "onsurface")):
        for side in "LR":
            delta = morphs[kind][names.index(f"mouthSmile_{side}")].astype(np.float64)
            head[points] = head[points] + FRIENDLIER * delta


def sharpen_lips(head: dict[str, np.ndarray]) -> None:
    """The red of the lips ends between ring m1 and ring mb instead of fading over three rings."""
    weights = head["region_weight_vertex"].astype(np.float64)
    names = [str(name) for name in head["half_names"]]
    for ring, lip in (("m0", 0.8), ("mh", 1.0), ("m1", 1.0), ("mb", 0.0)):
        for station in range(10):
            vertex = names.index(f"{ring}_{station}")
            if station == 5 and ring == "m1":
                continue
            for number in (vertex, head["mirror_full"][vertex]):
                others = np.delete(np.arange(weights.shape[1]), LIP)
                weights[number, others] *= (1.0 - lip) / max(weights[number, others].sum(), 1e-9)
                if weights[number, others].sum() < 1.0 - lip - 1e-6:
                    weights[number, 0] = 1.0 - lip
                weights[number, LIP] = lip
    head["region_weight_vertex"] = weights


def smooth_tragus(head: dict[str, np.ndarray]) -> None:
    """The folded quads before the ear canal, seen as a bright sliver from 45 degrees, drawn smooth."""
    names = [str(name) for name in head["half_names"]]
    rings = "bcdefgh"
    # Names of ear vertices have no underscore, those of eye rings do.
    vertex = {(r, s): names.index(f"{r}{s}") for r in rings for s in range(12)}
    for key in ("control", "control_onsurface"):
        points = head[key].astype(np.float64)
        for _ in range(6):
            moved = points.copy()
            for ring in "cdefg":
                for station in (0, 1, 2, 3):
                    inner, outer = rings[rings.index(ring) - 1], rings[rings.index(ring) + 1]
                    around = [
                        (ring, (station - 1) % 12),
                        (ring, (station + 1) % 12),
                        (inner, station),
                        (outer, station),
                    ]
                    mean = np.mean([points[vertex[name]] for name in around], axis=0)
                    share = 0.5 if station in (1, 2) else 0.25
                    moved[vertex[ring, station]] = (1.0 - share) * points[vertex[ring, station]] + share * mean
            points = moved
        for (_ring, _station), number in vertex.items():
            points[head["mirror_full"][number]] = points[number] * np.array([-1.0, 1.0, 1.0])
        head[key] = points


def smooth_shade(head: dict[str, np.ndarray]) -> None:
    """Baked ambient of throat and neck averaged over neighbours, where the polygons are coarse."""
    shade = head["ambient"].astype(np.float64)
    low = head["control"][:, 1] < -7.5
    low &= (head["control"][:, 2] < 9.0) & ~np.isin(np.arange(len(low)), _mouth_bag(head))
    for _ in range(4):
        total, count = np.zeros_like(shade), np.zeros_like(shade)
        for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)):
            for i, j in ((a, b), (b, a)):
                np.add.at(total, head["quads"][:, i], shade[head["quads"][:, j]])
                np.add.at(count, head["quads"][:, i], 1.0)
        shade = np.where(low, 0.4 * shade + 0.6 * total / np.maximum(count, 1.0), shade)
    head["ambient"] = shade


def _mouth_bag(head: dict[str, np.ndarray]) -> np.ndarray:
    group = [str(name) for name in head["group_names"]].index("mouth")
    return np.unique(head["quads"][head["groups"] == group])
