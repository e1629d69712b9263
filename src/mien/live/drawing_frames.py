"""Drawings as bytes: every frame has all its paths; outlines that paths share, or cut one another with, go once."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from itertools import accumulate
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.core import Drawing, MienError, Path, Region, Scene
from mien.render.outlines import find_fillings
from mien.render.pixels import to_srgb

from .quantising import Steps

COUNTS = struct.Struct("<f6I2f")
"""Step, 1 for a drawing, points, contours, outlines, paths, cuts; width and height of the canvas."""

INSIDE, OUTSIDE, UNDER = 0, 1, 2
"""What an outline does to a path: leaves what is inside, what is outside, or draws over the edge of what fills it."""


class DrawingFrames:
    """Setup and frames of drawings."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._steps: Steps | None = None

    def describe(self) -> dict[str, Any]:
        """Nothing else: frames tell everything."""
        return {"shape": "drawing"}

    def arrays(self) -> Mapping[str, NDArray[Any]]:
        """None."""
        return {}

    def encode(self, drawing: Drawing) -> bytes:
        """Step, counts, background; where contours, outlines and cuts end, points, outlines of paths, cuts, colours."""
        outlines = _Outlines()
        own = [outlines.number(path) for path in drawing.paths]
        cuts = [
            [(outlines.number(region), kind) for kind, regions in kinds for region in regions]
            for kinds in ([(INSIDE, path.inside), (OUTSIDE, path.outside)] for path in drawing.paths)
        ]
        for path, later in find_fillings(drawing):
            cuts[path].append((own[later], UNDER))
        middle = np.array(drawing.size) * 0.5
        if self._steps is None or (self._steps.middle != middle).any():
            self._steps = Steps(middle)
        points = self._steps.encode(np.concatenate([np.zeros((0, 2)), *outlines.contours]))
        flat = np.array([cut for each in cuts for cut in each], dtype="<u2").reshape(-1, 2)
        counts = (len(points), len(outlines.contours), len(outlines.ends), len(own), len(flat))
        colors = np.array([*self._scene.behind(drawing.background), *(path.color for path in drawing.paths)])
        if not np.isfinite(colors).all():
            raise MienError("a face to be sent has a colour that is not a finite number")
        codes = np.empty(colors.shape, dtype=np.uint8)
        codes[:, :3] = to_srgb(colors[:, :3])
        codes[:, 3] = np.rint(colors[:, 3] * 255.0)
        ends = [
            *accumulate(map(len, outlines.contours)),
            *outlines.ends,
            *accumulate(map(len, cuts)),
        ]
        return b"".join(
            (
                COUNTS.pack(self._steps.step, 1, *counts, *drawing.size),
                np.array(ends, dtype="<u4").tobytes(),
                points.tobytes(),
                np.array(own, dtype="<u2").tobytes(),
                flat.tobytes(),
                codes.tobytes(),
                np.array(outlines.nonzero, dtype=np.uint8).tobytes(),
            )
        )


class _Outlines:
    """Outlines by number; those made of the same arrays are the same.

    Attributes:
        contours: of all, one after the other.
        ends: where those of each end.
        nonzero: the rule of each; else it is evenodd.
    """

    def __init__(self) -> None:
        self.contours: list[NDArray[np.float64]] = []
        self.ends: list[int] = []
        self.nonzero: list[bool] = []
        self._numbers: dict[tuple[object, ...], int] = {}

    def number(self, outline: Path | Region) -> int:
        key = (outline.rule, *map(id, outline.contours))
        if key not in self._numbers:
            self._numbers[key] = len(self.ends)
            self.contours.extend(outline.contours)
            self.ends.append(len(self.contours))
            self.nonzero.append(outline.rule == "nonzero")
        return self._numbers[key]
