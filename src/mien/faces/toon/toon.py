"""A drawn face that can be played.

Source: Thórisson 1996, appendix A1 (ToonFace).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise

import numpy as np

from mien.core import Drawing, ParameterTable, Path, Pose, Preset, Region

from .gazing import Seen, compensate, what_is_seen
from .lines import Moment, rest_of
from .motors import motors
from .polygons import Contours, Shape
from .presets import make_presets
from .proportions import Proportions, feature_of
from .records import LAYERS, STEPS, Character, Depth, Floats, Polygon
from .table import linear_color, make_table
from .turning import turn

FACE = "face"
HOLE = "hole"


@dataclass(frozen=True, eq=False)
class ToonFace:
    """A face drawn by an artist: polygons on control points that motors move.

    Attributes:
        character: what its file says.
        name: its address, ``toon:olav``.
        family: which tables of names fit it.
    """

    character: Character
    name: str
    family: str = field(default="toon", init=False)

    @cached_property
    def parameters(self) -> ParameterTable:
        """Its motors, proportions, colours and viewer."""
        return make_table(self.character)

    @cached_property
    def neutral(self) -> Pose:
        """All motors at rest."""
        return Pose.neutral(self.parameters)

    @cached_property
    def presets(self) -> Mapping[str, Preset]:
        """Expressions of the family, or the character's own, what its hand does, and its palettes."""
        return {preset.name: preset for preset in make_presets(self.character)}

    @property
    def unsubdivided(self) -> ToonFace:
        """Itself: nothing is subdivided."""
        return self

    def shape(self, pose: Pose) -> Drawing:
        """The drawing of a pose of this face's table."""
        moment = self.moment(pose)
        contours = [shape.contours(moment) for shape in self._shapes]
        return self._draw(self._place(contours, pose, moment), pose)

    def moment(self, pose: Pose) -> Moment:
        """What the motors do in a pose."""
        shares = {code: pose[motors()[code].parameter] for code in self.character.motors}
        if amount := pose["gaze.compensation"]:
            viewer = (pose["viewer.x"], pose["viewer.y"], pose["viewer.z"])
            shares = compensate(shares, self.character, self._seen, amount, viewer, pose["screen.curvature"])
        return Moment(self.character, shares)

    @cached_property
    def _seen(self) -> tuple[Seen, Seen]:
        return what_is_seen(self.character)

    @cached_property
    def _shapes(self) -> tuple[Shape, ...]:
        """The polygons in drawing order."""
        order: Sequence[str] = STEPS if self.character.mode == "strict" else LAYERS
        rest = rest_of(self.character)
        drawn = sorted(self.character.polygons, key=lambda polygon: order.index(polygon.layer))
        return tuple(Shape(polygon, rest) for polygon in drawn)

    @cached_property
    def _ends(self) -> tuple[tuple[int, ...], ...]:
        """For each polygon, where its contours end among the vertices of all."""
        counts = [[len(contour) for contour in shape.rest] for shape in self._shapes]
        ends = np.cumsum([count for each in counts for count in each]).tolist()
        return tuple(tuple(ends.pop(0) for _ in each) for each in counts)

    @cached_property
    def _depths(self) -> tuple[Floats, Floats, Floats]:
        """(N,) depth, bulge and shortening of every vertex; those of the body do not turn and are left out."""
        depths = [_depth(shape.polygon, self.character) for shape in self._shapes for _ in np.concatenate(shape.rest)]
        rows = np.array([(each.depth, each.bulge, each.shorten) for each in depths])
        return rows[self._turning, 0], rows[self._turning, 1], rows[self._turning, 2]

    @cached_property
    def _turning(self) -> np.ndarray:
        """(N,) which vertices turn with the head."""
        return np.concatenate([np.full(sum(map(len, shape.rest)), not shape.polygon.body) for shape in self._shapes])

    @cached_property
    def _proportions(self) -> Proportions:
        return Proportions(self.character, [(shape.polygon, sum(map(len, shape.rest))) for shape in self._shapes])

    def _place(self, contours: Sequence[Contours], pose: Pose, moment: Moment) -> list[Contours]:
        """The contours with proportions and the turn of the head, y up."""
        points = np.concatenate([contour for each in contours for contour in each])
        points = self._proportions.apply(points, pose)
        angles = [moment.shares.get(code, 0.0) for code in ("HH", "HV", "HT")]
        if any(angles):
            turned = turn(points[self._turning], self.character.head, *self._depths, *angles)
            points = points.copy()
            points[self._turning] = turned
        points = np.stack([points[:, 0], self.character.size[1] - points[:, 1]], axis=1)
        starts = [0, *(end for ends in self._ends for end in ends)]
        pieces = iter([points[start:end] for start, end in pairwise(starts)])
        return [tuple(next(pieces) for _ in ends) for ends in self._ends]

    def _draw(self, placed: Sequence[Contours], pose: Pose) -> Drawing:
        by_id = {shape.polygon.id: contours for shape, contours in zip(self._shapes, placed, strict=True)}
        rules = {shape.polygon.id: shape.polygon.rule for shape in self._shapes}
        regions = {name: Region(by_id[name], rules[name]) for name in self._cutters}
        colors = self._colors(pose)
        paths = []
        for shape, contours in zip(self._shapes, placed, strict=True):
            polygon = shape.polygon
            inside = tuple(regions[name] for name in polygon.clip)
            outside = tuple(regions[name] for name in self._holes) if polygon.kind == FACE else ()
            color = (*colors[polygon.fill], polygon.opacity)
            paths.append(Path(polygon.id, contours, color, polygon.rule, inside, outside))
        background = (*colors[self.character.background], 1.0)
        return Drawing(self.character.size, tuple(paths), background)

    @property
    def _strict(self) -> bool:
        return self.character.mode == "strict"

    @cached_property
    def _holes(self) -> tuple[str, ...]:
        return tuple(polygon.id for polygon in self.character.polygons if polygon.kind == HOLE) if self._strict else ()

    @cached_property
    def _cutters(self) -> frozenset[str]:
        """Polygons that others are cut by."""
        return frozenset([*self._holes, *(name for polygon in self.character.polygons for name in polygon.clip)])

    def _colors(self, pose: Pose) -> dict[str, tuple[float, float, float]]:
        """Linear colours by palette name, and those that polygons give themselves."""
        index, values = self.parameters.index, pose.values
        colors = {}
        for name in self.character.palette:
            first = index[f"palette.{name}.red"]
            colors[name] = (float(values[first]), float(values[first + 1]), float(values[first + 2]))
        fixed = {self.character.background, *(polygon.fill for polygon in self.character.polygons)} - colors.keys()
        return {**colors, **{code: linear_color(code) for code in fixed}}


def _depth(polygon: Polygon, character: Character) -> Depth:
    """Its own depth, else that of what it is attached to, else the head's."""
    feature = character.features.get(feature_of(polygon, character))
    return polygon.depth or (feature.depth if feature else None) or character.head.depth
