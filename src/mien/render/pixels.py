"""Samples, and the last step from them to pixels: by whole numbers and a table alone.

A sample is four values: red, green, blue, linear and already multiplied by the fourth, coverage; each 0..``ONE``.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.core import Scene, exact
from mien.core.drawing import Rgba

Samples = NDArray[np.int64]
Bytes = NDArray[np.uint8]

ONE = 16384
"""The whole of a value: linear light 1, or full coverage. Near black, five steps of it are one of sRGB."""

WHOLE = 65535
"""The whole of a value that is no colour, where pictures are lit on every pixel."""

POWER_STEP = 256
"""What the sharpness of a highlight is multiplied by there; it is a whole number below 256."""

OFFSETS = ((96, 32), (224, 96), (32, 160), (160, 224))
"""Where the four samples of an edge lie in their pixel, x and y, 1/256.

No two share a row or a column, so that an edge that is nearly level or upright has four steps and not two. Source: the
rotated grid of graphics hardware.
"""


@cache
def srgb_codes() -> Bytes:
    """(ONE + 1,) nearest code of the middle of each linear step. Source: IEC 61966-2-1 (sRGB)."""
    borders = np.array([exact.srgb_to_linear((code + 0.5) / 255.0) for code in range(255)])
    middles = (np.arange(ONE + 1) + 0.5) / ONE
    return np.searchsorted(borders, middles, side="right").astype(np.uint8)


def background(scene: Scene, own: Rgba | None = None) -> NDArray[np.float64]:
    """(H, 4) linear RGBA behind each row of the picture, colour times alpha; ``own`` is what a face brings along."""
    height = scene.size_px[1]
    up = 1.0 - (np.arange(height) + 0.5) / height
    bottom, top = (np.array(color) for color in scene.behind(own))
    rgba = bottom + (top - bottom) * up[:, None]
    rgba[:, :3] *= rgba[:, 3:]
    return rgba


def to_samples(linear: NDArray[np.float64]) -> Samples:
    """Samples of linear RGBA 0..1, any shape."""
    return (np.clip(linear, 0.0, 1.0) * ONE).astype(np.int64)


def to_srgb(linear: NDArray[np.floating[Any]]) -> Bytes:
    """sRGB codes of linear values 0..1, any shape."""
    return srgb_codes()[(np.clip(linear, 0.0, 1.0) * ONE).astype(np.int64)]


def average(samples: Samples) -> Samples:
    """(..., 4) means of four samples (4, ..., 4), rounded to the nearest."""
    return (samples.sum(axis=0) + 2) >> 2


def encode(samples: Samples) -> Bytes:
    """(..., 4) sRGB codes with straight alpha of samples (..., 4)."""
    codes, cover = srgb_codes(), samples[..., 3:]
    straight = np.minimum(samples[..., :3] * ONE // np.maximum(cover, 1), ONE)
    color = codes[np.where((cover > 0) & (cover < ONE), straight, samples[..., :3])]
    alpha = (cover * 255 + ONE // 2) // ONE
    return np.concatenate([color, alpha.astype(np.uint8)], axis=-1)


def to_words(samples: Samples) -> NDArray[np.uint64]:
    """(...) samples (..., 4) as one number each, red in the lowest 16 bits."""
    lanes = samples.astype(np.uint64)
    return (
        lanes[..., 0] | lanes[..., 1] << np.uint64(16) | lanes[..., 2] << np.uint64(32) | lanes[..., 3] << np.uint64(48)
    )
