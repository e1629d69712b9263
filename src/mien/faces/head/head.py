"""The parametric head: a pose goes in, coloured polygons come out.

The order in which the parameters act: measured expressions, mouth, brows; the jaw; contact of the lips; the lids,
which ride on what lies beneath; eyes, brows, lashes, teeth and tongue; then the whole head on its neck.

Source: Parke 1974, chapter 3.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from mien.core import Mesh, ParameterTable, Pose, Preset, Topology
from mien.core.mesh import Points
from mien.core.sparse import SparseMatrix

from . import brows, eyes, shades
from .jaw import open_jaw, parke_shares, rotate_jaw
from .lashes import Lashes, caruncle, lash_points, lashes
from .lids import closing, move_lids
from .measured import Archive, Floats, Kind, Measured, archive
from .mouth import MouthRegions, close_lips, mouth_regions, move_mouth, tuck_lip
from .muscles import add_sideways, contract_muscles
from .neck import head_angles, neck_share, turn_back, turn_direction, turn_head
from .parts import Layout, lay_out
from .presets import head_presets
from .residual import Residual, apply_residual, carry, eyes_of
from .table import head_table
from .tongue import move_tongue
from .units import DEG
from .vectors import cross

SURFACE_BROW_LIFT_M = 0.001


@dataclass(frozen=True, eq=False)
class Head:
    """A human head.

    Attributes:
        name: its address.
        hair: one of the styles that ship.
        values: what this person has instead of the table's defaults (colours mostly).
        kind: cage for subdivided pictures, surface for classic ones.
        residual: points of the person's own, beyond the parameters.
        parke_jaw: Parke's shares of the jaw's angle instead of the fitted ones with their residual.
        doc: who it is, in a line.
    """

    name: str = "head"
    hair: str = "side_part"
    values: Mapping[str, float] = field(default_factory=dict)
    kind: Kind = "cage"
    parke_jaw: bool = False
    doc: str = ""
    residual: Residual | None = None
    family: str = field(default="head", init=False)
    _colors: OrderedDict[bytes, Floats] = field(default_factory=OrderedDict, init=False, repr=False)

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
        angles = head_angles(pose)
        balls = self._eyes(pose, angles)
        skin = self._skin(pose, balls)
        parts: dict[str, Points] = {
            "skin": skin[self._layout.skin],
            "collar": self._rest["collar"],
            "hair": self._rest["hair"],
        }
        parts |= self._inside(pose)
        rounded: dict[str, Points] = {}
        light, viewer = self._room(pose, ("light", "viewer"), angles)
        for side, ball in balls.items():
            parts[f"eye.{side}"], directions = eyes.eye_points(ball, self._layout.sides)
            rounded[f"eye.{side}"] = turn_direction(directions, angles)
            parts[f"spot.{side}"] = eyes.spot_points(ball, light, viewer)
            parts[f"caruncle.{side}"] = caruncle(skin, ball, side, self._archive)
            parts[f"lash.{side}"] = lash_points(self._lashes, skin, ball, side)
        strips = brows.place_brows(self._strips, skin, self._normals(skin))
        parts["brow.left"], parts["brow.right"] = np.split(strips, 2)
        layout = self._layout
        points = turn_head(layout.join(parts), angles, self._neck_share)
        return Mesh(layout.topology, points, self._color(pose, parts, balls), layout.join(rounded))

    # ---------------------------------------------------------------- steps

    def _skin(self, pose: Pose, balls: Mapping[str, eyes.Eye]) -> Points:
        measured = self._measured
        morphs = measured.morphs
        points = contract_muscles(measured.points, pose, morphs)
        points = add_sideways(points, pose["jaw.side"], morphs["jawLeft"], morphs["jawRight"])
        points = add_sideways(points, pose["mouth.side"], morphs["mouthLeft"], morphs["mouthRight"])
        points = brows.move_brows(points, pose, self._brow_regions, measured)
        points = move_mouth(points, pose, self._mouth, measured)
        angle = pose["jaw.rotation"]
        if self.parke_jaw:
            opened = rotate_jaw(points, angle, self._jaw_axis, self._parke_share)
        else:
            opened = open_jaw(points, angle, self._jaw_axis, self._jaw_open_deg, measured)
        opened = tuck_lip(opened, points, pose, self._mouth)
        opened = close_lips(opened, pose, angle / self._jaw_open_deg, self._mouth, measured)
        shut = [closing(pose[f"eyelid.opening.{side}"]) for side in balls]
        # Degrees of elevation from its sine: the arcsine's series is exact enough for lids.
        up = [ball.forward[1] * (1.0 + ball.forward[1] * ball.forward[1] / 6.0) / DEG for ball in balls.values()]
        return move_lids(opened, measured.lids, (shut[0], shut[1]), (float(up[0]), float(up[1])))

    def _inside(self, pose: Pose) -> dict[str, Points]:
        angle, axis, layout = pose["jaw.rotation"], self._jaw_axis, self._layout
        chin = {name: self._measured.morphs[name][self._chin] for name in ("jawLeft", "jawRight", "jawForward")}
        shift = add_sideways(
            pose["jaw.forward"] * chin["jawForward"], pose["jaw.side"], chin["jawLeft"], chin["jawRight"]
        )
        out = {}
        for name in ("teeth", "gums"):
            points = self._rest[name]
            lower = layout.lower[name]
            out[name] = np.where(lower[:, None], rotate_jaw(points, angle, axis) + shift, points)
        out["tongue"] = rotate_jaw(move_tongue(self._rest["tongue"], pose), 0.82 * angle, axis) + 0.7 * shift
        return out

    def _eyes(self, pose: Pose, angles: tuple[float, float, float]) -> dict[str, eyes.Eye]:
        (target,) = self._room(pose, ("target",), angles)
        centres, radius = self._balls
        out = {}
        for number, side in enumerate(("left", "right")):
            centre = centres[number]
            kappa = 0.0 if self.parke_jaw else (eyes.KAPPA_DEG if side == "left" else -eyes.KAPPA_DEG)
            forward = eyes.look_at(centre, target, pose[f"eye.turn.{side}"] + kappa, pose[f"eye.nod.{side}"])
            sizes = (pose[f"{ring}.size.{side}"] for ring in ("iris", "pupil", "fringe", "spot"))
            out[side] = eyes.Eye(centre, radius, forward, *sizes)
        return out

    @staticmethod
    def _room(pose: Pose, groups: tuple[str, ...], angles: tuple[float, float, float]) -> Points:
        """Places in the room as the turned head has them before it turns."""
        places = np.array([[pose[f"{group}.{axis}"] for axis in "xyz"] for group in groups])
        return turn_back(places, angles)

    def _normals(self, points: Points) -> Points:
        """(V, 3) of the skin, each the sum of its polygons' normals, which are as long as twice their areas."""
        quads = self._archive.quads
        a, b = points[quads[:, 2]] - points[quads[:, 0]], points[quads[:, 3]] - points[quads[:, 1]]
        return self._normal_matrix.apply(cross(a, b))

    def _color(self, pose: Pose, parts: Mapping[str, Points], balls: Mapping[str, eyes.Eye]) -> Floats:
        key = shades.palette_key(pose)
        if key not in self._colors:
            self._colors[key] = np.clip(self._layout.join(self._layout.colors(pose)), 0.0, 1.0)
            while len(self._colors) > 8:
                self._colors.popitem(last=False)
        colors = self._colors[key].copy()
        for side, ball in balls.items():
            colors[self._layout.span[f"eye.{side}"]] *= shades.lid_shadow(parts[f"eye.{side}"], ball.centre)
        edge = float(parts["skin"][self._lip_edge, 1])
        for name in ("teeth", "gums", "tongue"):
            colors[self._layout.span[name]] *= shades.lip_shadow(parts[name], edge)
        return colors

    # ---------------------------------------------------------------- constants

    @cached_property
    def _archive(self) -> Archive:
        return archive()

    @cached_property
    def _measured(self) -> Measured:
        measured = self._archive.measured(self.kind)
        return measured if self.residual is None else apply_residual(measured, self.residual, self._archive)

    @cached_property
    def _rest(self) -> Mapping[str, Points]:
        """Part -> (N, 3) m of what is not bound to the skin."""
        return {name: carry(points, self._archive, self.residual) for name, points in self._layout.rest.items()}

    @cached_property
    def _layout(self) -> Layout:
        return lay_out(self._archive, self.hair, self.kind)

    @cached_property
    def _mouth(self) -> MouthRegions:
        return mouth_regions(self._archive, self._measured)

    @cached_property
    def _brow_regions(self) -> brows.BrowRegions:
        return brows.brow_regions(self._measured)

    @cached_property
    def _strips(self) -> brows.BrowStrips:
        return brows.brow_strips(self._archive, SURFACE_BROW_LIFT_M if self.kind == "surface" else 0.0)

    @cached_property
    def _lashes(self) -> Lashes:
        return lashes(self._archive)

    @cached_property
    def _neck_share(self) -> Floats:
        """(V,) of the whole head: the collar stays, all but the neck turns fully."""
        share = np.ones(self.topology.vertex_count)
        share[self._layout.span["skin"]] = neck_share(self._measured.points)[self._layout.skin]
        share[self._layout.span["collar"]] = 0.0
        return share

    @cached_property
    def _jaw_axis(self) -> Floats:
        return self._archive.floats("jaw_axis")

    @cached_property
    def _jaw_open_deg(self) -> float:
        return float(self._archive.floats("jaw_open_angle")) / DEG

    @cached_property
    def _parke_share(self) -> Floats:
        return parke_shares(self._measured.jaw_share)

    @cached_property
    def _lip_edge(self) -> int:
        return self._archive.vertex["m0_0"]

    @cached_property
    def _chin(self) -> int:
        return self._archive.vertex["k11_2"]

    @cached_property
    def _balls(self) -> tuple[Points, float]:
        return eyes_of(self.residual, self._archive)

    @cached_property
    def _normal_matrix(self) -> SparseMatrix:
        quads = self._archive.quads
        rows = quads.ravel()
        columns = np.repeat(np.arange(len(quads)), 4)
        return SparseMatrix.from_entries(rows, columns, np.ones(len(rows)), (len(self._measured.points), len(quads)))
