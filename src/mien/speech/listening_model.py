"""From short spectra to the mouth: a small regression, learned from voices whose phones are known.

``data/listening.npz`` is made by ``python tools/train_listening.py``.
"""

from __future__ import annotations

from functools import cache
from importlib import resources

import numpy as np

from .listening_sound import BANDS, Floats

OFFSETS = (-12, -9, -7, -5, -4, -3, -2, -1, 0, 1, 2, 3, 4, 5)
"""Frames that are looked at, beside the one that is asked for."""

BEFORE, AHEAD = -OFFSETS[0], OFFSETS[-1]
SPAN = BEFORE + 1 + AHEAD

MIDDLE = 0.3
"""Of the bands; taken away from them, so that what comes in lies around 0."""

Layers = tuple[tuple[Floats, Floats], ...]
"""Weights (inputs, outputs) and what is added (outputs,), layer by layer."""

_TAPS = np.array(OFFSETS) + BEFORE


@cache
def load_layers() -> Layers:
    """The shipped layers; the last gives the channels of the mouth in the order of ``MOUTH_CHANNELS``."""
    with resources.files(__package__).joinpath("data/listening.npz").open("rb") as file, np.load(file) as arrays:
        count = len(arrays.files) // 2
        return tuple((arrays[f"weights{k}"].astype(float), arrays[f"added{k}"].astype(float)) for k in range(count))


def regress(seen: Floats, layers: Layers) -> Floats:
    """(C,) channels of the mouth at frame ``BEFORE`` of those that are seen, (SPAN, B); not yet held to 0..1."""
    values = (seen[_TAPS] - MIDDLE).reshape(len(OFFSETS) * BANDS)
    for weights, added in layers[:-1]:
        values = np.maximum(values @ weights + added, 0.0)
    weights, added = layers[-1]
    return values @ weights + added
