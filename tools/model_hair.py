"""Model the hair that ships: shells around the measured skull, one a style.

python tools/model_hair.py
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

sys.path.insert(0, str(Path(__file__).parent))
from hair.shells import Cap, Shell, cap_shell, joined, rounded, tube
from hair.skull import Skull

from mien.faces.head.arrays import format_arrays
from mien.faces.head.hair import STEP_M, STEP_SHADE
from mien.faces.head.measured import archive

OUT = Path(__file__).parents[1] / "src/mien/faces/head/data/hair.arrays"

SHORT = ((0, 0.083), (22, 0.083), (36, 0.078), (47, 0.066), (55, 0.048), (61, 0.026), (66, 0.002), (71, -0.010),
         (79, -0.011), (86, 0.010), (98, 0.020), (112, 0.008), (124, -0.028), (140, -0.062), (180, -0.072))  # fmt: skip
"""Around the ears: forehead, temple, sideburn, over the ear, nape."""

DRAWN = ((0, 0.086), (9, 0.084), (19, 0.078), (28, 0.068), (36, 0.054), (44, 0.037), (52, 0.018), (60, 0.000),
         (67, -0.008), (76, -0.008), (86, 0.006), (98, 0.016), (114, 0.000), (128, -0.036), (145, -0.062),
         (180, -0.070))  # fmt: skip
"""Drawn back: a rounded forehead, a temple that recedes a little, a wisp before the ear."""

CAPS = {
    "crop": Cap(
        SHORT,
        ((0, 0.0055), (60, 0.0048), (100, 0.005), (180, 0.006)),
        taper=0.034,
        flat=True,
        groove=0.0005,
        locks=34,
        hang=-30,
        fade=0.012,
        ragged=0.0009,
    ),
    "side_part": Cap(
        SHORT,
        ((0, 0.009), (45, 0.0075), (90, 0.008), (130, 0.010), (180, 0.009)),
        taper=0.016,
        line=31,
        swirl=1.1,
        hang=-30,
        groove=0.0014,
        locks=20,
        tuft=0.017,
        seed=4,
        ragged=0.0008,
        fade=0.002,
    ),
    "bob": Cap(
        ((0, 0.047), (34, 0.046), (43, 0.036), (52, -0.020), (58, -0.076), (66, -0.088), (110, -0.090), (180, -0.094)),
        ((0, 0.010), (45, 0.014), (75, 0.022), (95, 0.024), (130, 0.018), (180, 0.015)),
        groove=0.0016,
        top=0.55,
        locks=26,
        hang=-20,
        flare=-0.010,
        seed=2,
        ragged=0.0012,
    ),
    "updo": Cap(
        DRAWN,
        ((0, 0.007), (60, 0.006), (180, 0.008)),
        crown=128,
        groove=0.0016,
        locks=30,
        taper=0.026,
        flat=True,
        seed=5,
        hang=-12,
    ),
    "afro": Cap(
        SHORT,
        ((0, 0.040), (50, 0.046), (90, 0.052), (180, 0.050)),
        taper=0.080,
        groove=0.0,
        locks=0,
        lump=0.010,
        lump_size=0.019,
        columns=100,
        rows=32,
        fade=0.004,
        hang=-24,
    ),
    "bonnet": Cap(
        ((0, 0.056), (32, 0.054), (42, 0.040), (52, -0.010), (58, -0.064), (66, -0.078), (120, -0.080), (180, -0.080)),
        ((0, 0.014), (50, 0.018), (80, 0.026), (130, 0.024), (180, 0.020)),
        groove=0.0,
        locks=0,
        top=0.7,
        hang=-16,
        flare=0.016,
        columns=64,
        rows=16,
    ),
    "long": Cap(
        (
            (0, 0.088),
            (28, 0.084),
            (40, 0.064),
            (50, 0.010),
            (56, -0.050),
            (63, -0.112),
            (75, -0.126),
            (110, -0.138),
            (180, -0.170),
        ),
        ((0, 0.009), (45, 0.014), (75, 0.022), (95, 0.024), (130, 0.017), (180, 0.014)),
        part=60,
        groove=0.0020,
        top=0.5,
        locks=22,
        hang=-18,
        flare=0.001,
        rows=27,
        seed=3,
        ragged=0.002,
    ),
    "curls": Cap(
        ((0, 0.070), (30, 0.066), (44, 0.050), (54, 0.000), (60, -0.060), (68, -0.082), (180, -0.098)),
        ((0, 0.020), (45, 0.024), (90, 0.036), (180, 0.030)),
        groove=0.0,
        locks=0,
        lump=0.016,
        lump_size=0.026,
        hang=-22,
        top=0.8,
        flare=0.010,
        ragged=0.005,
        columns=104,
        rows=27,
        seed=6,
    ),
    "ponytail": Cap(
        DRAWN,
        ((0, 0.007), (60, 0.006), (180, 0.008)),
        crown=126,
        groove=0.0012,
        locks=28,
        taper=0.026,
        flat=True,
        seed=8,
        hang=-12,
    ),
    "pixie": Cap(
        (
            (0, 0.054),
            (20, 0.060),
            (34, 0.062),
            (48, 0.044),
            (60, 0.022),
            (72, -0.004),
            (80, -0.006),
            (88, 0.012),
            (100, 0.018),
            (114, 0.004),
            (126, -0.028),
            (145, -0.060),
            (180, -0.070),
        ),
        ((0, 0.009), (40, 0.011), (90, 0.011), (140, 0.013), (180, 0.010)),
        taper=0.014,
        hang=-30,
        groove=0.0018,
        locks=20,
        tuft=0.004,
        swirl=0.7,
        ragged=0.0016,
        seed=9,
    ),
    "braids": Cap(
        DRAWN, ((0, 0.008), (180, 0.008)), part=40, taper=0.026, flat=True, groove=0.0012, locks=30, seed=10, hang=-12
    ),
    "ring": Cap(
        (
            (0, 0.030),
            (52, 0.034),
            (60, 0.024),
            (66, 0.002),
            (71, -0.014),
            (79, -0.016),
            (86, 0.010),
            (98, 0.020),
            (112, 0.008),
            (124, -0.028),
            (140, -0.062),
            (180, -0.072),
        ),
        ((0, 0.000), (56, 0.001), (66, 0.003), (76, 0.005), (95, 0.0065), (180, 0.009)),
        taper=0.024,
        flat=True,
        fade=0.010,
        rim=((0, 0.040), (60, 0.040), (74, 0.050), (120, 0.056), (180, 0.048)),
        groove=0.0010,
        locks=30,
        rows=15,
        hang=-30,
        seed=11,
    ),
}


def bun() -> Shell:
    """A coil of hair on the back of the crown."""
    t = np.linspace(0.0, 1.0, 13)
    axis = np.array([0.0, 0.72, -0.69])
    spine = np.array([0.0, 0.093, -0.062]) + t[:, None] * 0.052 * axis
    return tube(spine, np.sqrt(np.clip(1 - (2 * t - 0.95) ** 2, 0.012, 1)) * 0.033, 28, locks=7, twist=1.9)


def tail() -> Shell:
    """A ponytail from the back of the crown over the own left shoulder."""
    spine = np.array(
        [
            (0, 0.086, -0.064),
            (0.001, 0.104, -0.094),
            (0.010, 0.090, -0.122),
            (0.036, 0.042, -0.124),
            (0.066, -0.025, -0.100),
            (0.084, -0.085, -0.064),
            (0.091, -0.135, -0.014),
            (0.090, -0.185, 0.026),
        ]
    )
    size = rounded(30, np.array([0.017, 0.018, 0.024, 0.027, 0.026, 0.023, 0.018, 0.010]), 0.12, 0.12)
    return tube(_curve(spine, 30), size, 20, 0.85, locks=5, twist=1.3, furrow=0.10)


def braid(sign: float) -> Shell:
    """A braid from behind an ear over the collar bone."""
    spine = np.array([(0.062, -0.030, -0.050), (0.074, -0.062, -0.036), (0.078, -0.100, -0.012), (0.080, -0.140, 0.022),
                      (0.078, -0.185, 0.046)]) * [sign, 1, 1]  # fmt: skip
    count = 46
    size = rounded(count, np.array([0.014, 0.016, 0.016, 0.015, 0.010]), 0.08, 0.06)
    wave = 1.0 + 0.17 * np.cos(np.linspace(0, 9 * 2 * np.pi, count))
    path = _curve(spine, count)
    path[:, 0] += 0.003 * np.sin(np.linspace(0, 9 * np.pi, count))
    return tube(path, size * wave, 12, 0.75, locks=3, twist=0.0)


def _curve(knots: np.ndarray, count: int) -> np.ndarray:
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(knots, axis=0), axis=1))])
    return CubicSpline(length, knots)(np.linspace(0.0, length[-1], count))


BESIDE = {"updo": lambda: (bun(),), "ponytail": lambda: (tail(),), "braids": lambda: (braid(1.0), braid(-1.0))}


def main() -> None:
    skull = Skull(archive())
    out: dict[str, np.ndarray] = {}
    for name in sorted(CAPS):
        shell = joined(cap_shell(CAPS[name], skull), *BESIDE.get(name, tuple)())
        # In whole hundredths of a millimetre, so that the last bits of a library's sines do not reach the file.
        out[f"{name}_points"] = np.rint(shell.points / STEP_M).astype(np.int16)
        out[f"{name}_quads"] = shell.quads.astype(np.int16)
        out[f"{name}_shade"] = np.rint(np.clip(shell.shade, 0.0, 2.0) / STEP_SHADE).astype(np.uint8)
        print(f"{name}: {len(shell.points)} vertices")
    OUT.write_bytes(format_arrays(out))
    print(f"{OUT.name}: {OUT.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
