"""The jaw opens in five steps: lower lip, corners, teeth and tongue turn with it, each by its share."""

# mien: docs = picture, test = compare
import sys
from dataclasses import replace

import mien

ANGLES = (0, 5, 10, 15, 20)


def main(out: str = "jaw.jpg") -> None:
    scene = replace(mien.Scene(size_px=(300, 300)), at=(0.0, -0.07, 0.06)).turned(18, 0, 0.5)
    pictures = [mien.draw("head:kenji", {"jaw.rotation": angle}, scene) for angle in ANGLES]
    mien.contact_sheet(pictures, 5, [f"jaw.rotation {angle}" for angle in ANGLES]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
