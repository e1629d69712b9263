"""A measured face that can be played.

Source: Parke 1972, "Computer Generated Animation of Faces".
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal

import numpy as np

from mien.core import Mesh, ParameterTable, Pose, Preset, Rig, Topology, exact
from mien.core.interpolation import cage_through
from mien.core.mesh import Ints, Points

from .blending import Blend, Floats
from .presets import keypose_presets
from .records import Keypose, Vector
from .rig import keypose_rig
from .skin import Skin, make_skin, split_left
from .table import NUMBER, keypose_table, phase_of
from .turning import turn_rigidly

SIDES = (".left", ".right")


@dataclass(frozen=True, eq=False)
class KeyposeFace:
    """A face of measured phases.

    Attributes:
        keypose: what its files say.
        name: its address, ``keypose:NAME`` or a path.
        kind: cage for subdivided pictures, whose surface passes through the measured points; or these as they are.
        family: which tables of names fit it.
    """

    keypose: Keypose
    name: str
    kind: Literal["cage", "surface"] = "cage"
    family: str = field(default="keypose", init=False)

    @cached_property
    def parameters(self) -> ParameterTable:
        """Phase number, weights of phases, turns of the head, and of eyes if it has them."""
        return keypose_table(self.keypose)

    @cached_property
    def neutral(self) -> Pose:
        """The first phase."""
        return Pose.neutral(self.parameters)

    @cached_property
    def presets(self) -> Mapping[str, Preset]:
        """Its phases by name, and the emotions that they allow."""
        return keypose_presets(self.keypose, self.parameters)

    @cached_property
    def unsubdivided(self) -> KeyposeFace:
        """The same face with the measured points as they are: that of 1972."""
        return self if self.kind == "surface" else replace(self, kind="surface")

    @property
    def topology(self) -> Topology:
        """What is connected with what."""
        return self._skin.topology

    @property
    def mirror_vertices(self) -> Ints:
        """(V,) vertex that each becomes in the mirror, -1 where the face is not the mirror image of its half."""
        return self._skin.mirror

    def shape(self, pose: Pose) -> Mesh:
        """The face in a pose of its table: (V, 3) m and a colour a polygon."""
        points = np.empty((self.topology.vertex_count, 3))
        self._place(pose.values, points)
        return Mesh(self.topology, points, self._skin.colors, by_polygon=True)

    def shapes(self, values: Floats, threads: int = 1) -> Points:
        """(N, V, 3) m, the points of many poses (N, P) of its table: those of ``shape``."""
        del threads  # a pose takes some twenty microseconds
        points = np.empty((len(values), self.topology.vertex_count, 3))
        for each, row in zip(points, values, strict=True):
            self._place(row, each)
        return points

    def rig(self, pose: Pose) -> Rig:
        """Head and eyes as what moves as a whole."""
        del pose  # everything else moves beneath the joints
        return keypose_rig(self)

    @cached_property
    def pivot(self) -> Vector:
        """(x, y, z) m, what the head turns about."""
        if self.keypose.pivot is not None:
            return self.keypose.pivot
        rest = self.keypose.places[0]
        _, y, z = ((rest.min(axis=0) + rest.max(axis=0)) * 0.5).tolist()
        return 0.0, y, z

    @cached_property
    def neck_share(self) -> Floats | float:
        """(V,) how much of the head's turns each vertex goes; 1 where all is one rigid piece."""
        neck = self.keypose.neck
        if neck is None:
            return 1.0
        height = self._skin.places(self.keypose.places[0])[:, 1]
        return exact.smoothstep((height - neck[0]) / (neck[1] - neck[0]))

    @cached_property
    def eyeballs(self) -> Mapping[str, tuple[Ints, Vector]]:
        """``left`` and ``right``: the vertices of an eye that turns, and its centre; empty if there is none."""
        eyes = self.keypose.eyes
        if eyes is None:
            return {}
        part = self.topology.part(eyes.part)
        used = np.unique(self.topology.corners[self.topology.starts[part.first] : self.topology.starts[part.last]])
        on_left = self._skin.places(self.keypose.places[0])[used, 0] > 0.0
        x, y, z = eyes.center
        return {"left": (used[on_left], (x, y, z)), "right": (used[~on_left], (-x, y, z))}

    @cached_property
    def reach_m(self) -> Floats:
        """(V,) m, how far the phases move each vertex along an axis at most."""
        return np.asarray(np.abs(self._blend.moves).max(axis=(0, 2)))

    def _place(self, values: Floats, points: Points) -> None:
        rows = self._rows
        number = float(values[rows.number]) if rows.number is not None else 1.0
        weights = np.where(rows.weights >= 0, values[rows.weights], 0.0)
        points[:] = self._blend.place(number, weights)
        for side, (vertices, center) in self.eyeballs.items():
            turn, nod = (float(values[self.parameters.index[f"eye.{way}.{side}"]]) for way in ("turn", "nod"))
            turn_rigidly(points, vertices, center, (turn, nod, 0.0))
        turn_rigidly(points, slice(None), self.pivot, values[rows.head].tolist(), self.neck_share)

    # ---------------------------------------------------------------- constants

    @cached_property
    def _skin(self) -> Skin:
        return make_skin(self.keypose)

    @cached_property
    def _blend(self) -> Blend:
        places = self._skin.places(self.keypose.places)
        left = split_left(places[0, :, 0])
        if self.kind == "cage" and any(part.material.subdivide for part in self.topology.parts):
            count, vertices = places.shape[:2]
            columns = np.ascontiguousarray(places.transpose(1, 0, 2)).reshape(vertices, 3 * count)
            cages, _ = cage_through(self.topology, columns)
            places = np.ascontiguousarray(cages.reshape(vertices, count, 3).transpose(1, 0, 2))
        return Blend(places, left)

    @cached_property
    def _rows(self) -> _Rows:
        index = self.parameters.index
        weights = [(-1, -1)]
        for name in self.keypose.phases[1:]:
            phase = phase_of(self.keypose, name)
            left, right = (f"phase.{phase.name}{side}" if phase.sided else f"phase.{phase.name}" for side in SIDES)
            weights.append((index[left], index[right]))
        head = [index[f"head.{way}"] for way in ("turn", "nod", "tilt")]
        return _Rows(index.get(NUMBER), np.array(weights), np.array(head))


@dataclass(frozen=True, eq=False)
class _Rows:
    """Row numbers of the table.

    Attributes:
        number: of the phase number.
        weights: (K, 2) of each phase on the left and on the right, -1 of the first.
        head: (3,) turn, nod and tilt.
    """

    number: int | None
    weights: Ints
    head: Ints
