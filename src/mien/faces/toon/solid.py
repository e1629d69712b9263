"""A drawn face on a simple body that turns freely: an egg or a box.

Source: Thórisson 1996, A1.4 (a face "texture-mapped onto three-dimensional shapes"); how it is done is ours.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from typing import Literal

import numpy as np

from mien.core import Drawing, Face, MienError, Parameter, ParameterTable, Path, Pose, UnknownNameError

from .gazing import Seen, what_is_seen
from .polygons import Contours
from .records import Floats
from .solid_box import Box
from .solid_egg import Egg
from .solid_form import Form
from .solid_motion import Motion
from .table import OWN
from .toon import ToonFace

Solid = Literal["egg", "box"]
SOLIDS: tuple[Solid, ...] = ("egg", "box")

ANGLES: Mapping[str, tuple[str, bool]] = {
    "solid.turn": ("The {solid} with the face turned to the own left.", True),
    "solid.nod": ("The {solid} with the face nodded; positive looks up.", False),
    "solid.tilt": ("The {solid} with the face tilted towards the own left shoulder.", True),
}

BOX_DEPTH = 0.5
"""Half the thickness of a box as a share of half the width of the head: our choice."""

THIN_DEPTH = 0.12
"""The same of what stands out from a box: our choice."""

OVER_BACK = ("back", "front")
"""Seen from behind, what is drawn behind the face lies over it, and what is drawn before all else lies over that."""

FAR = 9
"""Stage of what is drawn after all of the head, or with a minus before."""

WALL_SHADE = 0.6
"""Light on the walls of a box as a share of that on its front: our choice."""


@dataclass(frozen=True, eq=False)
class OnSolid(ToonFace):
    """A drawn face on a body that turns; at rest it looks as it was drawn.

    What reaches the outline of the head goes around its back; the rest of the drawing is on the front only. The
    motors of the head turn the body. What is drawn below the head stays.

    Attributes:
        solid: egg or box.
    """

    solid: Solid = "egg"

    @cached_property
    def parameters(self) -> ParameterTable:
        """The rows of the drawn face, and three angles."""
        table = super().parameters
        rows = [
            Parameter(name, -180.0, 180.0, 0.0, "deg", "solid", odd, doc.format(solid=self.solid), OWN)
            for name, (doc, odd) in ANGLES.items()
        ]
        return ParameterTable((*table.rows, *rows), table.aliases)

    def shape(self, pose: Pose) -> Drawing:
        """The drawing of a pose of this face's table."""
        moment = self.moment(pose)
        aside, rise, lean = (moment.shares.get(code, 0.0) for code in ("HH", "HV", "HT"))
        turn, nod, tilt = (pose[name] for name in ANGLES)
        angles = (turn - aside, nod + rise, tilt + lean)
        if not any(angles):
            return super().shape(pose)
        x, y = (np.array(self.character.head.pivot) - self._form.center).tolist()
        motion = Motion.of(*angles, (x, -y))
        contours = self._form.cut(self._grown([shape.contours(moment) for shape in self._shapes], pose))
        return self._on_egg(contours, motion, pose) if self.solid == "egg" else self._on_box(contours, motion, pose)

    @cached_property
    def _seen(self) -> tuple[Seen, Seen]:
        return what_is_seen(self.character, solid=True)

    @cached_property
    def _form(self) -> Form:
        polygons, rest = ([getattr(shape, name) for shape in self._shapes] for name in ("polygon", "rest"))
        return Form.of(self.character, polygons, rest)

    def _grown(self, contours: Sequence[Contours], pose: Pose) -> list[Contours]:
        """Contours with the proportions of a pose."""
        points = self._proportions.apply(np.concatenate(list(chain(*contours))), pose)
        pieces = iter(np.split(points, list(chain(*self._ends))[:-1]))
        return [tuple(next(pieces) for _ in ends) for ends in self._ends]

    def _on_egg(self, contours: Sequence[Contours], motion: Motion, pose: Pose) -> Drawing:
        """The drawing of contours, from the middle of the head, on a turned egg."""
        egg, form = Egg(self._form.radii, motion), self._form
        roles = list(zip(form.roles, contours, strict=True))
        fronts = egg.carry([each if role in ("front", "around") else () for role, each in roles])
        backs = egg.carry([each if role == "around" else () for role, each in roles], back=True)

        def paint(number: int, _: Contours) -> Iterator[Piece]:
            polygon, front, back = self._shapes[number].polygon, fronts[number], backs[number]
            if polygon.rule == "nonzero":
                yield Piece(0, (*front, *back))
            else:  # Where front and back overlap at the rim, the rule would make a hole of that.
                yield Piece(0, tuple(back), alone=True)
                yield Piece(0, tuple(front))
            if polygon.layer in OVER_BACK:
                yield Piece(1, tuple(back))

        def stand(number: int, contour: Floats, anchor: Floats) -> Iterator[Piece]:
            seen, ahead = egg.stand(contour, anchor)
            # Ears are seen before the head from their side; what stands on top of it stays behind it.
            yield Piece(min(ahead, 0) if not form.ears[number] else 2 * ahead, (seen,))

        return self._painted(self._pieces(contours, motion, paint, stand), pose)

    def _on_box(self, contours: Sequence[Contours], motion: Motion, pose: Pose) -> Drawing:
        """The drawing of contours, from the middle of the head, on a turned box."""
        form = self._form
        width = 0.5 * float(form.radii[0] + form.radii[len(form.radii) // 2])
        box, thin = Box(BOX_DEPTH * width, motion), Box(THIN_DEPTH * width, motion)

        def paint(number: int, each: Contours) -> Iterator[Piece]:
            polygon, around = self._shapes[number].polygon, form.roles[number] == "around"
            plate = tuple(box.plate(each)) if around or motion.shows_front else ()
            yield Piece(0, plate)
            if around and not motion.shows_front and polygon.layer in OVER_BACK:
                yield Piece(1, plate)
            if around and not polygon.clip:
                yield Piece(-2, tuple(box.walls(each, form.at_rim(each))), wall=True)

        def stand(number: int, contour: Floats, anchor: Floats) -> Iterator[Piece]:
            stage = -3 if thin.is_behind(anchor) else -1
            yield Piece(stage, tuple(thin.plate([contour])))
            if not form.inner[number]:
                yield Piece(stage, tuple(thin.walls([contour], [np.full(len(contour), True)])), wall=True)

        return self._painted(self._pieces(contours, motion, paint, stand), pose)

    def _pieces(
        self,
        contours: Sequence[Contours],
        motion: Motion,
        paint: Callable[[int, Contours], Iterable[Piece]],
        stand: Callable[[int, Floats, Floats], Iterable[Piece]],
    ) -> list[list[Piece]]:
        """The pieces of each polygon: of what is painted on the body, and of each contour that stands out from it."""
        form = self._form
        pieces: list[list[Piece]] = []
        for number, (role, each) in enumerate(zip(form.roles, contours, strict=True)):
            if role == "still":
                pieces.append([Piece(0, each)])
            elif role != "out":
                pieces.append(list(paint(number, each)))
            elif form.inner[number] and not motion.shows_front:
                pieces.append([])
            else:
                pairs = zip(each, form.anchors[number], strict=True)
                pieces.append([piece for contour, anchor in pairs for piece in stand(number, contour, anchor)])
        return pieces

    def _painted(self, pieces: Sequence[Sequence[Piece]], pose: Pose) -> Drawing:
        """The drawing of the pieces of each polygon; those of stage 0 lie where they were drawn, the others around."""
        form = self._form
        whole = [tuple(chain(*(piece.contours for piece in each if not piece.wall))) for each in pieces]
        drawing = self._draw([form.on_canvas(each) for each in whole], pose)
        stages: dict[int, list[Path]] = {}
        turning = [number for number, role in enumerate(form.roles) if role != "still"]
        for number, (path, each) in enumerate(zip(drawing.paths, pieces, strict=True)):
            # What was drawn before or after all of the head stays there.
            beyond = -FAR if number < turning[0] else FAR if number > turning[-1] else 0
            together: dict[tuple[int, bool, bool], list[Floats]] = {}
            for piece in each:
                together.setdefault((piece.stage or beyond, not piece.wall, not piece.alone), []).extend(piece.contours)
            for (stage, flat, _), found in sorted(together.items()):
                if found:
                    part = replace(path, contours=form.on_canvas(found))
                    stages.setdefault(stage, []).append(part if flat else _wall(part))
        return replace(drawing, paths=tuple(chain(*(stages[stage] for stage in sorted(stages)))))


def on_solid(face: Face, solid: str) -> OnSolid:
    """A drawn face on a solid body, egg or box.

    Raises:
        UnknownNameError: there is no such body.
        MienError: the face is not drawn.
    """
    if not isinstance(face, ToonFace):
        raise MienError(f"{face.name}: only drawn faces can be put on {' or '.join(SOLIDS)}")
    for known in SOLIDS:
        if solid == known:
            return OnSolid(face.character, f"{face.name}+{solid}", solid=known)
    raise UnknownNameError("solid body", solid, SOLIDS)


@dataclass(frozen=True, eq=False)
class Piece:
    """A part of a polygon as it is seen.

    Attributes:
        stage: when it is drawn: 0 in its turn, below 0 before all others of the head, above 0 after them.
        contours: from the middle of the head, y up.
        wall: it is a wall of a box, and drawn before what is none.
        alone: it is a path of its own, drawn before the rest of the polygon.
    """

    stage: int
    contours: Contours
    wall: bool = False
    alone: bool = False


def _wall(path: Path) -> Path:
    red, green, blue, alpha = path.color
    color = (red * WALL_SHADE, green * WALL_SHADE, blue * WALL_SHADE, alpha)
    return Path(f"{path.name}.wall", path.contours, color, "nonzero")
