"""The likeliest head through measured points: its moves, and where it is in the frame of the points.

All is normal: what is known of people, what the points tell. The pose is found with the shape, not before it.

Source: Rasmussen and Williams 2006, section 2.7 (a field with parameters of which nothing is known beforehand).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .fitting_people import Known, population

if TYPE_CHECKING:
    from mien.core.mesh import Points
    from mien.faces.head.measured import Floats

MODEL_M = 0.0004
"""How far our skin lies from the one it was measured on, whose places the names tell."""

STEPS, STILL = 12, 1e-9


@dataclass(frozen=True, eq=False)
class Placing:
    """Where a head is: its point x lies at ``scale * rotation @ x + place``.

    Attributes:
        rotation: (3, 3).
        place: (3,) m, of the head's origin.
        scale: of lengths.
    """

    rotation: Points
    place: Points
    scale: float = 1.0

    def to_world(self, points: Points) -> Points:
        """Points (N, 3) m of the head where they are."""
        return np.asarray(self.scale * points @ self.rotation.T + self.place)

    def to_head(self, points: Points) -> Points:
        """Points (N, 3) m in the head's own frame."""
        return np.asarray((points - self.place) @ self.rotation / self.scale)


def superpose(points: Points, wanted: Points, *, scaled: bool) -> Placing:
    """The placing that brings points (N, 3) nearest to others.

    Source: Umeyama 1991, equations 40 to 42.
    """
    middle, goal = points.mean(axis=0), wanted.mean(axis=0)
    u, size, vt = np.linalg.svd((wanted - goal).T @ (points - middle))
    sign = np.array([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    rotation = (u * sign) @ vt
    scale = float((size * sign).sum() / ((points - middle) ** 2).sum()) if scaled else 1.0
    return Placing(rotation, goal - scale * rotation @ middle, scale)


@dataclass(frozen=True, eq=False)
class Evidence:
    """Measured places of N points and what they are of.

    Attributes:
        places: (N, 3) m, as measured.
        covariances: (N, 3, 3) m².
        weights: (N, R) of their places on the head.
    """

    places: Points
    covariances: Floats
    weights: Floats

    def only(self, chosen: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> Evidence:
        """The chosen (N,) of them."""
        return Evidence(self.places[chosen], self.covariances[chosen], self.weights[chosen])


@dataclass(frozen=True, eq=False)
class Estimate:
    """A head through points.

    Attributes:
        placing: where it is.
        moves: (R, 3) m from the neutral head, of cage and eyes.
        growth: of the eyes: their radius over the neutral one.
        statistics: (N,) χ² of each point given all others, of 3 degrees of freedom.
        measured: (N, 3) m, the points in the head's frame.
        expected: (N, 3) m, those of the mean person.
        chi2: of all points, of 3 N - 6 degrees of freedom (one less with the scale).
        free: (3 N, 3 N) 1/m², what the points weigh for a change of shape: the pose is found anew with it.
        pull: (3 N,) 1/m, their weight times how far they are from the mean person.
    """

    placing: Placing
    moves: Points
    growth: float
    statistics: Floats
    measured: Points
    expected: Points
    chi2: float
    free: Floats
    pull: Floats

    def amount(self, change: Points) -> tuple[float, float]:
        """How much of a change (N, 3) m, that people do not differ by, the points show; and its standard deviation."""
        flat = change.ravel()
        weight = float(flat @ self.free @ flat)
        return float(flat @ self.pull) / weight, weight**-0.5


def estimate(evidence: Evidence, *, scaled: bool) -> Estimate:
    """The likeliest head; ``scaled`` where the unit of the points is not to be trusted."""
    people = population()
    seen = people.at(evidence.weights)
    expected = seen.points + seen.mean
    count = len(expected)
    spread = seen.covariance(seen).reshape(3 * count, 3 * count)
    placing = superpose(expected, evidence.places, scaled=scaled)
    for _ in range(STEPS):
        measured = placing.to_head(evidence.places)
        noise = _turned(evidence.covariances, placing)
        inverse = np.asarray(np.linalg.inv(spread + _on_diagonal(noise)), dtype=np.float64)
        slopes = _slopes(measured, scaled=scaled)
        weighed = slopes.T @ inverse
        step: Floats = np.linalg.inv(weighed @ slopes) @ (weighed @ (measured - expected).ravel())
        placing = _stepped(placing, step)
        if np.abs(step).max() < STILL:
            break
    measured = placing.to_head(evidence.places)
    surprise = (measured - expected).ravel()
    pull = inverse @ surprise
    moves = people.rows.mean + _drawn(people.rows, seen, pull)
    growth = people.growth + _growth(people.mode_growth, seen, pull)
    free = inverse - weighed.T @ np.asarray(np.linalg.inv(weighed @ slopes), dtype=np.float64) @ weighed
    return Estimate(
        placing, moves, growth, _left_out(free, pull), measured, expected, float(surprise @ pull), free, pull
    )


def _drawn(rows: Known, seen: Known, pull: Floats) -> Points:
    """(R, 3) m, how far the points draw all rows."""
    flat = rows.covariance(seen).reshape(3 * len(rows.points), -1)
    return np.asarray((flat @ pull).reshape(-1, 3))


def _growth(mode_growth: Floats, seen: Known, pull: Floats) -> float:
    """How far the points draw the size of the eyes, by what it has in common with the modes."""
    return float(mode_growth @ (seen.modes.reshape(len(mode_growth), -1) @ pull))


def _turned(covariances: Floats, placing: Placing) -> Floats:
    """(N, 3, 3) m² in the head's frame, and the model's own."""
    turn = placing.rotation / placing.scale
    return np.asarray(np.einsum("ka,nkl,lb->nab", turn, covariances, turn) + MODEL_M**2 * np.eye(3))


def _on_diagonal(blocks: Floats) -> Floats:
    """(3 N, 3 N) with blocks (N, 3, 3)."""
    count = len(blocks)
    out = np.zeros((count, 3, count, 3))
    out[np.arange(count), :, np.arange(count), :] = blocks
    return out.reshape(3 * count, 3 * count)


def _slopes(points: Points, *, scaled: bool) -> Floats:
    """(3 N, 6 or 7) how points (N, 3) go with a shift, a turn about the origin and growth."""
    columns = [np.broadcast_to(axis, points.shape) for axis in np.eye(3)]
    columns += [np.cross(axis, points) for axis in np.eye(3)]
    if scaled:
        columns.append(points)
    return np.stack([column.ravel() for column in columns], axis=1)


def _stepped(placing: Placing, step: Floats) -> Placing:
    """The placing after which measured points lie where the step (shift, turn, growth) takes off."""
    rotation = placing.rotation @ turn_by(step[3:6])
    scale = placing.scale * (1.0 + float(step[6])) if len(step) > 6 else placing.scale
    return Placing(rotation, placing.place + placing.scale * placing.rotation @ step[:3], scale)


def turn_by(vector: Floats) -> Points:
    """(3, 3) the turn about a vector (3,) by its length, rad.

    Source: Rodrigues 1840.
    """
    angle = float(np.linalg.norm(vector))
    if angle == 0.0:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross)


def _left_out(free: Floats, pull: Floats) -> Floats:
    """(N,) χ² of each point against what all others make of it, the pose found anew.

    Source: Rasmussen and Williams 2006, equations 5.10 to 5.12, for blocks of three.
    """
    count = len(pull) // 3
    blocks = free.reshape(count, 3, count, 3)[np.arange(count), :, np.arange(count), :]
    pulls = pull.reshape(count, 3)
    return np.asarray(np.einsum("na,nab,nb->n", pulls, np.linalg.pinv(blocks, hermitian=True), pulls))
