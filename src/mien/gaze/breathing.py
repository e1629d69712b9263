"""Breathing, as far as a head shows it: it rises a little with every breath."""

from __future__ import annotations

from mien.core.chance import around, stream
from mien.timeline import Track

from .curves import pulses

BREATH_S = 4.3
BREATH_SPREAD_S = 0.7
"""Length of a breath.

Source: 12 to 18 breaths a minute are usual in adults at rest (Barrett and others 2010, Ganong's Review of Medical
Physiology, chapter 35); the spread is our choice.
"""

IN_SHARE = 0.42
"""Part of a breath in which it is drawn: a little less than half (our choice)."""

RISE_DEG = 0.7
"""How far the head nods up with a breath: our choice; more looks like sighing."""


def breathing(length_s: float, seed: int) -> Track:
    """The track of ``head_nod``, degrees: up with each breath and down again, at rest at either end."""
    chance = stream(seed, "breathing")
    shapes: list[tuple[list[float], list[float]]] = []
    start = 0.0
    while True:
        whole = around(chance, BREATH_S, BREATH_SPREAD_S)
        height = around(chance, RISE_DEG, 0.25 * RISE_DEG)
        if start + whole > length_s:
            return pulses(shapes, length_s, name="head_nod")
        shapes.append(([start, start + IN_SHARE * whole, start + whole], [0.0, height, 0.0]))
        start += whole
