"""The 2-D result of a face: an ordered list of filled paths."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .errors import MienError


@dataclass(frozen=True, eq=False)
class Path:
    """One filled shape; where contours overlap an even number of times there is a hole (even-odd rule).

    Attributes:
        name: the part it shows.
        contours: closed outlines, each (N, 2) in the drawing's units, x right, y up.
        color: linear RGBA 0..1.
    """

    name: str
    contours: tuple[NDArray[np.float64], ...]
    color: tuple[float, float, float, float]

    def __post_init__(self) -> None:
        for contour in self.contours:
            if contour.ndim != 2 or contour.shape[1] != 2 or not np.isfinite(contour).all():
                raise MienError(
                    f"path {self.name!r}: a contour must be finite points (N, 2), got shape {contour.shape}"
                )


@dataclass(frozen=True, eq=False)
class Drawing:
    """Filled paths, drawn in order, on a canvas of ``size`` (width, height) with its origin in the lower left."""

    size: tuple[float, float]
    paths: tuple[Path, ...]
