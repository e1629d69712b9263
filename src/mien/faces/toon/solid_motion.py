"""Points of a head in space, turned and seen from the front. Axes: x right as seen, y up, z out of the picture."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .records import Floats
from .turning import sin_cos_deg

THICK = 0.55
"""Thickness of what stands out from the head, as a share of its width: our choice."""

Row = tuple[float, float, float]


@dataclass(frozen=True)
class Motion:
    """A head tilted about its pivot, then nodded and turned about its middle.

    Attributes:
        rows: of the rotation, from the axes of the head to those of the picture.
        pivot: (x, y) about which it tilts, from the middle of the head.
        tilt: cosine and sine of the tilt.
        widths: how wide and how high something is seen that is about half as thick as it is wide.
    """

    rows: tuple[Row, Row, Row]
    pivot: tuple[float, float]
    tilt: tuple[float, float]
    widths: tuple[float, float]

    @classmethod
    def of(cls, turn_deg: float, nod_deg: float, tilt_deg: float, pivot: tuple[float, float]) -> Motion:
        """The motion by three angles: to the head's own left, upwards, towards its own left shoulder."""
        (st, ct), (sn, cn), (sl, cl) = (sin_cos_deg(angle) for angle in (turn_deg, nod_deg, tilt_deg))
        return cls(
            (
                (ct * cl + st * sn * sl, ct * sl - st * sn * cl, st * cn),
                (-cn * sl, cn * cl, sn),
                (-st * cl + ct * sn * sl, -st * sl - ct * sn * cl, ct * cn),
            ),
            pivot,
            (cl, sl),
            (_width(ct, st), _width(cn, sn)),
        )

    @property
    def lean(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Rows of the tilt within the picture."""
        cosine, sine = self.tilt
        return (cosine, sine), (-sine, cosine)

    @property
    def towards_viewer(self) -> Row:
        """The direction to the viewer in the axes of the head."""
        return self.rows[2]

    @property
    def shows_front(self) -> bool:
        """The front of the head is seen rather than its back."""
        return self.rows[2][2] > 0.0

    def apply(self, points: Floats) -> Floats:
        """(N, 3) places of points (N, 3) of the head, both from its middle at rest."""
        x, y, z = points.T
        right, up, ahead = (row[0] * x + row[1] * y + row[2] * z for row in self.rows)
        # The tilt is about the pivot, so the middle of the head goes along with it.
        (px, py), (cosine, sine) = self.pivot, self.tilt
        return np.stack([right + px - (px * cosine + py * sine), up + py - (py * cosine - px * sine), ahead], axis=1)


def _width(cosine: float, sine: float) -> float:
    return math.copysign(math.sqrt(cosine * cosine + THICK * THICK * sine * sine), cosine)
