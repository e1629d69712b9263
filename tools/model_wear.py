"""Model beards, which are bound to the skin, and glasses, which sit on nose and ears.

python tools/model_wear.py
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

from mien.faces.head.arrays import format_arrays
from mien.faces.head.hair import STEP_M, STEP_SHADE
from mien.faces.head.measured import Archive, archive

OUT = Path(__file__).parents[1] / "src/mien/faces/head/data/wear.arrays"
SUNK_M, RIM_M = -0.0010, -0.0060
"""How deep a beard begins below the skin, and its rim, which subdivision smooths as an edge and so draws out."""


def smooth(x: np.ndarray) -> np.ndarray:
    """0..1 by a smooth step."""
    x = np.clip(x, 0.0, 1.0)
    return x * x * (3.0 - 2.0 * x)


# ---------------------------------------------------------------- beards


def moustache(p: np.ndarray) -> np.ndarray:
    """(V,) 0..1 between nose and upper lip."""
    x, y, z = np.abs(p[:, 0]), p[:, 1], p[:, 2]
    lower = -0.0545 - 0.45 * np.clip(x - 0.010, 0.0, None)
    upper = -0.0445 - 0.40 * np.clip(x - 0.016, 0.0, None)
    inside = smooth((upper - y) / 0.004) * smooth((y - lower + 0.006) / 0.004)
    return inside * smooth((0.036 - x) / 0.006) * (z > 0.07)


def chin(p: np.ndarray) -> np.ndarray:
    """(V,) 0..1 around the chin."""
    x, y, z = np.abs(p[:, 0]), p[:, 1], p[:, 2]
    return smooth((-0.076 - y) / 0.007) * smooth((y + 0.125) / 0.012) * smooth((0.030 - x) / 0.010) * (z > 0.055)


def jaw(p: np.ndarray) -> np.ndarray:
    """(V,) 0..1 along the jaw, from the ears to the chin."""
    x, y, z = np.abs(p[:, 0]), p[:, 1], p[:, 2]
    # The upper edge runs from before the ear over the cheek to below the corner of the mouth.
    edge = 0.014 - 0.069 * smooth((z - 0.014) / 0.055)
    side = smooth((edge - y) / 0.030) * smooth((x - 0.012) / 0.010)
    return side * smooth((z - 0.002) / 0.008) * smooth((y + 0.122 - 0.3 * np.clip(0.05 - z, 0, None)) / 0.012)


def sides_of_mouth(p: np.ndarray) -> np.ndarray:
    """(V,) 0..1 from the moustache's ends down to the chin."""
    x, y, z = np.abs(p[:, 0]), p[:, 1], p[:, 2]
    return smooth((x - 0.0285) / 0.004) * smooth((0.044 - x) / 0.008) * smooth((-0.054 - y) / 0.006) * (z > 0.06)


BEARDS = {  # thickness in m, darkness of the skin beneath, least share of the skin's colour, regions
    "stubble": (0.0, 0.34, 0.0, (moustache, chin, jaw, sides_of_mouth)),
    "moustache": (0.0062, 0.5, 0.04, (moustache,)),
    "goatee": (0.0065, 0.5, 0.16, (moustache, chin, sides_of_mouth)),
    "full": (0.0090, 0.8, 0.06, (moustache, chin, jaw, sides_of_mouth)),
}


def beard(head: Archive, thick_m: float, dark: float, thin: float, regions: tuple) -> dict[str, np.ndarray]:
    """Arrays of one beard: vertices of the skin it stands on, how far off, polygons, shade, and tint of the skin."""
    points, mirror = head.floats("surface"), head.mirror
    grown = np.max([region(points) for region in regions], axis=0)
    weights = head.floats("region_weights")
    names = [str(name) for name in head.arrays["region_names"]]
    bare = weights[:, [names.index(name) for name in ("lip", "mouth", "nostril")]].sum(axis=1) > 0.3
    skin = head.group_names.index("skin")
    grown[bare | ~np.isin(np.arange(len(points)), head.quads[head.groups == skin])] = 0.0
    grown = 0.5 * (grown + grown[mirror])
    grown[grown < 0.02] = 0.0
    out = {"tint": np.rint(dark * smooth(grown / 0.6) / STEP_SHADE).astype(np.uint8)}
    quads = head.quads[(head.groups == skin) & (grown[head.quads].max(axis=1) > 0.0)]
    if thick_m == 0.0:
        quads = quads[:0]
    index = np.unique(quads)
    own = grown[index]
    # Thin on the cheeks, where a steep rim would catch the light.
    full = thick_m * (0.4 + 0.6 * smooth((points[index, 2] - 0.045) / 0.035))
    height = SUNK_M + (full - SUNK_M) * smooth((own - 0.1) / 0.9) + (RIM_M - SUNK_M) * smooth(1.0 - own / 0.7)
    strand = 1.0 + 0.10 * np.where((np.abs(points[index, 0]) * 260).astype(int) % 2 == 0, 1.0, -1.0)
    number = np.zeros(len(points), dtype=np.int64)
    number[index] = np.arange(len(index))
    # At the rim the colour of the tinted skin beneath; what is drawn is the square of the share.
    skin_share = np.maximum(1.0 - smooth((own - 0.2) / 0.4), thin)
    shade = np.stack([strand * (0.85 + 0.15 * own), np.sqrt(skin_share)], axis=1)
    return {
        **out,
        "index": index.astype(np.int16),
        "offset": np.rint(height / STEP_M).astype(np.int16),
        "quads": number[quads].astype(np.int16),
        "shade": np.rint(shade / STEP_SHADE).astype(np.uint8),
    }


# ---------------------------------------------------------------- glasses


@dataclass(frozen=True)
class Frame:
    """Half width and height (m) of a lens's rim, how square it is (2 a circle), thickness, colour in linear light."""

    wide: float
    high: float
    square: float
    thick: float
    color: tuple[float, float, float]


FRAMES = {
    "round": Frame(0.0235, 0.0215, 2.0, 0.00125, (0.20, 0.13, 0.06)),
    "square": Frame(0.0265, 0.0180, 4.5, 0.00190, (0.012, 0.011, 0.012)),
    "oval": Frame(0.0250, 0.0165, 2.3, 0.00115, (0.25, 0.26, 0.28)),
}
MIDDLE = np.array([0.0325, 0.0015])
RIM_STEPS, RIM_SIDES = 40, 8


def wrap(x: np.ndarray) -> np.ndarray:
    """Depth (m) of the frame: it bends backwards to the sides."""
    return 0.1035 - 3.3 * np.clip(np.abs(x) - 0.008, 0.0, None) ** 2


def tube(spine: np.ndarray, thick: float, closed: bool) -> tuple[np.ndarray, np.ndarray]:
    """Points and polygons of a tube along a spine (K, 3) m; one that is not closed has its ends drawn together."""
    ahead = np.roll(spine, -1, 0) - np.roll(spine, 1, 0) if closed else np.gradient(spine, axis=0)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    up = np.array([0.0, 0.0, 1.0]) if closed else np.array([0.0, 1.0, 0.0])
    side = np.cross(ahead, up)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    upright = np.cross(side, ahead)
    angle = (np.arange(RIM_SIDES) + 0.5) * 2 * np.pi / RIM_SIDES
    size = np.full((len(spine), 1, 1), thick)
    if not closed:
        size[[0, -1]] *= 0.35
    around = np.cos(angle)[:, None] * side[:, None] + np.sin(angle)[:, None] * upright[:, None]
    points = spine[:, None] + size * around
    rows = np.arange(len(spine) * RIM_SIDES).reshape(len(spine), RIM_SIDES)
    a, b = (rows, np.roll(rows, -1, 0)) if closed else (rows[:-1], rows[1:])
    quads = np.stack([a, b, np.roll(b, -1, 1), np.roll(a, -1, 1)], axis=2).reshape(-1, 4)
    if not closed:
        k = np.arange(RIM_SIDES // 2 - 1)
        for row, way in ((rows[0], 1), (rows[-1], -1)):
            end = np.stack([row[k], row[k + 1], row[RIM_SIDES - 2 - k], row[RIM_SIDES - 1 - k]], axis=1)
            quads = np.concatenate([quads, end[:, ::way]])
    return points.reshape(-1, 3), quads


def frame(shape: Frame) -> dict[str, np.ndarray]:
    """Arrays of glasses: two rims, a bridge, two temples that end behind the ears."""
    angle = np.arange(RIM_STEPS) * 2 * np.pi / RIM_STEPS
    power = 2.0 / shape.square
    x = MIDDLE[0] + shape.wide * np.sign(np.cos(angle)) * np.abs(np.cos(angle)) ** power
    y = MIDDLE[1] + shape.high * np.sign(np.sin(angle)) * np.abs(np.sin(angle)) ** power
    loop = np.stack([x, y], axis=1)
    step = np.linalg.norm(np.roll(loop, -1, 0) - loop, axis=1)
    at = np.linspace(0.0, step.sum(), RIM_STEPS, endpoint=False)
    length = np.concatenate([[0.0], np.cumsum(step)])
    loop = np.stack([np.interp(at, length, np.append(column, column[0])) for column in loop.T], axis=1)
    rim = np.column_stack([loop, wrap(loop[:, 0])])
    outer, high = MIDDLE[0] + shape.wide, MIDDLE[1] + 0.45 * shape.high
    inner = MIDDLE[0] - shape.wide
    temple = np.array(
        [
            (outer - 0.0005, high, wrap(np.array(outer)) - 0.0005),
            (0.0690, high, 0.0820),
            (0.0755, high + 0.001, 0.0600),
            (0.0785, 0.0085, 0.0250),
            (0.0780, 0.0085, -0.0050),
            (0.0765, 0.0030, -0.0230),
            (0.0740, -0.0160, -0.0300),
        ]
    )
    temple = CubicSpline(np.arange(len(temple)), temple)(np.linspace(0, len(temple) - 1, 25))
    arch = np.linspace(-1.0, 1.0, 9)
    bridge = np.stack(
        [
            arch * (inner + 0.0004),
            MIDDLE[1] + 0.004 + 0.003 * (1 - arch**2),
            0.0015 * (1 - arch**2) + wrap(arch * inner),
        ],
        axis=1,
    )
    points, quads, first = [], [], 0
    for spine, thick, closed in ((rim, shape.thick, True), (temple, shape.thick * 0.9, False)):
        for sign in (1.0, -1.0):
            p, q = tube(spine, thick, closed)
            points.append(p * [sign, 1.0, 1.0])
            quads.append((q if sign > 0 else q[:, ::-1]) + first)
            first += len(p)
    p, q = tube(bridge, shape.thick, False)
    points.append(p)
    quads.append(q + first)
    return {
        "points": np.rint(np.concatenate(points) / STEP_M).astype(np.int16),
        "quads": np.concatenate(quads).astype(np.int16),
        "color": np.array(shape.color, dtype=np.float32),
    }


def main() -> None:
    head = archive()
    out: dict[str, np.ndarray] = {}
    for name, (thick_m, dark, thin, regions) in BEARDS.items():
        out |= {f"beard_{name}_{key}": value for key, value in beard(head, thick_m, dark, thin, regions).items()}
    for name, shape in FRAMES.items():
        out |= {f"glasses_{name}_{key}": value for key, value in frame(shape).items()}
    OUT.write_bytes(format_arrays(out))
    print(f"{OUT.name}: {OUT.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
