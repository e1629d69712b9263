"""The polygons of a character, from the parts of a drawing, and those that a drawing of one pose does not show."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Any

from .numbers import format_number
from .svg_reader_outlines import Outline, ellipse, path_data
from .svg_reader_paints import Paint
from .toon_from_svg_colors import Palette, mix
from .toon_from_svg_guess import Found, Part
from .toon_from_svg_judging import is_flat
from .toon_from_svg_lenses import lens_outline
from .toon_from_svg_pieces import Box, Piece, contrast, luminance, outline_box
from .toon_from_svg_rig import Rig

Entry = dict[str, Any]
"""A polygon of the file."""

LAYERS = ("back", "face", "hole", "pupil", "inner", "free", "point", "feature", "front")

FACE = {"depth": 0.06}
INNER = {"depth": 0.12, "bulge": 0.4, "shorten": 0.9}
FRONT = {"depth": 0.14, "bulge": 0.1, "shorten": 0.3}
BEHIND = {"depth": -0.2, "shorten": 0.1}
NOSE = {"depth": 0.3, "bulge": 0.4, "shorten": 1}
EAR = {"depth": -0.1, "shorten": 0.2}
"""How far shapes lie before the axis of the head, in its radii, and how they go along: our choice."""

PLACES = ("depth", "bulge", "shorten", "body")
"""Keys that say how a polygon goes along with the head."""

ALIKE, FINE = 0.5, 0.05
"""Drawing units by which a clip may differ from a shape that it is, and to which both are measured."""

THROAT: Paint = (0.36, 0.12, 0.17, 1.0)
TONGUE: Paint = (0.89, 0.46, 0.49, 1.0)
TEETH: Paint = (1.0, 0.99, 0.95, 1.0)

DARK = 0.45
"""Luminance up to which an opening is dark enough to show a tongue and teeth in it."""

SEEN = 0.3
"""Contrast from which a line is seen well."""

WIDE = 0.6
"""Share of the width of the face from which a shape in it goes along like the face, not like a feature."""

LONG_FACE = 1.1
"""Height over width from which the chin goes down as the mouth opens; a ball keeps its shape."""


def make_polygons(found: Found, rig: Rig, palette: Palette, behind: Paint) -> list[Entry]:
    """The ``polygons`` of the file, in the order in which they are painted on a background."""
    maker = _Maker(found, rig, palette, behind)
    entries: list[Entry] = []
    for part in found.parts:
        for entry in filter(None, maker.entries(part)):
            entries += [*maker.cutters, entry]
            maker.cutters.clear()
    return list(_keep_order(entries))


def _keep_order(entries: Sequence[Entry]) -> Iterator[Entry]:
    """Entries with the layers in which they are painted one after the other, as they were drawn."""
    reached = 0
    for entry in entries:
        usual = LAYERS.index(entry.pop("layer", entry["kind"]))
        reached = max(reached, usual)
        if LAYERS[reached] != entry["kind"]:
            entry["layer"] = LAYERS[reached]
        yield entry


class _Maker:
    """Makes polygons and remembers ids, and which of the things that are drawn once are there."""

    def __init__(self, found: Found, rig: Rig, palette: Palette, behind: Paint) -> None:
        self._found, self._rig, self._palette, self._behind = found, rig, palette, behind
        self.cutters: list[Entry] = []
        self._ids: set[str] = set()
        self._shown: dict[str, Box] = {}
        self._done: set[str] = set()
        self._face_seen = False

    def entries(self, part: Part) -> Iterator[Entry]:
        """The polygons that a part becomes, with those that belong under and over it."""
        role, side = part.role, part.side
        if role in ("white", "pupil", "ring", "arc", "lid", "lash"):
            yield from self._eye(part)
        elif role in ("mouth", "mouth_ring", "mouth_line", "lip", "teeth", "tongue"):
            yield from self._mouth(part)
        elif role == "brow":
            yield self._entry(part, "feature", f"brow_{side}", feature=f"B{side}")
        elif role in ("face", "outline"):
            if role == "face" and part.piece.ring and not self._face_seen:
                # A face of lines is filled with what is behind it: so it has an inside, in which features lie.
                ground = self._palette.add(self._behind)
                yield self._add(
                    "face", "face", ground, path=self._data(part.piece.shape.outline), **FACE, **self._chin()
                )
            self._face_seen = True
            yield self._entry(part, "face", role, **FACE, **self._chin())
        elif role == "cheek":
            lift = {"motor": f"M{side}V", "max": {"move": [0, -round(0.025 * self._found.face.height, 2)]}}
            yield self._entry(part, "point", f"cheek_{side}", drivers=[lift], **INNER)
        elif role == "nose":
            yield self._entry(part, "free", "nose", **{"with": "N"}, **NOSE)
        elif role == "ear":
            place = {} if self._face_seen else {"layer": "back"}
            yield self._entry(part, "free", f"ear_{side}", **{"with": f"A{side}"}, **EAR, **place)
        else:
            yield self._entry(part, "free", role or "shape", **self._place_free(part))

    def _chin(self) -> Entry:
        face, motors = self._found.face, self._rig.motors
        if face.height < LONG_FACE * face.width:
            return {}
        ramp = [round(self._rig.mouth.lens.top[1], 2), round(face.bottom, 2)]
        return {"drivers": [{"motor": "MB", "max": {"move": [0, round(0.3 * motors["MB"]["max"], 2)], "ramp": ramp}}]}

    def _place_free(self, part: Part) -> Entry:
        """How a shape that no motor moves goes along with the head."""
        box, face = part.piece.box, self._found.face
        if part.role == "body" or (box.y > face.bottom and not face.holds(box)):
            return {"body": True} if self._face_seen else {"body": True, "layer": "back"}
        if not self._face_seen:
            return {**BEHIND, "layer": "back"}
        if part.role == "hair" or not face.grown(0.01 * face.width).holds(box):
            return dict(FRONT)
        return dict(FACE if box.width > WIDE * face.width else INNER)

    def _eye(self, part: Part) -> Iterator[Entry]:
        side, role = part.side, part.role
        eye, name, feature = self._rig.eyes[side], f"eye_{side}", f"E{side}"
        lens = eye.lens
        if role == "white":
            yield self._entry(part, "hole", name, feature=feature)
            yield self._shut_lid(side)
        elif role == "pupil":
            if name not in self._ids and not eye.arc:
                yield self._add(
                    name, "hole", self._palette.add(part.piece.shape.color, "pupil"), feature=feature,
                    path=self._data(lens_outline(lens)), opacity=0,
                )  # fmt: skip
                yield self._shut_lid(side)
            yield self._entry(part, "pupil", f"pupil_{side}", feature=f"P{side}", clip=name)
        elif role == "ring":
            yield self._entry(part, "feature", f"rim_{side}", feature=feature)
        else:
            lower = part.piece.box.y > lens.box.y if role != "arc" else eye.bowl
            label = {"arc": "eye", "lid": "lid", "lash": "lash"}[role]
            yield self._entry(part, "feature", f"{label}_{side}", feature=feature, line="lower" if lower else "upper")

    def _shut_lid(self, side: str) -> Entry:
        """A line that appears as the eye shuts, where none is drawn on the lids already."""
        if self._found.of("ring", "lash", side=side):
            return {}
        width = 0.1 * self._rig.eyes[side].lens.box.width
        ink = self._find_ink(self._rig.eyes[side].lens.box)
        return self._add(
            f"shut_{side}", "feature", self._palette.add(ink, "lash"), feature=f"E{side}", fade=f"E{side}",
            stroke={"feature": f"E{side}"}, width=_brush(width, 0.6), layer="inner",
        )  # fmt: skip

    def _find_ink(self, eye: Box) -> Paint:
        """The colour of eyes and brows that is seen best on what lies behind an eye, the darkest of several."""
        parts = self._found.of("pupil", "white", "brow", "arc")
        behind = [part for part in self._found.parts if part.role in ("face", "") and not part.piece.stroked]
        ground = next((part.piece.shape.color for part in reversed(behind) if part.piece.box.holds(eye)), self._behind)
        colors = sorted((part.piece.shape.color for part in parts), key=luminance)
        return next((color for color in colors if contrast(color, ground) > SEEN), colors[0])

    def _mouth(self, part: Part) -> Iterator[Entry]:
        if "mouth" not in self._done:
            self._done.add("mouth")
            yield from self._opening()
        role = part.role
        if role == "mouth_ring":
            yield self._entry(part, "feature", "mouth_rim", feature="M")
        elif role == "mouth_line":
            # One line stands for both lips, unless a second one is called the lower.
            paired = any(each.piece.lower for each in self._found.of(role))
            if not part.piece.lower:
                yield self._entry(part, "feature", "mouth_line", feature="M", line="upper")
            if part.piece.lower or not paired:
                yield self._entry(part, "feature", "mouth_line_lower", feature="M", line="lower")
        elif role == "lip":
            lower = part.piece.lower
            alone = len(self._found.of("lip", "mouth")) == 1
            line = {} if alone else {"line": "lower" if lower else "upper"}
            yield self._entry(part, "feature", "lip_lower" if lower else "lip_upper", feature="M", **line)
        elif role == "teeth":
            yield self._entry(part, "feature", "teeth", feature="M", line="upper", layer="inner", **self._clip())
        elif role == "tongue":
            yield self._entry(
                part, "point", "tongue", **{"with": "MB"}, feature="M", layer="inner", drivers=[self._raise_tongue()],
                **self._clip(),
            )  # fmt: skip

    def _clip(self) -> Entry:
        return {"clip": "mouth"} if "mouth" in self._ids else {}

    def _opening(self) -> Iterator[Entry]:
        """What is seen when the mouth opens: the inside, teeth and tongue; and its line when it shuts."""
        mouth, found = self._rig.mouth, self._found
        base = next(iter(found.of("mouth")), None)
        if base is not None and not is_flat(base.piece):
            inside = base.piece.shape.color
            yield self._entry(base, "hole", "mouth", feature="M")
        else:
            inside = base.piece.shape.color if base is not None else self._inside()
            lines = [{"feature": "M"}, {"feature": "M", "line": "lower"}]
            yield self._add("mouth", "hole", self._palette.add(inside, "mouth"), feature="M", span=lines)
        solid = [*found.of("face"), *(part for part in (base,) if part is not None and not is_flat(part.piece))]
        colorful = bool(found.of("lip")) or any(self._is_painted(part.piece) for part in solid)
        if luminance(inside) < DARK and colorful:
            yield from self._teeth_and_tongue()
        outlined = any(part.piece.stroked or part.role == "lip" for part in found.of("mouth_ring", "lip"))
        if mouth.drawn == "open" and not outlined:
            stroke = {"feature": "M"}
            yield self._add(
                "mouth_shut", "feature", self._palette.add(inside, "mouth"), feature="M", stroke=stroke,
                width=_brush(0.05 * mouth.width, 0.1), layer="inner",
            )  # fmt: skip

    def _inside(self) -> Paint:
        """Of the mouth: the dark of a throat, tinged by lips; ink in a drawing of lines only."""
        if lips := self._found.of("lip"):
            return mix(lips[0].piece.shape.color, THROAT, 0.75)
        line = self._found.of("mouth_line", "mouth_ring")[0].piece.shape.color
        painted = any(self._is_painted(part.piece) for part in self._found.of("face"))
        return mix(line, THROAT, 0.5) if painted else line

    def _is_painted(self, piece: Piece) -> bool:
        """Whether a shape is filled, and not only with what is behind it, as in a drawing of lines."""
        return not piece.stroked and contrast(piece.shape.color, self._behind) > 0.02

    def _teeth_and_tongue(self) -> Iterator[Entry]:
        mouth, found = self._rig.mouth, self._found
        lens, drop = mouth.lens, self._rig.motors["MB"]["max"]
        full = drop + lens.opening
        if not found.of("teeth") and mouth.drawn != "open":
            high = round(mouth.lip, 2)
            low = [[-1, high], [0, round(mouth.lip + 0.25 * drop, 2)], [1, high]]
            yield self._add(
                "teeth", "feature", self._palette.add(TEETH, "teeth"), feature="M", layer="inner", clip="mouth",
                span=[{"feature": "M", "offset": high},
                      {"feature": "M", "offset": low, "offset_by": {"motor": "MLH", "share": 0}}],
            )  # fmt: skip
        if not found.of("tongue"):
            rx, ry = 0.27 * mouth.width, 0.42 * full
            top = lens.bottom[1] + mouth.lip + 0.04 * full if mouth.drawn != "open" else lens.bottom[1] - 0.22 * full
            outline = ellipse(lens.bottom[0], top + ry, rx, ry)
            drivers = [{"motor": "MB", "max": {"move": [0, round(0.6 * drop, 2)]}}, self._raise_tongue()]
            if mouth.drawn == "open":
                drivers[0]["min"] = {"move": [0, round(self._rig.motors["MB"]["min"], 2)]}
            yield self._add(
                "tongue", "point", self._palette.add(TONGUE, "tongue"), path=self._data(outline), drivers=drivers,
                layer="inner", clip="mouth", feature="M",
            )  # fmt: skip

    def _raise_tongue(self) -> Entry:
        """What lifts the tip of a tongue to the upper teeth."""
        self._rig.motors["TG"] = {}
        full = self._rig.motors["MB"]["max"] + self._rig.mouth.lens.opening
        return {"motor": "TG", "max": {"touch": {"feature": "M"}, "offset": round(0.12 * full, 2)}}

    def _entry(self, part: Part, kind: str, label: str, **keys: Any) -> Entry:
        """The polygon of a part."""
        piece = part.piece
        if part.role == "mouth" and label != "mouth":
            return {}
        brush: Entry = {"width": round(piece.shape.width, 2)} if piece.stroked else {}
        if piece.ring:
            brush["closed"] = True
        if piece.shape.even_odd and not piece.stroked:
            brush["rule"] = "evenodd"
        if piece.shape.color[3] < 1.0:
            brush["opacity"] = round(piece.shape.color[3], 3)
        fill = self._palette.add(piece.shape.color, part.role)
        if "clip" not in keys and piece.shape.clips:
            places = {key: value for key, value in keys.items() if key in PLACES}
            brush["clip"] = [self._cutter(clip, fill, places) for clip in piece.shape.clips]
        own = _clean(piece.shape.names[0]) if label == "shape" and piece.shape.names else label
        entry = self._add(own, kind, fill, path=self._data(piece.shape.outline), **brush, **keys)
        if not piece.stroked:
            self._shown[entry["id"]] = outline_box(piece.shape.outline, FINE)
        return entry

    def _cutter(self, clip: Outline, fill: str, places: Entry) -> str:
        """The id of what a shape is clipped by: a shape that is there already, else one that is not seen."""
        box = outline_box(clip, FINE)
        for name, shown in self._shown.items():
            if shown.grown(ALIKE).holds(box) and box.grown(ALIKE).holds(shown):
                return name
        cutter = self._add("clip", "free", fill, path=self._data(clip), opacity=0, **places)
        self.cutters.append(cutter)
        self._shown[cutter["id"]] = box
        return str(cutter["id"])

    def _add(self, label: str, kind: str, fill: str, **keys: Any) -> Entry:
        name, number = label, 1
        while name in self._ids:
            number += 1
            name = f"{label}_{number}"
        self._ids.add(name)
        return {"id": name, "kind": kind, "fill": fill, **keys}

    def _data(self, outline: Outline) -> str:
        return path_data(outline, lambda value: format_number(value, 2))


def _brush(width: float, ends: float) -> list[list[float]]:
    """A stroke that is thinner at its ends, by a share of its width."""
    return [[0, round(ends * width, 2)], [0.5, round(width, 2)], [1, round(ends * width, 2)]]


def _clean(name: str) -> str:
    return re.sub(r"[^\w.-]+", "_", name)[:40] or "shape"
