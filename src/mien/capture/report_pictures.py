"""Photographs inside a page: small enough to send, and full size where a click is suspect."""

from __future__ import annotations

import base64
import io
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mien.core import LoadError

from .photographs import read_photograph
from .records import Photograph, Residual

Pixels = NDArray[np.uint8]

BUDGET_PX = 12e6
"""Pixels of all photographs of a page together, at most."""

LONGEST_PX = (480, 1400)
"""Bounds of the longer side of a photograph in a page."""

QUALITY = 80
"""Of JPEG."""

CROP_PX = 420
"""Longer side of the picture of a suspect at most; it is not magnified here."""

LEAST_CROP_PX = 48
"""Side of the piece of a photograph around a suspect, at least."""


@dataclass(frozen=True)
class Crop:
    """A piece of a photograph.

    Attributes:
        uri: the picture itself, as a data URI; empty where there is none.
        u, v: px, upper left corner in the photograph.
        size_px: (width, height) in the photograph.
    """

    uri: str
    u: float
    v: float
    size_px: tuple[float, float]


@dataclass(frozen=True)
class Embedded:
    """A photograph as it stands in the page.

    Attributes:
        uri: the whole picture, as a data URI; empty where it could not be read.
        crops: of its suspects, in their order.
        remark: why there is no picture; empty where there is one.
    """

    uri: str
    crops: tuple[Crop, ...]
    remark: str = ""


def embed(
    photographs: Sequence[Photograph],
    paths: Mapping[str, Path],
    suspects: Sequence[Residual],
    report: Callable[[int, int], None] | None = None,
) -> dict[str, Embedded]:
    """All photographs by name, small, with a crop of each suspect.

    Args:
        photographs: of the survey.
        paths: of files by name of the photograph; without one, where the photograph says that it lies.
        suspects: mis-clicks in them.
        report: is told how many are done, of how many.
    """
    longest = _longest_side(photographs)
    embedded = {}
    for number, photograph in enumerate(photographs, start=1):
        own = [each for each in suspects if each.observation.photo == photograph.name]
        embedded[photograph.name] = _embed(photograph, paths.get(photograph.name, photograph.path), own, longest)
        if report is not None:
            report(number, len(photographs))
    return embedded


def _longest_side(photographs: Sequence[Photograph]) -> int:
    """Longer side of each, px, so that all together keep to the budget."""
    low, high = LONGEST_PX
    area = sum(min(size) / max(size) for size in (photograph.size_px for photograph in photographs))
    return int(min(max(math.sqrt(BUDGET_PX / area), low), high)) if area > 0.0 else high


def _embed(photograph: Photograph, path: Path | None, suspects: Sequence[Residual], longest: int) -> Embedded:
    frames = [_frame_of(each, photograph.size_px) for each in suspects]
    bare = tuple(Crop("", *frame) for frame in frames)
    if path is None:
        return Embedded(
            "", bare, f"{photograph.name}: the picture is not there, so only what was clicked on it is shown."
        )
    try:
        pixels = read_photograph(path)
    except LoadError as error:
        return Embedded("", bare, f"The picture is not shown: {error}.")
    height, width = pixels.shape[:2]
    if (width, height) != tuple(photograph.size_px):
        wanted = "{} × {}".format(*photograph.size_px)
        return Embedded(
            "",
            bare,
            f"The picture is not shown: {path} has {width} × {height} pixels, but points were clicked on one of "
            f"{wanted} — is it another file, or was it turned or scaled since?",
        )
    crops = tuple(Crop(_crop_uri(pixels, crop), crop.u, crop.v, crop.size_px) for crop in bare)
    return Embedded(_uri(pixels, longest), crops)


def _frame_of(suspect: Residual, size_px: tuple[int, int]) -> tuple[float, float, tuple[float, float]]:
    """A square in the photograph with both places of a suspect, and room around them."""
    seen, (du, dv) = suspect.observation, (suspect.du, suspect.dv)
    side = max(LEAST_CROP_PX, 2.2 * abs(du), 2.2 * abs(dv), min(8.0 * math.hypot(du, dv), 0.06 * max(size_px)))
    side = float(min(round(side), *size_px))
    left = min(max(seen.u - du / 2.0 - side / 2.0, 0.0), size_px[0] - side)
    top = min(max(seen.v - dv / 2.0 - side / 2.0, 0.0), size_px[1] - side)
    return float(round(left)), float(round(top)), (side, side)


def _crop_uri(pixels: Pixels, crop: Crop) -> str:
    u, v, (width, height) = int(crop.u), int(crop.v), crop.size_px
    return _uri(pixels[v : v + int(height), u : u + int(width)], CROP_PX)


def _uri(pixels: Pixels, longest: int) -> str:
    from PIL import Image

    image = Image.fromarray(np.ascontiguousarray(pixels))
    image.thumbnail((longest, longest))
    buffer = io.BytesIO()
    image.save(buffer, "JPEG", quality=QUALITY, optimize=True)
    return "data:image/jpeg;base64," + base64.b64encode(buffer.getvalue()).decode("ascii")
