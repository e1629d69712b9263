"""From poses to points: one head's constants as arrays, handed to the kernels of ``posing`` in their order."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mien.core import ParameterTable
from mien.core.mesh import Ints, Points
from mien.core.sparse import SparseMatrix

from . import posing
from .brows import BrowRegions, BrowStrips, brow_moves
from .eyes import SPOT_SIDES, band_steps, circle
from .lashes import Lashes, caruncle_corners
from .lids import lid_table
from .measured import Archive, Floats, Measured
from .mouth import MouthRegions, smile_moves
from .moves import Moves, add_moves, moves_of, weigh_moves
from .muscles import muscle_moves
from .neck import neck_share
from .parts import Layout
from .rest import REST_OPENING
from .tongue import tip_share

CHUNK = 32
"""Poses of a batch that are worked on together: their skins fit a processor core's own cache."""


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
        brows: weights of the brows' deformers.
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
        brows: BrowRegions,
        strips: BrowStrips,
        lashes: Lashes,
    ) -> None:
        self._columns = np.array([table.index[name] for name in posing.CONTROLS], dtype=np.int64)
        moves = [*muscle_moves(measured.morphs), *brow_moves(brows, measured), *smile_moves(measured)]
        self._moves: Moves = moves_of(moves, table)
        self._skin = np.ascontiguousarray(measured.points).ravel()
        self._eyes = eyes
        starts = [layout.span[name].start for name in posing.PARTS]
        self._parts = np.array([*starts, layout.span["tongue"].stop], dtype=np.int64)
        lids, contacts = lid_table(measured.lids), mouth.contacts
        self._deform = (
            *(mouth.rows, mouth.moving, mouth.tuck[mouth.rows]),
            *(jaw.axis, jaw.share, jaw.open_angle_deg, jaw.residual, measured.morphs["mouthClose"]),
            *(contacts.numbers, contacts.shares, contacts.gaps),
            *(lids.numbers, lids.polar, lids.rest, REST_OPENING),
        )
        first = layout.span["teeth"].start
        self._rest = (layout.skin, layout.join(rest)[first:].ravel(), first)
        self._rings = (band_steps(layout.sides), circle(layout.sides), circle(SPOT_SIDES), caruncle_corners(archive))
        self._hairs = (
            *(np.stack(lashes.index), np.stack(lashes.weight), np.stack(lashes.reach)),
            *(np.stack(strips.index), np.stack(strips.weight), strips.offset),
            *(archive.quads, *_polygons_around(archive.quads, np.concatenate(strips.index), len(measured.points))),
        )
        lower = np.concatenate([layout.lower[name] for name in ("teeth", "gums")])
        carried = np.concatenate([lower, np.ones(len(rest["tongue"]), dtype=bool)])
        self._mouth = (carried, tip_share(rest["tongue"]), jaw.axis, jaw.chin)
        self._lip_edge = archive.vertex["m0_0"]
        self._neck_share = np.ones(layout.topology.vertex_count)
        self._neck_share[layout.span["skin"]] = neck_share(measured.points)[layout.skin]
        self._neck_share[layout.span["collar"]] = 0.0

    def pose(self, values: Floats, points: Points, normals: Points, colors: Points) -> None:
        """Fill the points (V, 3) m and normals (V, 3) of a pose (P,), and darken its colours (V, 3) by shadows."""
        weights = np.empty((1, len(self._moves.columns)))
        weigh_moves(values[None], self._moves.columns, self._moves.rules, weights)
        skins = np.empty((1, len(self._skin)))
        add_moves(weights, self._moves.deltas, self._skin, skins)
        controls = values[self._columns][None]
        self._place(controls, skins, points[None], normals[None])
        posing.shade_parts(self._parts, self._eyes.balls, self._lip_edge, points, colors)
        self._turn(controls, points[None], normals[None])

    def pose_many(self, values: Floats, points: Points) -> None:
        """Fill the points (N, V, 3) m of poses (N, P): as ``pose`` does, but for the rounding of sums of moves."""
        normals = np.empty((1, *points.shape[1:]))
        for first in range(0, len(values), CHUNK):
            some, out = values[first : first + CHUNK], points[first : first + CHUNK]
            weights = np.empty((len(some), len(self._moves.columns)))
            weigh_moves(some, self._moves.columns, self._moves.rules, weights)
            skins = weights @ self._moves.deltas
            skins += self._skin
            controls = np.take(some, self._columns, axis=1)
            self._place(controls, skins, out, normals)
            self._turn(controls, out, normals)

    def _place(self, controls: Floats, skins: Floats, points: Points, normals: Points) -> None:
        count = len(controls)
        skins = skins.reshape(count, -1, 3)
        gaze, scratch, radii = np.empty((count, 2, 3)), np.empty((2, *skins.shape[1:])), np.empty((7, 2))
        posing.aim_eyes(controls, self._eyes.balls, self._eyes.kappa_deg, gaze)
        posing.deform_skin(controls, gaze, *self._deform, scratch, skins)
        posing.place_skin(skins, *self._rest, points, points.reshape(count, -1))
        around = (controls, skins, gaze, self._parts, self._eyes.balls)
        posing.place_eyes(*around, *self._rings, radii, points, normals)
        posing.place_hairs(skins, self._parts, self._eyes.balls, *self._hairs, scratch[0], points)
        posing.place_mouth(controls, self._parts, *self._mouth, points)

    def _turn(self, controls: Floats, points: Points, normals: Points) -> None:
        posing.turn_heads(controls, self._parts, self._neck_share, points, normals)


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
