"""How people's heads differ: what is known about a head before any of its points is measured.

Fifty people and their mirror images give a mean and directions of one standard deviation. Few people bear witness to
what lies far apart only by chance, so part of what they have in common fades with distance; and every place may differ
by a little that no one of them shows.

Source: Gaspari and Cohn 1999 (covariances of few samples, tapered by distance).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from mien.core.mesh import Points
    from mien.faces.head.measured import Archive, Floats

FLIP = (-1.0, 1.0, 1.0)

LASTING, FADING_M = 0.8, 0.10
"""Share of a covariance that lasts over any distance, and the length over which the rest fades."""

OWN_M, OWN_LENGTH_M = 0.0005, 0.02
"""Standard deviation of what a person has that fifty others have not, and how far it reaches."""


@dataclass(frozen=True, eq=False)
class Known:
    """What is known beforehand about N places of a head.

    Attributes:
        points: (N, 3) m, on the neutral head.
        mean: (N, 3) m, how the mean of people differs from it.
        modes: (K, N, 3) m, directions of one standard deviation.
    """

    points: Points
    mean: Points
    modes: Floats

    def covariance(self, other: Known) -> Floats:
        """(N, 3, M, 3) m², of the moves of these places with those of others."""
        count, own, their = len(self.modes), len(self.points), len(other.points)
        distance = np.sqrt(((self.points[:, None] - other.points[None]) ** 2).sum(axis=-1))
        shared = self.modes.reshape(count, -1).T @ other.modes.reshape(count, -1)
        taper = LASTING + (1.0 - LASTING) * np.exp(-0.5 * (distance / FADING_M) ** 2)
        out = shared.reshape(own, 3, their, 3) * taper[:, None, :, None]
        near = OWN_M**2 * np.exp(-0.5 * (distance / OWN_LENGTH_M) ** 2)
        for axis in range(3):
            out[:, axis, :, axis] += near
        return out


@dataclass(frozen=True, eq=False)
class Population:
    """People by R rows: the vertices of the cage, then the left and the right eye.

    Attributes:
        rows: what is known about each row.
        growth: how large the mean person's eyes are, as a share of the neutral head's.
        mode_growth: (K,) the change of that with each mode.
    """

    rows: Known
    growth: float
    mode_growth: Floats

    def at(self, weights: Floats) -> Known:
        """What is known about places of weights (N, R) over the rows."""
        rows = self.rows
        return Known(weights @ rows.points, weights @ rows.mean, np.einsum("nr,krc->knc", weights, rows.modes))


@cache
def population() -> Population:
    """The people that ship."""
    from mien.faces.head.measured import archive, read_archive

    head, people = archive(), read_archive("population")
    even, odd = _whole(head, people.floats("even"), 1.0), _whole(head, people.floats("odd"), -1.0)
    points = np.concatenate([head.floats("cage"), head.floats("eye_centre")])
    growth = np.concatenate([people.floats("even_growth"), np.zeros(len(odd))])
    mean = _whole(head, people.floats("mean")[None], 1.0)[0]
    return Population(Known(points, mean, np.concatenate([even, odd])), float(people.floats("growth")), growth)


def _whole(head: Archive, left: Floats, sign: float) -> Floats:
    """Fields (K, R, 3) of both sides from those of the left half and eye; ``sign`` -1 for antisymmetric ones."""
    half, count = len(head.vertex), len(head.mirror)
    out = np.empty((len(left), count + 2, 3))
    out[:, head.mirror[:half]] = sign * left[:, :half] * FLIP
    out[:, count + 1] = sign * left[:, half] * FLIP
    out[:, :half], out[:, count] = left[:, :half], left[:, half]
    return out
