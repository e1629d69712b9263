"""Rigid parts of a face: what moves as a whole, about which point, and how much of each vertex goes along."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from .errors import MienError
from .face import Face
from .mesh import Ints, Points
from .parameters import Pose

Floats = NDArray[np.float64]

PULL = 1e-9
"""How much a pivot is drawn to the origin, where rotations about one axis alone leave it open."""


@dataclass(frozen=True)
class Joint:
    """A part that moves as a whole.

    Attributes:
        name: ``jaw``, ``eye.left``.
        parent: name of the joint that carries it; none of the first one.
        pivot: (x, y, z) m, what it turns about, where it is while the face is at rest.
        anchors: three vertices of it, not in one line: where they are says how it has moved.
        parameters: those that move it; at their defaults it is at rest.
    """

    name: str
    parent: str | None
    pivot: tuple[float, float, float]
    anchors: tuple[int, int, int]
    parameters: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Motion:
    """How J joints have moved from rest, in the head frame: a point p of joint j is at ``turns[j] p + shifts[j]``.

    Attributes:
        turns: (J, 3, 3) rotations.
        shifts: (J, 3) m.
    """

    turns: Floats
    shifts: Floats


@dataclass(frozen=True, eq=False)
class Rig:
    """The joints of a face, parents first.

    Attributes:
        joints: J of them.
        shares: (V, J) how much of each vertex goes with each joint; every row adds up to 1.
    """

    joints: tuple[Joint, ...]
    shares: Floats

    def __post_init__(self) -> None:
        if self.shares.ndim != 2 or self.shares.shape[1] != len(self.joints):
            raise MienError(f"shares of {len(self.joints)} joints have the shape {self.shares.shape}")
        known: set[str | None] = {None}
        for joint in self.joints:
            if joint.parent not in known:
                raise MienError(f"joint {joint.name!r} comes before {joint.parent!r}, which carries it")
            known.add(joint.name)

    @cached_property
    def parents(self) -> tuple[int, ...]:
        """Number of each joint's parent, -1 where there is none."""
        number = {joint.name: k for k, joint in enumerate(self.joints)}
        return tuple(-1 if joint.parent is None else number[joint.parent] for joint in self.joints)

    @property
    def pivots(self) -> Floats:
        """(J, 3) m."""
        return np.array([joint.pivot for joint in self.joints])

    def rest(self, pose: Pose) -> Pose:
        """The pose with every joint at rest."""
        table = pose.table
        names = {name for joint in self.joints for name in joint.parameters}
        return pose.replace({name: table[name].default for name in names})

    def motion(self, rest: Points, points: Points) -> Motion:
        """How the joints have moved from points (V, 3) m at rest to others."""
        return find_motion(np.array([joint.anchors for joint in self.joints]), rest, points)

    def steps(self, motion: Motion) -> tuple[Floats, Floats]:
        """Unit quaternions (J, 4), real part last, and places (J, 3) m of the joints, as their parents see them."""
        places = _turned(motion.turns, self.pivots) + motion.shifts
        turns = motion.turns.copy()
        for number, parent in enumerate(self.parents):
            if parent >= 0:
                back = motion.turns[parent].T[None]
                turns[number] = _products(back, motion.turns[number][None])[0]
        relative = np.array(
            [
                place if parent < 0 else _turned(motion.turns[parent].T[None], (place - places[parent])[None])[0]
                for place, parent in zip(places, self.parents, strict=True)
            ]
        )
        return np.array([quaternion(turn) for turn in turns]), relative


@runtime_checkable
class Rigged(Face, Protocol):
    """A face that has rigid parts."""

    def rig(self, pose: Pose) -> Rig:
        """The joints in poses that differ from this one by movements only."""


def pick_anchors(points: Points, vertices: Ints) -> tuple[int, int, int]:
    """Three of some vertices (N,) that lie far from one another; ``points`` (V, 3) m are those of all."""
    some = points[vertices]
    first = 0
    second = int(np.argmax(_lengths(some - some[first])))
    third = int(np.argmax(_lengths(_cross(some - some[first], some[second] - some[first]))))
    return int(vertices[first]), int(vertices[second]), int(vertices[third])


def find_motion(anchors: Ints, rest: Points, points: Points) -> Motion:
    """How rigid parts, each with three anchors (J, 3), have moved from points (V, 3) m at rest to others."""
    turns = _products(_frames(points[anchors]), _frames(rest[anchors]).transpose(0, 2, 1))
    shifts = points[anchors[:, 0]] - _turned(turns, rest[anchors[:, 0]])
    still = (points[anchors] == rest[anchors]).all(axis=(1, 2))
    turns[still], shifts[still] = np.eye(3), 0.0  # exactly
    return Motion(turns, shifts)


def find_pivot(motions: Iterable[Motion]) -> tuple[float, float, float]:
    """(x, y, z) m, the point that several motions of one joint leave where it is, as nearly as one can.

    Of an axis it is the point nearest to the head frame's origin.
    """
    sides, right = np.eye(3) * PULL, np.zeros(3)
    for motion in motions:
        for row, along in zip(np.eye(3) - motion.turns[0], motion.shifts[0], strict=True):
            sides += row[:, None] * row
            right += row * along
    x, y, z = _solve(sides[None], right[None])[0].tolist()
    return x, y, z


def unmoved(places: Points, shares: Floats, motion: Motion) -> Points:
    """(V, 3) m, where points would be at rest that the joints have moved by shares (V, J)."""
    if not (motion.turns - np.eye(3)).any() and not motion.shifts.any():
        return places
    blend, shift = np.zeros((len(places), 3, 3)), np.zeros((len(places), 3))
    for joint in range(shares.shape[1]):
        blend += shares[:, joint, None, None] * motion.turns[joint]
        shift += shares[:, joint, None] * motion.shifts[joint]
    return _solve(blend, places - shift)


def unturned(directions: Points, shares: Floats, motion: Motion) -> Points:
    """(V, 3) unit directions as they were before the joints turned them."""
    still = unmoved(directions, shares, Motion(motion.turns, np.zeros_like(motion.shifts)))
    length = _lengths(still)
    return still / np.where(length == 0.0, 1.0, length)[:, None]


def quaternion(turn: Floats) -> tuple[float, float, float, float]:
    """Unit quaternion (x, y, z, w) with w >= 0 of a rotation (3, 3).

    Source: Shepperd 1978, with the largest of the four found first.
    """
    (a, b, c), (d, e, f), (g, h, i) = turn.tolist()
    four = (1 + a - e - i, 1 - a + e - i, 1 - a - e + i, 1 + a + e + i)
    rows: Sequence[tuple[float, float, float, float]] = (
        (four[0], b + d, c + g, h - f),
        (b + d, four[1], f + h, c - g),
        (c + g, f + h, four[2], d - b),
        (h - f, c - g, d - b, four[3]),
    )
    row = rows[max(range(4), key=four.__getitem__)]
    length = float(np.sqrt(sum(x * x for x in row)))
    sign = -1.0 if row[3] < 0.0 else 1.0
    x, y, z, w = (sign * value / length for value in row)
    return x, y, z, w


def _frames(corners: Floats) -> Floats:
    """(J, 3, 3) right-angled axes as columns, fixed to three corners (J, 3, 3) each."""
    along = _unit(corners[:, 1] - corners[:, 0])
    across = _unit(_cross(along, corners[:, 2] - corners[:, 0]))
    return np.stack([along, across, _cross(along, across)], axis=2)


def _products(first: Floats, second: Floats) -> Floats:
    """(N, 3, 3) matrix products, summed in order."""
    return sum(first[:, :, k, None] * second[:, None, k, :] for k in range(3))  # type: ignore[return-value]


def _turned(turns: Floats, points: Points) -> Points:
    """(N, 3), each point turned by a rotation of its own (N, 3, 3)."""
    return sum(turns[:, :, k] * points[:, k, None] for k in range(3))  # type: ignore[return-value]


def _solve(matrices: Floats, right: Points) -> Points:
    """(N, 3) solutions of systems (N, 3, 3) by Cramer's rule: no library decides the last bit."""
    rows = matrices[:, 0], matrices[:, 1], matrices[:, 2]
    across = [_cross(rows[1], rows[2]), _cross(rows[2], rows[0]), _cross(rows[0], rows[1])]
    size = _dot(rows[0], across[0])
    return (across[0] * right[:, :1] + across[1] * right[:, 1:2] + across[2] * right[:, 2:]) / size[:, None]


def _cross(a: Points, b: Points) -> Points:
    return np.stack(
        [
            a[..., 1] * b[..., 2] - a[..., 2] * b[..., 1],
            a[..., 2] * b[..., 0] - a[..., 0] * b[..., 2],
            a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0],
        ],
        axis=-1,
    )


def _dot(a: Points, b: Points) -> Floats:
    return (a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1]) + a[:, 2] * b[:, 2]


def _lengths(a: Points) -> Floats:
    return np.sqrt(_dot(a, a))


def _unit(a: Points) -> Points:
    return a / _lengths(a)[:, None]
