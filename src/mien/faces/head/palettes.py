"""Palettes: sRGB hex for people, linear light inside."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from mien.core import Preset, exact

from .shipped import shipped_rows

Rgb = tuple[float, float, float]

DEFAULT = "beige"


def linear(hex_color: str) -> Rgb:
    """Linear RGB of ``#rrggbb``, to five places."""
    red, green, blue = (round(exact.srgb_to_linear(int(hex_color[i : i + 2], 16) / 255.0), 5) for i in (1, 3, 5))
    return red, green, blue


@cache
def palettes() -> Mapping[str, Mapping[str, Rgb]]:
    """Palette name -> color name (``skin`` ...) -> linear RGB."""
    return {
        row["palette"]: {name: linear(value) for name, value in row.items() if name != "palette"}
        for row in shipped_rows("palettes")
    }


def palette_presets() -> dict[str, Preset]:
    """Each palette as a preset of the colour rows; one without any colour is of the kind ``grey level``."""
    out = {}
    for name, colors in palettes().items():
        values = {
            f"{part}.color.{channel}": value
            for part, rgb in colors.items()
            for channel, value in zip(("red", "green", "blue"), rgb, strict=True)
        }
        grey = all(red == green == blue for red, green, blue in colors.values())
        kind = "grey level" if grey else "palette"
        out[name] = Preset(name, kind, values, f"Skin, lips, brows, hair, eyes and garment in {name}.")
    return out
