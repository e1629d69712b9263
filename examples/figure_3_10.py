"""Parke's figure 3.10: four faces, two parameters of the eyes: how far the lids are open, how arched the brows are."""

# mien: docs = picture, test = compare
import sys

from plates import draw_plate, plate_scene

import mien

STEPS = ((1.0, 0.0), (1.0, 1.0), (0.4, 0.0), (0.4, 1.0))


def main(out: str = "figure_3_10.jpg") -> None:
    def draw(number: int, scene: mien.Scene) -> mien.Picture:
        opening, arch = STEPS[number]
        return mien.draw("head:parke1974", {"eyelid.opening": opening, "eyebrow.arch": arch}, scene)

    captions = [f"eyelid.opening {opening:g}, eyebrow.arch {arch:g}" for opening, arch in STEPS]
    draw_plate(draw, plate_scene((440, 440), 14, 0.84, -0.014), 2, captions).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
