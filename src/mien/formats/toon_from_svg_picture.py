"""What was guessed of a drawing, as a picture: features, control points, how far motors go, and four poses."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mien.core import Pose, Scene
from mien.faces.toon.motors import motors
from mien.faces.toon.presets import share_at
from mien.faces.toon.toon import ToonFace

from .picture import Picture
from .toon_from_svg import GuessedToon
from .toon_from_svg_rig import parts_box

if TYPE_CHECKING:
    from PIL import ImageDraw

Color = tuple[int, int, int]
Pixel = tuple[float, float]

HEIGHT_PX = 960
POSE_SHARE = 0.5
"""Height of each of the four poses as a share of the whole."""

MARGIN_PX, LABEL_PX, FONT_PX = 18, 26, 15
PALE = 0.55
"""How much of the drawing goes into the paper beneath what is written on it."""

PAPER: Color = (250, 249, 247)
INK: Color = (40, 38, 36)

COLORS: Mapping[str, Color] = {
    "B": (196, 84, 20),
    "E": (22, 110, 190),
    "P": (110, 50, 170),
    "M": (200, 30, 80),
    "N": (20, 130, 90),
    "A": (120, 110, 20),
}
"""Of features, by the first letter of their names."""

LABELS: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "BR": ("brow R", ("brow",)),
    "BL": ("brow L", ("brow",)),
    "ER": ("eye R", ("white", "ring", "arc", "pupil")),
    "EL": ("eye L", ("white", "ring", "arc", "pupil")),
    "M": ("mouth", ("mouth", "mouth_ring", "mouth_line", "lip")),
    "N": ("nose", ("nose",)),
    "AR": ("ear R", ("ear",)),
    "AL": ("ear L", ("ear",)),
}
"""What is written at features, and of which parts they are made."""

POSES: Mapping[str, Mapping[str, float]] = {
    "smile": {"MRV": 0.8, "MLV": 0.8, "MRH": 0.55, "MLH": 0.55, "ERL": 0.27, "ELL": 0.27, "BRC": 0.3, "BLC": 0.3},
    "open mouth": {"MB": 0.9, "MT": 0.4},
    "eyes shut": {"ERU": -1.0, "ELU": -1.0},
    "head turned, looking aside": {"HH": 0.8, "HV": 0.3, "PRH": 0.7, "PLH": 0.7},
}
"""Activations of motors."""


def guess_sheet(guessed: GuessedToon, face: ToonFace) -> Picture:
    """The drawing with what was found in it, and beside it four poses.

    Args:
        guessed: from a drawing.
        face: the face that its document describes.
    """
    from PIL import Image, ImageDraw

    width, height = face.character.size
    scale = (HEIGHT_PX - 2 * MARGIN_PX - LABEL_PX) / height
    large = (round(width * scale), round(height * scale))
    small = (round(large[0] * POSE_SHARE) - MARGIN_PX, round(large[1] * POSE_SHARE) - LABEL_PX)
    sheet = Image.new("RGB", (large[0] + 2 * small[0] + 4 * MARGIN_PX, HEIGHT_PX), PAPER)
    base = _draw(face, face.neutral, large).astype(np.float64)
    pale = np.array(PAPER) + PALE * (base - np.array(PAPER))
    sheet.paste(Image.fromarray(np.rint(pale).astype(np.uint8)), (MARGIN_PX, MARGIN_PX))
    pen = ImageDraw.Draw(sheet)
    _mark(pen, guessed, face, scale)
    _write(pen, (MARGIN_PX, HEIGHT_PX - LABEL_PX - 4), f"{face.character.name}: control points and how far they go")
    for number, (label, activations) in enumerate(POSES.items()):
        row, column = divmod(number, 2)
        left = large[0] + 2 * MARGIN_PX + column * (small[0] + MARGIN_PX)
        top = MARGIN_PX + row * (small[1] + LABEL_PX + MARGIN_PX)
        sheet.paste(Image.fromarray(_draw(face, _pose(face, activations), small)), (left, top))
        _write(pen, (left, top + small[1] + 4), label)
    opaque = np.full((*np.asarray(sheet).shape[:2], 4), 255, dtype=np.uint8)
    opaque[..., :3] = np.asarray(sheet)
    return Picture(opaque)


def _draw(face: ToonFace, pose: Pose, size: tuple[int, int]) -> NDArray[np.uint8]:
    """(H, W, 3) picture of a pose."""
    from mien.render import draw

    return draw(face, pose, Scene(size_px=size))[..., :3]


def _pose(face: ToonFace, activations: Mapping[str, float]) -> Pose:
    values = {
        motors()[code].parameter: share_at(code, face.character, amount)
        for code, amount in activations.items()
        if code in face.character.motors
    }
    return face.neutral.replace(values)


def _mark(pen: ImageDraw.ImageDraw, guessed: GuessedToon, face: ToonFace, scale: float) -> None:
    """Boxes with names around features, then ranges, then control points with their names."""

    def place(x: float, y: float) -> Pixel:
        return (MARGIN_PX + x * scale, MARGIN_PX + y * scale)

    for feature, (label, roles) in LABELS.items():
        side = feature[1:] if feature != "M" else ""
        if parts := guessed.found.of(*roles, side=side):
            box = parts_box(parts).grown(4.0 / scale)
            corner = place(box.left, box.top)
            pen.rectangle((*corner, *place(box.right, box.bottom)), outline=COLORS[feature[0]], width=1)
            _write(pen, (corner[0], corner[1] - FONT_PX - 3), label, COLORS[feature[0]])
    for dot in _dots(face):
        color = COLORS[dot.feature[0]]
        for low, high in dot.ranges:
            pen.line((*place(*low), *place(*high)), fill=color, width=2)
            for end in (low, high):
                x, y = place(*end)
                pen.ellipse((x - 2, y - 2, x + 2, y + 2), fill=color)
        x, y = place(*dot.at)
        pen.ellipse((x - 5, y - 5, x + 5, y + 5), fill=color, outline=PAPER, width=2)
        _write(pen, (x + 7, y - 7), dot.name, color)


@dataclass(frozen=True)
class _Dot:
    """A control point, with the ends of what its motors do."""

    name: str
    feature: str
    at: Pixel
    ranges: tuple[tuple[Pixel, Pixel], ...]


def _dots(face: ToonFace) -> Iterator[_Dot]:
    for feature in face.character.features.values():
        for name, (x, y) in feature.points.items():
            ranges = []
            for code, limits in face.character.motors.items():
                motor = motors()[code]
                if motor.feature == feature.name and motor.point == name:
                    dx, dy = motor.direction
                    low, high = limits.low, limits.high
                    ranges.append(((x + dx * low, y + dy * low), (x + dx * high, y + dy * high)))
            # Where lips are shut, two points lie in one place.
            alike = [other for other, place in feature.points.items() if place == (x, y)]
            if name == alike[-1]:
                yield _Dot(" ".join(alike), feature.name, (x, y), tuple(ranges))
            elif ranges:
                yield _Dot("", feature.name, (x, y), tuple(ranges))


def _write(pen: ImageDraw.ImageDraw, at: Pixel, text: str, color: Color = INK) -> None:
    from PIL import ImageFont

    pen.text(at, text, fill=color, font=ImageFont.load_default(FONT_PX), stroke_width=2, stroke_fill=PAPER)
