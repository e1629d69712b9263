"""Parke's figure 3.12: at first all of the lower lip turned with the jaw (a); tapered, the mouth becomes oval (b)."""

# mien: docs = picture, test = compare
import sys
from dataclasses import replace

from plates import draw_plate, plate_scene

import mien

JAWS = (("untapered", "all of the lower lip turns, the corner by a half"), ("parke", "tapered, the corner by a third"))


def main(out: str = "figure_3_12.jpg") -> None:
    head = mien.load_face("head:parke1974")

    def draw(number: int, scene: mien.Scene) -> mien.Picture:
        return mien.draw(replace(head, jaw=JAWS[number][0]), {"jaw.rotation": 16}, scene)

    draw_plate(draw, plate_scene((560, 560), 4, 0.58, -0.062), 2, [caption for _, caption in JAWS]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
