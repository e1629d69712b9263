"""Teeth, gums, tongue."""

from __future__ import annotations

import numpy as np

CM = 0.01


def build(head: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    out = {}
    cut = int(head["teeth_start"][16])
    v = head["teeth_v"].astype(np.float64)
    out["teeth_points"] = (v * CM).astype(np.float32)
    out["teeth_quads"] = head["teeth_q"].astype(np.int16)
    out["teeth_lower"] = np.arange(len(v)) >= cut
    g = head["gums_v"]
    out["gums_points"] = (g * CM).astype(np.float32)
    out["gums_quads"] = head["gums_q"].astype(np.int16)
    out["gums_lower"] = np.arange(len(g)) >= int(head["gums_upper"])
    out["tongue_points"] = (head["tongue_v"] * CM).astype(np.float32)
    out["tongue_quads"] = head["tongue_q"].astype(np.int16)
    return out
