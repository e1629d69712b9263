"""What rates and sizes a film can have; apart from the film itself, so that asking needs no codecs."""

from __future__ import annotations

import math
from fractions import Fraction
from pathlib import Path

from mien.core import RangeError
from mien.timeline import Rate, exact_rate

FPS_LOW, FPS_HIGH = 1, 240

LEAST_SIDE_PX = 16


def check_rate(fps: Rate) -> Fraction:
    """Frames a second as a fraction; 23.976 is 24000/1001.

    Raises:
        RangeError: it is not in 1..240.
    """
    if not (math.isfinite(fps) and FPS_LOW <= fps <= FPS_HIGH):
        raise RangeError(f"fps {float(fps):g} is out of range — it goes from {FPS_LOW} to {FPS_HIGH} frames a second")
    return exact_rate(fps)


def check_film(path: Path | str, fps: Rate, size_px: tuple[int, int], transparent: bool = False) -> None:
    """Makes sure that a film can have this rate, size and background.

    Raises:
        RangeError: it cannot, and what would do.
    """
    check_rate(fps)
    if any(side % 2 or side < LEAST_SIDE_PX for side in size_px):
        near = "x".join(str(max(LEAST_SIDE_PX, side + side % 2)) for side in size_px)
        raise RangeError(
            f"{path}: a film of {size_px[0]}x{size_px[1]} pixels — its sides must be even and at least "
            f"{LEAST_SIDE_PX}: try {near}"
        )
    if transparent:
        raise RangeError(f"{path}: a film has no transparency — give a background colour, or write PNG frames")
