"""The last step: linear light to sRGB by table, the background, samples averaged to pixels with their alpha."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from mien.core import Scene, exact

Floats32 = NDArray[np.float32]
Bytes = NDArray[np.uint8]

BUCKETS = 16384
"""Steps of the table over 0..1: so many that no step holds two borders between codes, not even near black."""


@cache
def srgb_tables() -> tuple[Bytes, Floats32]:
    """(BUCKETS + 1,) code at the lower end of each step, and (256,) linear value from which the next code is nearer.

    Source: IEC 61966-2-1 (sRGB).
    """
    middles = [exact.srgb_to_linear((code + 0.5) / 255.0) for code in range(255)]
    borders = np.array([*middles, np.inf], dtype=np.float32)
    starts = np.arange(BUCKETS + 1, dtype=np.float32) / np.float32(BUCKETS)
    return np.searchsorted(borders, starts, side="right").astype(np.uint8), borders


def encode(linear: Floats32) -> Bytes:
    """sRGB codes 0..255 of linear values, any shape; each the nearest code."""
    low, borders = srgb_tables()
    clamped = np.minimum(np.maximum(linear, np.float32(0.0)), np.float32(1.0))
    code = low[(clamped * np.float32(BUCKETS)).astype(np.int64)]
    return (code + (clamped >= borders[code])).astype(np.uint8)


def background_rows(scene: Scene) -> Floats32:
    """(H, 4) linear RGBA behind each row of the picture, colour multiplied by alpha."""
    height = scene.size_px[1]
    up = 1.0 - (np.arange(height) + 0.5) / height
    bottom, top = (np.array(color) for color in scene.background)
    rgba = bottom + (top - bottom) * up[:, None]
    rgba[:, :3] *= rgba[:, 3:]
    rows: Floats32 = rgba.astype(np.float32)
    return rows


def resolve(samples: Floats32, covered: NDArray[np.bool_], behind: Floats32, oversampling: int) -> Bytes:
    """(H, W, 4) sRGB picture with straight alpha out of a raster of linear samples.

    Args:
        samples: (H n, W n, 3) linear RGB.
        covered: (H n, W n) whether a sample was drawn at all.
        behind: (H, 4) from ``background_rows``.
        oversampling: n, 1 or 2.
    """
    rows = np.repeat(behind, oversampling, axis=0)[:, None, :]
    values = np.empty((*covered.shape, 4), dtype=np.float32)
    values[..., :3] = np.where(covered[..., None], samples, rows[..., :3])
    values[..., 3] = np.where(covered, np.float32(1.0), rows[..., 3])
    if oversampling == 2:
        upper, lower = values[0::2], values[1::2]
        left, right = upper[:, 0::2] + upper[:, 1::2], lower[:, 0::2] + lower[:, 1::2]
        values = (left + right) * np.float32(0.25)
    return straight(values)


def straight(values: Floats32) -> Bytes:
    """(H, W, 4) sRGB codes with straight alpha of linear RGBA whose colour was multiplied by alpha."""
    alpha = values[..., 3:]
    clear = alpha <= np.float32(0.0)
    color = values[..., :3] / np.where(clear, np.float32(1.0), alpha)
    picture = np.empty(values.shape, dtype=np.uint8)
    picture[..., :3] = encode(np.where(clear, np.float32(0.0), color))
    picture[..., 3] = (np.minimum(alpha[..., 0], np.float32(1.0)) * np.float32(255.0) + np.float32(0.5)).astype(
        np.uint8
    )
    return picture
