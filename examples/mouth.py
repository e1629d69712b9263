"""Parke's mouth parameters at an end of their range, and what speech needs besides."""

# mien: docs = picture, test = compare
import sys
from dataclasses import replace

import mien

SHAPES = (
    ("mouth.expression 0", {"mouth.expression": 0.0}),
    ("mouth.width 0.6", {"mouth.width": 0.6, "jaw.rotation": 3}),
    ("mouth.width 1.3", {"mouth.width": 1.3}),
    ("mouth.upper_lip 20", {"mouth.upper_lip": 20}),
    ("mouth.tuck -20", {"mouth.tuck": -20, "jaw.rotation": 3, "mouth.upper_lip": 6}),
    ("mouth.offset 30", {"mouth.offset": 30}),
    ("mouth.corner.up 25", {"mouth.corner.up": 25}),
    ("mouth.corner.width 25", {"mouth.corner.width": 25}),
    ("mouth.closure 1, jaw.rotation 8", {"mouth.closure": 1, "jaw.rotation": 8}),
    ("mouth.pucker 0.8", {"mouth.pucker": 0.8, "jaw.rotation": 2}),
    ("mouth.funnel 0.6", {"mouth.funnel": 0.6, "jaw.rotation": 2}),
    ("tongue.raise 1, jaw.rotation 7", {"tongue.raise": 1, "jaw.rotation": 7}),
)


def main(out: str = "mouth.jpg") -> None:
    scene = replace(mien.Scene(size_px=(260, 230)), at=(0.0, -0.066, 0.07)).turned(24, -1, 0.4)
    pictures = [mien.draw("head:ben", values, scene) for _, values in SHAPES]
    mien.contact_sheet(pictures, 6, [name for name, _ in SHAPES]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
