"""The parametric head: a pose goes in, coloured polygons come out.

``posing`` says in which order the parameters act, and ``data/order.csv`` has it as data.

Source: Parke 1974, chapter 3.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from mien.core import Mesh, MienError, ParameterTable, Pose, Preset, Rig, Topology
from mien.core.mesh import Points

from . import brows, eyes, shades
from .carrying import bind_to_skin
from .jaw import JawKind, remake_shares
from .lashes import lashes
from .measured import Archive, Floats, Kind, Measured, archive
from .mouth import mouth_regions
from .parts import Layout, Styles, lay_out
from .poser import CHIN_END, Eyes, Jaw, Poser
from .presets import head_presets
from .residual import Residual, apply_residual, eyes_of
from .rig import head_rig
from .table import head_table
from .units import DEG
from .wear import NONE

SURFACE_BROW_LIFT_M = 0.001


@dataclass(frozen=True, eq=False)
class Head:
    """A human head.

    Attributes:
        name: its address.
        hair: one of the styles that ship.
        beard: one of the beards that ship, or none.
        glasses: of those that ship, or none.
        values: what this person has instead of the table's defaults (colours mostly).
        kind: cage for subdivided pictures, surface for classic ones.
        residual: points of the person's own, beyond the parameters.
        jaw: fitted shares of the jaw's angle with their residual, or Parke's: with the lower lip tapered, or not yet.
        doc: who it is, in a line.
    """

    name: str = "head"
    hair: str = "side_part"
    values: Mapping[str, float] = field(default_factory=dict)
    kind: Kind = "cage"
    jaw: JawKind = "fitted"
    doc: str = ""
    residual: Residual | None = None
    beard: str = NONE
    glasses: str = NONE
    family: str = field(default="head", init=False)
    _palettes: OrderedDict[bytes, Floats] = field(default_factory=OrderedDict, init=False, repr=False)

    @cached_property
    def parameters(self) -> ParameterTable:
        """The table, with this person's own defaults."""
        return head_table(tuple(sorted(self.values.items())))

    @cached_property
    def neutral(self) -> Pose:
        """The pose of this person at rest."""
        return Pose.neutral(self.parameters)

    @cached_property
    def presets(self) -> Mapping[str, Preset]:
        """Expressions and palettes by name."""
        return head_presets()

    @cached_property
    def unsubdivided(self) -> Head:
        """The same head with points on the measured surface, for pictures without subdivision."""
        if self.kind == "surface":
            return self
        return replace(self, kind="surface")

    @property
    def topology(self) -> Topology:
        """What is connected with what."""
        return self._layout.topology

    @property
    def mirror_vertices(self) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
        """(V,) vertex that each vertex becomes in the mirror, -1 for hair, which need not be symmetric."""
        return self._layout.mirror

    def shape(self, pose: Pose) -> Mesh:
        """The head in a pose of its table: (V, 3) m and a colour a vertex."""
        self._check(pose.table)
        size = (self.topology.vertex_count, 3)
        points, normals, colors = np.empty(size), np.zeros(size), self._palette(pose).copy()
        self._poser.pose(pose.values, points, normals, colors)
        return Mesh(self.topology, points, colors, normals)

    def shapes(self, values: Floats, threads: int = 1) -> Points:
        """(N, V, 3) m, the points of many poses (N, P) of its table: those of ``shape`` to rounding, and faster."""
        points = np.empty((len(values), self.topology.vertex_count, 3))
        ends = [len(values) * k // threads for k in range(threads + 1)]
        runs = [slice(first, last) for first, last in pairwise(ends)]
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(lambda run: self._poser.pose_many(values[run], points[run]), runs))
        return points

    def rig(self, pose: Pose) -> Rig:
        """Skull, jaw and eyes as what moves as a whole in poses that differ from this one by movements only."""
        self._check(pose.table)
        return head_rig(self._layout, self._measured.points, pose, self.shape)

    def _check(self, table: ParameterTable) -> None:
        if table is not self.parameters and table.names != self.parameters.names:
            raise MienError(f"{self.name} cannot be posed by {len(table)} parameters of another kind of face")

    def _palette(self, pose: Pose) -> Floats:
        """(V, 3) colours without shadows."""
        key = shades.palette_key(pose)
        if key not in self._palettes:
            self._palettes[key] = np.clip(self._layout.join(self._layout.colors(pose)), 0.0, 1.0)
            while len(self._palettes) > 8:
                self._palettes.popitem(last=False)
        return self._palettes[key]

    # ---------------------------------------------------------------- constants

    @cached_property
    def _archive(self) -> Archive:
        return archive()

    @cached_property
    def _measured(self) -> Measured:
        measured = self._archive.measured(self.kind)
        return measured if self.residual is None else apply_residual(measured, self.residual, self._archive)

    @cached_property
    def _rest(self) -> dict[str, Points]:
        """Part -> (N, 3) m of what is not bound to the skin."""
        if self.residual is None:
            return dict(self._layout.rest)
        skin, moves = self._archive.floats("surface"), self.residual.surface
        return {name: points + bind_to_skin(points, skin).moves(moves) for name, points in self._layout.rest.items()}

    @cached_property
    def _layout(self) -> Layout:
        return lay_out(self._archive, Styles(self.hair, self.beard, self.glasses), self.kind)

    @cached_property
    def _poser(self) -> Poser:
        archive, measured = self._archive, self._measured
        lift_m = SURFACE_BROW_LIFT_M if self.kind == "surface" else 0.0
        centres, radius = eyes_of(self.residual, archive)
        kappa = eyes.KAPPA_DEG if self.jaw == "fitted" else 0.0
        return Poser(
            archive,
            measured,
            self._layout,
            self._rest,
            self.parameters,
            self._jaw,
            Eyes(np.column_stack([centres, [radius, radius]]), np.array([kappa, -kappa])),
            mouth_regions(archive, measured),
            brows.brow_strips(archive, lift_m),
            lashes(archive),
        )

    @cached_property
    def _jaw(self) -> Jaw:
        archive, measured = self._archive, self._measured
        chin = archive.vertex[CHIN_END]
        moves = np.stack([measured.morphs[name][chin] for name in ("jawLeft", "jawRight", "jawForward")])
        share = remake_shares(measured.jaw_share, self.jaw)
        residual = measured.jaw_residual if self.jaw == "fitted" else np.zeros_like(measured.jaw_residual)
        open_angle_deg = float(archive.floats("jaw_open_angle")) / DEG
        return Jaw(archive.floats("jaw_axis"), share, open_angle_deg, residual, moves)
