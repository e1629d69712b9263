"""A head whose skin moves as wanted: values of its shape parameters, and points of its own for the rest.

Parameters say in words what is special about a person and stay within their ranges. What they cannot do is the
residual; it is found by looking at the head that they make, because their regions lie on the person's own skin.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from mien.core import Parameter, Pose
    from mien.core.mesh import Points
    from mien.faces.head.head import Head
    from mien.faces.head.measured import Floats, Kind
    from mien.faces.head.residual import Residual

KINDS = ("blend", "scale", "move", "turn", "lids", "head")
LIDS = "lids"
"""Kind of the parameters that change how the lids are open: where there is a residual, it tells how."""

STEPS, SMALL = 3, 0.05
"""Gauss and Newton's steps, and the step of a finite difference as a share of a parameter's range."""

TRUSTED_M, EFFECTIVE = 0.001, 40.0
"""How near parameters should come to the wanted skin, as if it were told at so many places."""

DIGITS = 4
ROUNDS = 4
"""Times that a residual is mended by looking at the head that it makes."""


@dataclass(frozen=True, eq=False)
class Wanted:
    """What a head should become.

    Attributes:
        cage, surface: (V, 3) m, moves of both position sets.
        eyes: (2, 3) m, moves of the eyes.
        growth: radius of the eyes over the neutral one.
    """

    cage: Points
    surface: Points
    eyes: Points
    growth: float

    @classmethod
    def of(cls, moves: Points, growth: float) -> Wanted:
        """From moves (V + 2, 3) m of the cage and of the eyes; the lips of a face at rest go on meeting."""
        cage = _with_lips_met(moves[:-2])
        return cls(cage, _on_surface(cage), moves[-2:], growth)


def _with_lips_met(moves: Points) -> Points:
    """Moves (V, 3) m of the cage by which lips meet as the neutral head's do: points of both are not exact."""
    from mien.faces.head.lips import contacts_of
    from mien.faces.head.measured import archive

    contacts = contacts_of(archive(), archive().floats("cage"))
    out = moves.copy()
    for (upper, lower), upper_part in zip(contacts.numbers, contacts.gaps[:, 4], strict=True):
        gap = contacts.shares[:, None] * (out[lower[0]] - out[upper[0]])
        out[upper] += upper_part * gap
        out[lower] -= (1.0 - upper_part) * gap
    return out


def _on_surface(cage: Points) -> Points:
    """(V, 3) m, how the limit of a cage's subdivision moves with it."""
    from mien.core import Material, build_topology
    from mien.core.subdivision import refine
    from mien.faces.head.measured import archive

    topology, moves = build_topology(len(cage), [("skin", archive().quads, Material(subdivide=True))]), cage
    for _ in range(2):  # after which a vertex is taken to be where it stays, as where these people were measured
        fine = refine(topology)
        topology, moves = fine.topology, fine.matrix.apply(moves)
    return moves[: len(cage)]


def find_values(wanted: Wanted, *, lids: bool) -> dict[str, float]:
    """Values of the shape parameters, those that are not at rest, within their ranges and as likely as people's are.

    Args:
        wanted: what the skin should do.
        lids: whether to find those of the lids too.
    """
    from scipy.optimize import lsq_linear

    head, counted = _plain("surface"), _counted()
    rows, spreads = _parameters()
    chosen = [k for k, (_, kind) in enumerate(rows) if lids or kind != LIDS]
    table = [rows[k][0] for k in chosen]
    low, high, default = (np.array([getattr(row, name) for row in table]) for name in ("low", "high", "default"))
    spread, span = np.array([spreads[k] for k in chosen]), high - low
    names = [row.name for row in table]
    rest = _skin(head, head.neutral)[counted]
    trust = np.sqrt(EFFECTIVE / len(rest)) / TRUSTED_M
    values = default
    for _ in range(STEPS):
        pose = head.neutral.replace(dict(zip(names, values.tolist(), strict=True)))
        slopes = _slopes(head, pose, table, counted)
        left = wanted.surface[counted] - (_skin(head, pose)[counted] - rest)
        design = np.vstack([trust * slopes, np.diag(span / spread)])
        goal = np.concatenate([trust * left.ravel(), (default - values) / spread])
        step = lsq_linear(design, goal, ((low - values) / span - 1e-9, (high - values) / span + 1e-9)).x
        values = np.clip(values + span * step, low, high)
    rounded = {name: float(f"{value:.{DIGITS}g}") for name, value in zip(names, values.tolist(), strict=True)}
    moved = zip(table, rounded.items(), strict=True)
    return {name: value for row, (name, value) in moved if abs(value - row.default) > 1e-3 * (row.high - row.low)}


def find_residual(wanted: Wanted, values: Mapping[str, float]) -> Residual:
    """The points that a head of these values needs to become what is wanted."""
    from mien.faces.head.measured import archive
    from mien.faces.head.residual import Residual

    radius = float(archive().floats("eye_radius"))
    centres = archive().floats("eye_centre") + wanted.eyes
    residual = Residual(wanted.cage, wanted.surface, wanted.eyes, wanted.growth)
    for _ in range(ROUNDS if values else 1):
        head = replace(_plain("cage"), values=dict(values), residual=residual)
        cage, surface = (_missing(each, getattr(wanted, each.kind)) for each in (head, head.unsubdivided))
        balls = _balls(head)
        residual = Residual(
            residual.cage + cage,
            residual.surface + surface,
            residual.eye_shift + centres - np.array([centre for centre, _ in balls]),
            residual.eye_scale * radius * wanted.growth / float(np.mean([size for _, size in balls])),
        )
    kept = _stored(residual.cage), _stored(residual.surface), _stored(residual.eye_shift)
    return Residual(*kept, float(_stored(np.array(residual.eye_scale))))


def _stored(numbers: Floats) -> Floats:
    """Numbers as a file keeps them."""
    return numbers.astype(np.float32).astype(np.float64)


def _missing(head: Head, wanted: Points) -> Points:
    """(V, 3) m, what the skin of a head lacks."""
    plain = _plain(head.kind)
    return wanted - (_skin(head, head.neutral) - _skin(plain, plain.neutral))


def _balls(head: Head) -> list[tuple[Points, float]]:
    """Centre (3,) and radius m of both eyes of a head at rest."""
    points = head.shape(head.neutral).points
    return [sphere(points[head._layout.span[f"eye.{side}"]]) for side in ("left", "right")]


def sphere(points: Points) -> tuple[Points, float]:
    """Centre (3,) and radius of the sphere nearest to points (N, 3)."""
    middle = points.mean(axis=0)
    away = points - middle
    *centre, rest = np.linalg.lstsq(np.column_stack([2.0 * away, np.ones(len(away))]), (away**2).sum(axis=1), None)[0]
    return middle + np.array(centre), float(np.sqrt(rest + np.dot(centre, centre)))


@cache
def _plain(kind: Kind) -> Head:
    from mien.faces.head.head import Head

    return Head(hair="bald", kind=kind)


def _skin(head: Head, pose: Pose) -> Points:
    """(V, 3) m; what is creased comes after."""
    return head.shape(pose).points[: len(_counted())]


@cache
def _counted() -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """(V,) whether a vertex shows and turns with the head: people hold their necks at angles of their own."""
    from mien.faces.head.measured import archive
    from mien.faces.head.neck import neck_share

    head = archive()
    hidden = np.isin(np.arange(len(head.mirror)), head.quads[head.groups == head.group_names.index("mouth")])
    return ~hidden & (neck_share(head.floats("surface")) == 1.0)


@cache
def _parameters() -> tuple[list[tuple[Parameter, str]], list[float]]:
    """Parameters of the shape that move the skin with their kinds, and how much people differ in each."""
    from mien.faces.head.table import conformation_rows

    head = _plain("surface")
    found, spreads = [], []
    for row in conformation_rows():
        if row["kind"] not in KINDS:
            continue
        for side in (".left", ".right") if row["sides"] else ("",):
            found.append((head.parameters[row["name"] + side], row["kind"]))
            spreads.append(float(row["spread"]))
    slopes = _slopes(head, head.neutral, [parameter for parameter, _ in found], _counted())
    moving = [k for k in range(len(found)) if slopes[:, k].any() and spreads[k] > 0.0]
    return [found[k] for k in moving], [spreads[k] for k in moving]


def _slopes(
    head: Head, pose: Pose, rows: list[Parameter], counted: np.ndarray[tuple[int], np.dtype[np.bool_]]
) -> Floats:
    """(3 C, P) m, what the whole range of each parameter would move of the C counted points, by a small part of it."""
    shares = np.array([SMALL if row.high - pose[row.name] > pose[row.name] - row.low else -SMALL for row in rows])
    poses = np.repeat(pose.values[None], len(rows), axis=0)
    for number, (row, share) in enumerate(zip(rows, shares.tolist(), strict=True)):
        poses[number, pose.table.index[row.name]] += share * (row.high - row.low)
    moved = head.shapes(poses)[:, : len(counted)] - head.shapes(pose.values[None])[:, : len(counted)]
    return np.asarray((moved[:, counted].reshape(len(rows), -1) / shares[:, None]).T)
