"""Colours of every vertex from the colour rows: soft regions, baked ambient shade, depth of the mouth."""

# Numba finds the types of arguments by itself, so that the kernels below name none.
# mypy: disable-error-code="no-untyped-def,no-untyped-call"

from __future__ import annotations

import numpy as np

from mien.compiling import kernel
from mien.core import Pose
from mien.core.mesh import Ints, Points

from .angles import share, soft_step
from .lashes import Lashes
from .measured import Archive, Floats

AMBIENT_QUARTERS = (5, 7, 7)
"""Baked ambient visibility to the power of so many quarters darkens green and blue more than red: light that reaches
a fold has met skin before."""


def color_of(pose: Pose, name: str) -> Floats:
    """(3,) linear RGB of the rows ``name.color.*``."""
    first = pose.table.index[f"{name}.color.red"]
    return pose.values[first : first + 3]


def regions(pose: Pose) -> Floats:
    """(8, 3) colours of the regions skin, warm, lip, shade, light, mouth, nostril, lid rim."""
    skin, blush, lip, shade = (color_of(pose, name) for name in ("skin", "blush", "lip", "shade"))
    light = np.minimum(skin * 1.12 + 0.01, 1.0)
    nostril = skin * 0.07 + np.array([0.012, 0.001, 0.001])
    rim = 0.55 * blush + 0.45 * np.array([0.60, 0.21, 0.20])
    return np.stack([skin, blush, lip, shade, light, color_of(pose, "cavity"), nostril, rim])


CHEEK_GLOW = np.array([0.95, 0.75, 0.72])
"""Least light on the inside of the mouth before its depth darkens it."""


def skin_shade(archive: Archive) -> Floats:
    """(V, 3) factor on the skin's colours: ambient visibility to a power a channel, dark towards the throat."""
    ambient = archive.floats("ambient")
    # By roots and products: a library's power function differs between machines.
    root = np.sqrt(np.sqrt(ambient))
    shade = np.stack([np.multiply.reduce([root] * quarters) for quarters in AMBIENT_QUARTERS], axis=1)
    inside = archive.floats("region_weights")[:, 5]
    depth = np.clip((0.092 - archive.floats("cage")[:, 2]) / 0.045, 0.0, 0.85)
    # Cheeks seen from within glow red; the baked shade, which knows a shut mouth only, would make them black.
    lit = shade + inside[:, None] * np.maximum(CHEEK_GLOW - shade, 0.0)
    return lit * (1.0 - inside * depth)[:, None]


def blend(weights: Floats, colors: Floats) -> Floats:
    """(V, 3) mixtures of (R, 3) colours by weights (V, R), summed in order."""
    out = np.zeros((len(weights), 3))
    for column, rgb in enumerate(colors):
        out += weights[:, column, None] * rgb
    return out


def tinted(colors: Floats, rgb: Floats, share: Floats) -> Floats:
    """(N, 3) colours (N, 3) with a share (N,) of one (3,)."""
    return colors + share[:, None] * (rgb - colors)


def depth_shade(points: Points, from_z_m: float, over_m: float, tint: tuple[float, float, float]) -> Floats:
    """(N, 3) factor that darkens what lies deep in the mouth, towards a tint."""
    deep = np.clip((from_z_m - points[:, 2]) / over_m, 0.0, 1.0)[:, None]
    return 1.0 - deep * (1.0 - np.array(tint))


def tooth_light(archive: Archive) -> Floats:
    """(N, 1) factor: crowns are bright towards the lips and dark towards the tongue."""
    return archive.floats("teeth_shade")[:, None]


def brow_color(pose: Pose, along: Floats, across: Floats) -> Floats:
    """(B, 3) of a brow strip: it fades into the skin at both ends, with streaks of hair."""
    hair, skin = color_of(pose, "eyebrow"), color_of(pose, "skin")
    start, end = np.clip(1.0 - along / 0.12, 0.0, 1.0), np.clip((along - 0.78) / 0.22, 0.0, 1.0)
    fade = (0.42 * start + 0.30 * end)[:, None]
    edge = 0.16 * np.clip((np.abs(across) - 0.3) / 0.2, 0.0, 1.0)[:, None]
    streak = 1.0 + 0.10 * (np.mod(np.rint(along * 14.0) + np.rint(across * 3.0), 2.0)[:, None] - 0.5)
    return hair * streak * (1.0 - fade - edge) + skin * (fade + edge)


def caruncle_color(pose: Pose) -> Floats:
    """(3,) of the pink corner of the eye."""
    return 0.5 * color_of(pose, "blush") + 0.5 * np.array([0.57, 0.147, 0.133])


def lash_color(pose: Pose, lashes: Lashes) -> Floats:
    """(N, 3) of one eye's lashes: much darker than the brows; the lower ones are fine, so the skin shows through."""
    hair = color_of(pose, "eyebrow") * 0.12
    out = np.tile(hair, (len(lashes.index[0]), 1))
    out[lashes.quads[lashes.lower].ravel()] = hair + 0.62 * color_of(pose, "shade")
    return out


def collar_color(pose: Pose, count: int, band: Ints) -> Floats:
    """(N, 3) of ``count`` vertices of the garment; the polygons (F, 4) of the neckband are darker."""
    out = np.tile(color_of(pose, "garment"), (count, 1))
    dark = np.zeros(count, dtype=bool)
    dark[band.ravel()] = True
    out[dark] *= 0.82
    return out


@kernel()
def darken_eye(colors, points, centre):
    """Darken colours (N, 3) of a ball whose points (N, 3) m are: the upper lid's shadow, and a little at its sides."""
    for n in range(len(points)):
        up = share((points[n, 1] - centre[1] - 0.0008) / 0.0036)
        side = share((abs(points[n, 0] - centre[0]) - 0.006) / 0.005)
        light = (1.0 - 0.55 * up) * (1.0 - 0.22 * side)
        for channel in range(3):
            colors[n, channel] *= light


LIP_SHADOW = 0.42
LIP_SHADOW_M = 0.0065
"""How dark the upper lip's shadow is, and how far it falls: a lip 8 mm before the teeth, light from 35 degrees up."""


@kernel()
def darken_mouth(colors, points, lip_height):
    """Darken colours (N, 3) of what lies in the mouth by the upper lip's shadow; ``lip_height`` is its edge, m."""
    for n in range(len(points)):
        below = soft_step((lip_height - points[n, 1] - 0.0015) / LIP_SHADOW_M)
        light = 1.0 - LIP_SHADOW * (1.0 - below)
        for channel in range(3):
            colors[n, channel] *= light


def palette_key(pose: Pose) -> bytes:
    """What all constant colours depend on."""
    first = pose.table.index["skin.color.red"]
    return pose.values[first:].tobytes()


def hair_color(hair: Floats, skin: Floats, shade: Floats) -> Floats:
    """(N, 3) of hair (3,): brightness of each strand, fading at the hairline to skin, (3,) or (N, 3)."""
    bright = np.clip(shade[:, :1], 0.0, 2.0)
    fade = shade[:, 1:] * shade[:, 1:]
    return np.minimum((hair * 1.15 + 0.004) * bright * bright * (1.0 - fade) + skin * fade, 1.0)
