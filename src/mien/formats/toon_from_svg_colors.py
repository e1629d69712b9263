"""The palette of a drawing: few colours with names that an artist would give them."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from functools import cache
from importlib import resources

from .svg_reader_paints import Paint

SAME = 6
"""Codes, of 255, by which colours of one name differ at most in each channel."""

ROLE_NAMES: Mapping[str, str] = {
    "face": "skin",
    "outline": "line",
    "background": "bg",
    "brow": "brow",
    "white": "eye",
    "pupil": "pupil",
    "mouth": "mouth",
    "mouth_line": "lip",
    "mouth_ring": "lip",
    "lip": "lip",
    "teeth": "teeth",
    "tongue": "tongue",
    "cheek": "cheek",
    "hair": "hair",
    "lash": "lash",
    "lid": "lid",
}
"""Names of colours by what is painted in them first."""

Code = tuple[int, int, int]


class Palette:
    """Gives colours names; colours that can hardly be told apart share one."""

    def __init__(self) -> None:
        self._colors: dict[str, Code] = {}

    def add(self, color: Paint, role: str = "") -> str:
        """The name of a colour, a new one if it is new."""
        code = _code(color)
        for name, known in self._colors.items():
            if max(abs(one - two) for one, two in zip(code, known, strict=True)) <= SAME:
                return name
        wanted = ROLE_NAMES.get(role) or _nearest(code)
        names = [wanted, *(f"{wanted}{number}" for number in range(2, len(self._colors) + 3))]
        name = next(name for name in names if name not in self._colors)
        self._colors[name] = code
        return name

    def codes(self) -> dict[str, str]:
        """The palette as it stands in the file."""
        return {name: "#{:02X}{:02X}{:02X}".format(*code) for name, code in self._colors.items()}


def mix(one: Paint, other: Paint, share: float) -> Paint:
    """A colour between two, opaque."""
    red, green, blue = (a + share * (b - a) for a, b in zip(one[:3], other[:3], strict=True))
    return (red, green, blue, 1.0)


def _code(color: Paint) -> Code:
    red, green, blue = (round(255 * channel) for channel in color[:3])
    return (red, green, blue)


def _nearest(code: Code) -> str:
    return min(_names(), key=lambda name: sum((a - b) ** 2 for a, b in zip(code, _names()[name], strict=True)))


@cache
def _names() -> Mapping[str, Code]:
    text = resources.files(__package__).joinpath("data", "color_names.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(text.splitlines())
    return {
        row["name"]: (int(row["code"][1:3], 16), int(row["code"][3:5], 16), int(row["code"][5:7], 16)) for row in rows
    }
