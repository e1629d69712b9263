"""Little mouths from the front, as symbols of an SVG: what an animator draws at each shape."""

from __future__ import annotations

from functools import cache

from .cue_shapes import read_table
from .numbers import format_number

LIPS, EDGE, INSIDE, TEETH, TONGUE = "#cf7f76", "#7d3a36", "#3d1719", "#fffdf8", "#dd9a94"

UPPER_SHARE = 0.42
"""Of an opening, that lies above the line between the corners: the jaw opens downwards."""

_MIDDLE_X, _MIDDLE_Y = 50.0, 26.0
_VIEW = "12 2 76 56"


@cache
def mouth_symbols() -> str:
    """Every mouth of ``data/mouths.csv`` as a ``<symbol>`` of its name."""
    return "\n".join(_draw(row) for row in read_table("mouths"))


@cache
def mouth_sayings() -> dict[str, str]:
    """What each mouth says, in a few words."""
    return {row["mouth"]: row["says"] for row in read_table("mouths")}


def _draw(row: dict[str, str]) -> str:
    size = {key: float(value) for key, value in row.items() if key not in ("mouth", "says")}
    width, opening = size["half_width"], size["opening"]
    above, below = UPPER_SHARE * opening, (1.0 - UPPER_SHARE) * opening
    corner_y = _MIDDLE_Y - size["corners"]
    outer = _lens(width + 4.0, corner_y, above + size["upper"], below + size["lower"], bow=2.5)
    inner = _lens(width, corner_y, above, below)
    name, top, bottom = row["mouth"], _MIDDLE_Y - above, _MIDDLE_Y + below
    inside = "".join(
        [
            f'<path d="{inner}" fill="{INSIDE}"/>',
            _ellipse(bottom + 2.0, 0.62 * width, size["tongue"] + 2.0, TONGUE) if size["tongue"] else "",
            _band(top - 8.0, size["top"] + 8.0, width) if size["top"] else "",
            _band(bottom - size["bottom"], size["bottom"] + 8.0, width) if size["bottom"] else "",
        ]
    )
    line = f'<path d="{inner}" fill="none" stroke="{EDGE}" stroke-width="1.6" stroke-linejoin="round"/>'
    return (
        f'<symbol id="mouth-{name}" viewBox="{_VIEW}"><clipPath id="clip-{name}"><path d="{inner}"/></clipPath>'
        f'<path d="{outer}" fill="{LIPS}" stroke="{EDGE}" stroke-width="1.2" stroke-linejoin="round"/>'
        f'<g clip-path="url(#clip-{name})">{inside}</g>{line}</symbol>'
    )


def _lens(half_width: float, corner_y: float, above: float, below: float, bow: float = 0.0) -> str:
    """A closed curve through both corners that reaches so far above and below the middle; ``bow`` dents it above."""
    crest, trough = _MIDDLE_Y - above, _MIDDLE_Y + below
    flat = 0.32 * half_width
    # Tall mouths are round: their sides stand upright at the corners, where those of a wide one run flat.
    lean = half_width * max(0.0, 0.4 - 0.9 * max(above, below) / half_width)

    def half(side: float) -> list[tuple[float, float]]:
        """From a corner over the crest to the middle: the points of two Bezier curves, of three and of two."""
        corner = _MIDDLE_X + side * half_width
        return [
            (corner - side * lean, corner_y + 0.65 * (crest - corner_y)),
            (_MIDDLE_X + side * 2.0 * flat, crest),
            (_MIDDLE_X + side * flat, crest),
            (_MIDDLE_X + side * 0.4 * flat, crest),
            (_MIDDLE_X, crest + bow),
        ]

    left, right = half(-1.0), half(1.0)
    low = [(x, corner_y + 0.65 * (trough - corner_y)) for x, _ in (right[0], left[0])]
    return (
        f"M {_points((_MIDDLE_X - half_width, corner_y))} C {_points(*left[:3])} Q {_points(*left[3:])} "
        f"Q {_points(right[3], right[2])} C {_points(right[1], right[0], (_MIDDLE_X + half_width, corner_y))} "
        f"C {_points(low[0], (_MIDDLE_X + 2.0 * flat, trough), (_MIDDLE_X, trough))} "
        f"C {_points((_MIDDLE_X - 2.0 * flat, trough), low[1], (_MIDDLE_X - half_width, corner_y))} Z"
    )


def _points(*points: tuple[float, float]) -> str:
    return " ".join(f"{_n(x)} {_n(y)}" for x, y in points)


def _ellipse(centre_y: float, half_width: float, half_height: float, color: str) -> str:
    centre, radii = f'cx="{_n(_MIDDLE_X)}" cy="{_n(centre_y)}"', f'rx="{_n(half_width)}" ry="{_n(half_height)}"'
    return f'<ellipse {centre} {radii} fill="{color}"/>'


def _band(y: float, height: float, half_width: float) -> str:
    """A row of teeth: a rounded bar from side to side."""
    return (
        f'<rect x="{_n(_MIDDLE_X - 0.86 * half_width)}" y="{_n(y)}" width="{_n(1.72 * half_width)}" '
        f'height="{_n(height)}" rx="4" fill="{TEETH}"/>'
    )


def _n(value: float) -> str:
    return format_number(value, 1)
