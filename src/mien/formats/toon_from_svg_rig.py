"""Control points and motor limits for the features that were found in a drawing.

The shares are our choice, after the characters that mien brings along: how far brows, lids and lips of drawn faces go.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from .svg_reader_outlines import Point
from .toon_from_svg_guess import SIDES, Found, Part
from .toon_from_svg_judging import THIN, is_flat
from .toon_from_svg_lenses import Lens, fit_lens, lens_around
from .toon_from_svg_pieces import Box, join

ATTACHED = {"depth": 0.12, "bulge": 0.5, "shorten": 1}
"""How features go along when the head turns."""

SHUT_PROFILE = (2.0, 1.35)
"""The line of a shut eye: a gentle arc."""

OPEN_PROFILE = (2.2, 1.6)
"""The lines of an open mouth that is drawn shut."""

HEAD_DEG = {"HH": 24, "HV": 14, "HT": 10}
PUPIL_DEG = {"H": 30, "V": 20}


@dataclass(frozen=True)
class Eye:
    """One eye.

    Attributes:
        lens: its lids.
        bare: it is drawn without a white: dark pupils that lids cover.
        arc: it is drawn as a line.
        bowl: a line that is open above, as of an eye that is shut: the lower lid.
    """

    lens: Lens
    bare: bool = False
    arc: bool = False
    bowl: bool = False


@dataclass(frozen=True)
class Mouth:
    """The mouth.

    Attributes:
        lens: its lips.
        drawn: ``line`` for a line, ``lips`` for two lips without anything between them, ``open`` for an opening.
        lip: how far its line reaches below the middle of it.
        room: how far the lower lip can go down before it meets the chin.
    """

    lens: Lens
    drawn: str
    lip: float
    room: float

    @property
    def width(self) -> float:
        """From corner to corner."""
        return self.lens.box.width


@dataclass(frozen=True)
class Rig:
    """Control points and limits, in the form of the file.

    Attributes:
        eyes: by side.
        mouth: the mouth.
        features: the ``features`` of the file.
        motors: the ``motors`` of the file.
    """

    eyes: Mapping[str, Eye]
    mouth: Mouth
    features: dict[str, Any] = field(default_factory=dict)
    motors: dict[str, Any] = field(default_factory=dict)


def make_rig(found: Found) -> Rig:
    """Control points and limits of a face."""
    rig = Rig({side: _fit_eye(found, side) for side in SIDES}, _fit_mouth(found))
    for side in SIDES:
        _add_brow(rig, found, side)
        _add_eye(rig, found, side)
    _add_mouth(rig, found)
    _add_others(rig, found)
    rig.motors.update({code: {"min_deg": -limit, "max_deg": limit} for code, limit in HEAD_DEG.items()})
    return rig


def parts_box(parts: Iterable[Part]) -> Box:
    """Around parts, the width of strokes included."""
    return join(part.piece.box.grown(part.piece.shape.width / 2.0) for part in parts)


def _fit_eye(found: Found, side: str) -> Eye:
    if framed := found.of("white", side=side) or found.of("ring", side=side):
        return Eye(fit_lens(framed[0].piece.contours, closed=True))
    if pupils := found.of("pupil", side=side):
        box = parts_box(pupils).grown(0.5)
        wide, high = 0.16 * box.width, 0.06 * box.height
        room = Box(box.left - wide, box.top - high, box.right + wide, box.bottom + high)
        points = [point for part in pupils for point in part.piece.points]
        return Eye(lens_around(room, points, sink=0.66), bare=True)
    arc = (found.of("arc", side=side) or found.of("lash", "lid", side=side))[0].piece
    line = fit_lens(arc.contours, closed=not arc.stroked)
    ends = 0.5 * (line.left[1] + line.right[1])
    apex, half = 0.5 * (line.top[1] + line.bottom[1]), 0.15 * line.box.width
    # An arch turns over when it shuts; a bowl is an eye that is shut already.
    top, bottom = (apex, ends + max(0.5 * (ends - apex), 0.1)) if apex < ends else (ends - half, max(apex, ends + 0.1))
    lens = Lens(line.left, line.right, (line.top[0], top), (line.top[0], bottom), line.profile)
    return Eye(lens, arc=True, bowl=apex >= ends)


def _fit_mouth(found: Found) -> Mouth:
    lips = found.of("lip")
    base = [part for part in found.of("mouth") if not is_flat(part.piece)]
    if base:
        lens = fit_lens(base[0].piece.contours, closed=True)
        drawn, lip = "open", 0.0
    elif lips:
        box = join(part.piece.box for part in lips)
        uppers = [part for part in lips if not part.piece.lower] or lips
        outer = fit_lens([points for part in lips for points in part.piece.contours], closed=True)
        seam = max((fit_lens(part.piece.contours, closed=True) for part in uppers), key=lambda lens: lens.bottom[1])
        height = seam.bottom[1] if len(lips) > 1 else 0.5 * (outer.top[1] + outer.bottom[1])
        middle = (box.x, height)
        lens, drawn, lip = Lens(outer.left, outer.right, middle, middle, (2.0, 1.0)), "lips", 0.0
    else:
        lines = found.of("mouth_line", "mouth_ring") or found.of("mouth")
        main = max(lines, key=lambda part: part.piece.box.width).piece
        lens = fit_lens(main.contours, closed=main.ring or not main.stroked)
        lip = 0.5 * (main.shape.width or lens.opening)
        drawn = "open" if main.ring and lens.opening > THIN * lens.box.width else "line"
        if drawn == "line":
            middle = (lens.top[0], 0.5 * (lens.top[1] + lens.bottom[1]))
            lens = Lens(lens.left, lens.right, middle, middle, lens.profile)
    low = parts_box(found.of("mouth", "mouth_ring", "mouth_line", "lip")).bottom
    return Mouth(lens, drawn, lip, max(0.7 * (found.face.bottom - low), 0.02 * found.face.height))


def _add_brow(rig: Rig, found: Found, side: str) -> None:
    """Three points along the middle of a brow; above the eye where there is none."""
    face, eye = found.face, rig.eyes[side].lens.box
    parts = found.of("brow", side=side)
    if parts:
        main = max((part.piece for part in parts), key=lambda piece: piece.box.area)
        line = fit_lens(main.contours, closed=not main.stroked)
        box = parts_box(parts)
        middle = (line.top[0], 0.5 * (line.top[1] + line.bottom[1]))
        left, right = line.left, line.right
    else:
        box = Box(eye.left, eye.top - 0.6 * eye.height, eye.right, eye.top - 0.4 * eye.height)
        left, middle, right = (box.left, box.bottom), (box.x, box.top), (box.right, box.bottom)
    outer, inner = (left, right) if side == "R" else (right, left)
    points = {f"B{side}L": outer, f"B{side}C": middle, f"B{side}M": inner}
    rig.features[f"B{side}"] = {"points": _rounded(points), "smooth": True, **ATTACHED}
    gap = max(eye.top - box.bottom, 0.0)
    down = min(0.06 * face.height, 0.75 * gap + 0.015 * face.height)
    up = min(0.07 * face.height, max(0.5 * (box.top - face.top), 0.02 * face.height))
    for code in points:
        rig.motors[code] = _limits(down, up)


def _add_eye(rig: Rig, found: Found, side: str) -> None:
    eye = rig.eyes[side]
    lens, name = eye.lens, f"E{side}"
    outer, inner = (lens.left, lens.right) if side == "R" else (lens.right, lens.left)
    points = {f"{name}O": outer, f"{name}U": lens.top, f"{name}I": inner, f"{name}L": lens.bottom}
    rig.features[name] = {"points": _rounded(points), "profile": list(lens.profile), **ATTACHED}
    if not eye.arc:
        rig.features[name]["profile_shut"] = list(SHUT_PROFILE)
    height = lens.opening
    above = rig.features[f"B{side}"]["points"][f"B{side}C"][1]
    rig.motors[f"{name}U"] = _limits(height, min(0.14 * height, max(0.4 * (lens.top[1] - above), 0.0)))
    rig.motors[f"{name}L"] = _limits(0.06 * height, 0.8 * height)
    pupils = found.of("pupil", side=side)
    box = parts_box(pupils) if pupils else lens.box
    if eye.bare or not pupils:
        across, along = 0.2 * box.width, 0.16 * box.height
    else:
        across = max(0.5 * (lens.box.width - box.width) + 0.1 * box.width, 0.12 * lens.box.width)
        along = max(0.5 * (height - box.height) + 0.12 * box.height, 0.12 * height)
    rig.features[f"P{side}"] = {"points": _rounded({f"P{side}": (box.x, box.y)}), **ATTACHED}
    for dimension, reach in (("H", across), ("V", along)):
        degrees = PUPIL_DEG[dimension]
        rig.motors[f"P{side}{dimension}"] = {**_limits(reach, reach), "min_deg": -degrees, "max_deg": degrees}


def _add_mouth(rig: Rig, found: Found) -> None:
    face, mouth = found.face, rig.mouth
    lens = mouth.lens
    points = {"MR": lens.left, "MT": lens.top, "ML": lens.right, "MB": lens.bottom}
    rig.features["M"] = {"points": _rounded(points), "profile": list(lens.profile), **ATTACHED}
    if mouth.drawn != "open":
        rig.features["M"]["profile_open"] = list(OPEN_PROFILE)
    width, most = mouth.width, 0.13 * face.height
    smile = lens.top[1] - 0.5 * (lens.left[1] + lens.right[1])
    for side, end in (("R", lens.left), ("L", lens.right)):
        room = abs((face.left if side == "R" else face.right) - end[0])
        rig.motors[f"M{side}H"] = _limits(0.26 * width, min(0.15 * width, 0.4 * room))
        down, up = max(0.14 * width, 1.7 * smile), max(0.12 * width, -1.5 * smile)
        rig.motors[f"M{side}V"] = _limits(min(down, most), min(up, most))
    widen = 0.05 if mouth.drawn == "open" else 0.16
    rig.motors["MB"] = _limits(lens.opening, min(widen * face.height + 0.1 * lens.opening, mouth.room))
    rig.motors["MT"] = _limits(0.0, 0.02 * face.height)


def _add_others(rig: Rig, found: Found) -> None:
    """Nose and ears go up and down as a whole."""
    height = found.face.height
    if nose := found.of("nose"):
        box = parts_box(nose)
        rig.features["N"] = {"points": _rounded({"N": (box.x, box.y)}), "depth": 0.3, "bulge": 0.4, "shorten": 1}
        rig.motors["NV"] = _limits(0.008 * height, 0.018 * height)
    for side in SIDES:
        if ear := found.of("ear", side=side):
            box = parts_box(ear)
            depth = {"depth": -0.1, "bulge": 0, "shorten": 0.2}
            rig.features[f"A{side}"] = {"points": _rounded({f"A{side}": (box.x, box.y)}), **depth}
            rig.motors[f"EA{side}"] = _limits(0.02 * height, 0.03 * height)


def _limits(low: float, high: float) -> dict[str, float]:
    return {"min": -round(low, 2) or 0.0, "max": round(high, 2)}


def _rounded(points: Mapping[str, Point]) -> dict[str, list[float]]:
    return {name: [round(x, 2), round(y, 2)] for name, (x, y) in points.items()}
