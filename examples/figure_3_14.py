"""Parke's figure 3.14: eight faces, three parameters of the mouth: jaw rotation, upper lip, expression."""

# mien: docs = picture, test = compare
import sys
from itertools import product

from plates import draw_plate, plate_scene

import mien

STEPS = tuple(product((1, 0), (0, 9), (0, 16)))


def main(out: str = "figure_3_14.jpg") -> None:
    def draw(number: int, scene: mien.Scene) -> mien.Picture:
        smile, jaw, lip = STEPS[number]
        return mien.draw(
            "head:parke1974", {"mouth.expression": smile, "jaw.rotation": jaw, "mouth.upper_lip": lip}, scene
        )

    captions = [f"jaw {jaw}, upper lip {lip}, expression {smile}" for smile, jaw, lip in STEPS]
    draw_plate(draw, plate_scene((330, 380), 16, 0.78, -0.022), 4, captions).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
