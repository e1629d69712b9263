"""Both eyes look at one point, each by itself; the reflection of the light stays where light and viewer put it."""

# mien: docs = picture, test = compare
import sys
from dataclasses import replace

import mien

TARGETS = (
    ("to the own left", (0.5, 0.0, 1.0)),
    ("to the own right", (-0.5, 0.0, 1.0)),
    ("up", (0.0, 0.45, 1.0)),
    ("down", (0.0, -0.45, 1.0)),
    ("at the tip of the nose", (0.0, -0.03, 0.2)),
)


def main(out: str = "gaze.jpg") -> None:
    scene = replace(mien.Scene(size_px=(300, 200)), at=(0.0, 0.008, 0.07)).turned(0, 0, 0.42)
    pictures = [mien.draw("head:ada", scene=replace(scene, target=target)) for _, target in TARGETS]
    mien.contact_sheet(pictures, 5, [name for name, _ in TARGETS]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
