"""From poses to points: one head's constants as arrays, handed to the kernels of ``posing`` in their order."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from itertools import pairwise

import numpy as np

from mien.core import ParameterTable
from mien.core.mesh import Ints, Points
from mien.core.sparse import SparseMatrix

from . import posing
from .brows import BrowStrips, brow_moves, brow_regions
from .carrying import Carried, bind_to_skin
from .conformation import Shaper, blend_moves, no_fields
from .contact import ball_gaps, before_teeth
from .controls import CONTROLS
from .directions import directions
from .eyes import band_steps, circle, spot_grid
from .folds import fold_moves, folds_of
from .lashes import Lashes, caruncle_corners
from .lids import lid_table
from .measured import Archive, Floats, Measured
from .mouth import MouthRegions, smile_moves
from .moves import Moves, moves_of
from .muscles import muscle_moves
from .neck import PIVOT, neck_share
from .parts import Layout
from .planing import planes_of
from .rest import REST_OPENING
from .table import head_table
from .teeth import TEETH_FIELDS, teeth_field
from .tongue import tongue_of

CHUNK = 32
"""Poses of a batch that are worked on together: their skins fit a processor core's own cache."""


CHIN_END = "k11_2"
"""The vertex at the lower end of the chin."""


@dataclass(frozen=True, eq=False)
class Jaw:
    """How the jaw of a head turns.

    Attributes:
        axis: (2,) m, y and z of the axis, which runs along x.
        share: (S,) share of the angle.
        open_angle_deg: of the measured open mouth.
        residual: (S, 3) m, what the rotation misses of it.
        chin: (3, 3) m, measured moves of the chin to the left, to the right, and forward.
    """

    axis: Floats
    share: Floats
    open_angle_deg: float
    residual: Points
    chin: Floats


@dataclass(frozen=True, eq=False)
class Eyes:
    """Where the eyes of a head are.

    Attributes:
        balls: (2, 4) m, centre and radius.
        kappa_deg: (2,) angle added to the turn of each.
    """

    balls: Floats
    kappa_deg: Floats


class Poser:
    """What decides the points of a head but the pose.

    Args:
        archive: measured arrays.
        measured: the skin, S points.
        layout: order of the V vertices.
        rest: part -> (N, 3) m of what is not bound to the skin.
        table: the head's parameters.
        jaw: how it turns.
        eyes: where they are.
        mouth: weights of the mouth's deformers.
        strips: the hair of the brows.
        lashes: those of both eyes.
    """

    def __init__(
        self,
        archive: Archive,
        measured: Measured,
        layout: Layout,
        rest: dict[str, Points],
        table: ParameterTable,
        jaw: Jaw,
        eyes: Eyes,
        mouth: MouthRegions,
        strips: BrowStrips,
        lashes: Lashes,
    ) -> None:
        self._columns = np.array([table.index[name] for name in CONTROLS], dtype=np.int64)
        self._moves = skin_moves(measured)
        self._folds = folds_of(archive, table, layout.skin, measured.kind)
        centres = eyes.balls[:, :3]
        first, behind = layout.span["teeth"].start, layout.span["tongue"].stop
        unbound = layout.join(rest)
        self._inside, still, held = unbound[first:behind], unbound[behind:], np.concatenate([centres, [PIVOT]])
        self._shaper = Shaper(
            table,
            centres,
            [
                (measured.points, no_fields),
                (self._inside, partial(_teeth_field, rest["teeth"], len(self._inside))),
                (held, no_fields),
                (still, CarriedFields(still, archive.floats("surface"))),
            ],
        )
        self._skin = np.ascontiguousarray(measured.points).ravel()
        starts = [layout.span[name].start for name in posing.PARTS]
        lids, contacts = lid_table(measured.lids), mouth.contacts
        self._pairs = len(contacts.numbers)
        lower = np.concatenate([layout.lower[name] for name in ("teeth", "gums")])
        below = layout.lower["teeth"]
        tongue = tongue_of(rest["tongue"], rest["teeth"][~below], rest["teeth"][below])
        wide = measured.points + measured.morphs["eyeWide_L"] + measured.morphs["eyeWide_R"]
        inner = archive.quads[archive.groups == archive.group_names.index("mouth")]
        seen = ~np.isin(np.arange(len(measured.points)), inner)
        before = before_teeth(
            measured.points,
            mouth.reds,
            seen,
            contacts.numbers[:, :, 0],
            self._inside[: len(lower)],
            lower,
        )
        share = np.ones(layout.topology.vertex_count)
        share[layout.span["skin"]] = neck_share(measured.points)[layout.skin]
        grown = layout.beard
        share[layout.span["beard"]] = neck_share(measured.points)[grown.index[:, 0]]
        share[layout.span["collar"]] = 0.0
        bound = np.concatenate([np.concatenate(strips.index).ravel(), grown.index.ravel()])
        planes = planes_of(archive, measured.kind)
        self._constants = (
            np.array([*starts, layout.span["tongue"].stop], dtype=np.int64),
            *(np.concatenate([eyes.balls, [(*PIVOT, 0.0)]]), eyes.kappa_deg),
            *(mouth.rows, mouth.moving, mouth.ends, mouth.tuck[mouth.rows]),
            *(jaw.axis, jaw.share, jaw.open_angle_deg, jaw.residual),
            *(measured.morphs["mouthClose"], contacts.numbers, contacts.shares, contacts.gaps),
            *(mouth.over_teeth, tongue.front),
            *(lids.numbers, lids.polar, lids.rest, lids.pairs, lids.gaps, REST_OPENING),
            ball_gaps(measured.lids, (measured.points, wide), eyes.balls),
            layout.skin,
            *(band_steps(layout.sides), circle(layout.sides), spot_grid(), caruncle_corners(archive)),
            *(np.stack(lashes.index), np.stack(lashes.weight), np.stack(lashes.reach)),
            *(np.stack(strips.index), np.stack(strips.weight), strips.offset),
            *(grown.index, np.ones(grown.index.shape), grown.offset),
            *(archive.quads, *_polygons_around(archive.quads, bound, len(measured.points))),
            *(
                np.concatenate([lower, np.ones(len(rest["tongue"]), dtype=bool)]),
                *(tongue.profile, tongue.edges, jaw.chin),
            ),
            *(before.rows, before.clearance, before.edge, archive.vertex[CHIN_END]),
            *(planes.pairs, planes.free),
            *(archive.vertex["m0_0"], share),
        )

    def pose(self, values: Floats, points: Points, normals: Points, colors: Points) -> None:
        """Fill the points (V, 3) m and normals (V, 3) of a pose (P,), and darken its colours (V, 3) by shadows."""
        skins = np.empty((1, len(self._skin)))
        posing.add_moves(self._weights(values[None]), self._moves.deltas, self._skin, skins)
        self._pose(values[None], skins, points[None], normals[None], colors[None])
        folds = self._folds
        amounts = np.empty(folds.count)
        posing.fold_colors(values, folds.drivers, folds.rules, folds.places, folds.dark, amounts, colors)

    def pose_many(self, values: Floats, points: Points) -> None:
        """Fill the points (N, V, 3) m of poses (N, P): as ``pose`` does, but for the rounding of sums of moves."""
        normals, colors = np.empty((1, *points.shape[1:])), np.empty((0, *points.shape[1:]))
        for first in range(0, len(values), CHUNK):
            some = values[first : first + CHUNK]
            skins = self._weights(some) @ self._moves.deltas
            skins += self._skin
            self._pose(some, skins, points[first : first + CHUNK], normals, colors)

    def _weights(self, values: Floats) -> Floats:
        """(N, M) how much of each move is added in poses (N, P)."""
        weights = np.empty((len(values), len(self._moves.columns)))
        posing.weigh_moves(values, self._moves.columns, self._moves.rules, weights)
        return weights

    def _pose(self, values: Floats, skins: Floats, points: Points, normals: Points, colors: Points) -> None:
        count = len(values)
        skins = skins.reshape(count, -1, 3)
        size = skins.shape[1]
        scratch = (
            *(np.empty((2, 3)), np.empty((7, 2)), np.empty((2, size, 3)), np.empty((2, size)), np.empty((3, 4))),
            np.empty((self._pairs, 4)),
        )
        flat, controls = points.reshape(count, -1), np.take(values, self._columns, axis=1)
        amounts = self._shaper.amounts(values)
        # A shape seldom changes from one pose to the next, so what only the shape moves is made once for each.
        changes = np.flatnonzero((amounts[1:] != amounts[:-1]).any(axis=1)) + 1
        for first, last in pairwise([0, *changes.tolist(), count]):
            run = slice(first, last)
            rest = np.concatenate([self._inside, self._shaper.still(amounts[first])]).ravel()
            shape = self._shaper.arrays(amounts[run])
            filled = skins[run], points[run], flat[run], normals, colors[run]
            posing.pose_heads(controls[run], *self._constants, rest, *shape, *scratch, *filled)


@lru_cache(maxsize=4)
def skin_moves(measured: Measured) -> Moves:
    """The moves of a skin; people who differ by parameters alone share them."""
    moves = [
        *muscle_moves(measured.morphs),
        *fold_moves(measured.morphs),
        *brow_moves(brow_regions(measured), measured),
        *smile_moves(measured),
        *blend_moves(directions(measured.kind)),
    ]
    return moves_of(moves, head_table())


def _teeth_field(teeth: Points, count: int, name: str) -> Points | None:
    """(count, 3) m, the moves of what is inside the mouth for one unit of a field; the teeth (T, 3) m come first."""
    if name not in TEETH_FIELDS:
        return None
    out = np.zeros((count, 3))
    out[: len(teeth)] = teeth_field(teeth, name)
    return out


class CarriedFields:
    """Measured directions carried over to points (N, 3) m beside a skin (S, 3) m, by name."""

    def __init__(self, points: Points, skin: Points) -> None:
        self._points, self._skin = points, skin

    @cached_property
    def _carried(self) -> Carried:
        return bind_to_skin(self._points, self._skin)

    def __call__(self, name: str) -> Points | None:
        """(N, 3) m for one unit of a direction; None where there is none of that name."""
        known = directions("surface")
        return self._carried.moves(known[name]) if name in known else None


def _polygons_around(quads: Ints, vertices: Ints, count: int) -> tuple[Ints, Ints, Ints]:
    """Some of ``count`` vertices, each once, and the polygons around them, as ``brows.sum_normals`` takes them."""
    wanted = np.zeros(count, dtype=bool)
    wanted[vertices] = True
    number = np.cumsum(wanted) - 1
    rows, columns = quads.ravel(), np.repeat(np.arange(len(quads)), 4)
    near = wanted[rows]
    total = int(wanted.sum())
    matrix = SparseMatrix.from_entries(number[rows[near]], columns[near], np.ones(int(near.sum())), (total, len(quads)))
    return np.flatnonzero(wanted), matrix.starts, matrix.columns
