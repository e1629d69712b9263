"""What rates and sizes a film can have; apart from the film itself, so that asking needs no codecs."""

from __future__ import annotations

import math
from fractions import Fraction
from pathlib import Path

from mien.core import RangeError
from mien.timeline import Rate, exact_rate

from .codecs import CODECS, Codec, find_codec

DEFAULT_FPS = 24.0

FPS_LOW, FPS_HIGH = 1, 240


def check_rate(fps: Rate, high: float = FPS_HIGH) -> Fraction:
    """Frames a second as a fraction; 23.976 is 24000/1001.

    Raises:
        RangeError: it is not in 1..``high``.
    """
    if not (math.isfinite(fps) and FPS_LOW <= fps <= high):
        raise RangeError(f"fps {float(fps):g} is out of range — it goes from {FPS_LOW} to {high:g} frames a second")
    return exact_rate(fps)


def check_film(path: Path | str, fps: Rate, size_px: tuple[int, int], transparent: bool = False) -> None:
    """Makes sure that a film of this suffix can have this rate, size and background.

    Raises:
        UnknownNameError: films have no such suffix.
        RangeError: it cannot, and what would do.
    """
    codec = find_codec(path)
    if check_rate(fps) > codec.fps_high:
        raise RangeError(
            f"{path}: {float(fps):g} frames a second are more than {codec.suffix} can tell apart — "
            f"at most {codec.fps_high:g}, or write .mp4"
        )
    _check_size(path, codec, size_px)
    if transparent and not codec.alpha:
        clear = ", ".join(each.suffix for each in CODECS if each.alpha)
        raise RangeError(
            f"{path}: {codec.suffix} has no transparency — write {clear} or PNG frames, or give a background colour"
        )


def _check_size(path: Path | str, codec: Codec, size_px: tuple[int, int]) -> None:
    longest, pixels = max(size_px), size_px[0] * size_px[1]
    if longest <= codec.most_side_px and pixels <= codec.most_pixels and min(size_px) >= codec.least_side_px:
        return
    share = min(codec.most_side_px / longest, math.sqrt(codec.most_pixels / pixels), 1.0)
    width, height = (max(codec.least_side_px, math.floor(side * share)) for side in size_px)
    raise RangeError(
        f"{path}: {size_px[0]}x{size_px[1]} pixels are not a size that {codec.suffix} can hold — "
        f"try --size {width}x{height}, or write PNG frames"
    )
