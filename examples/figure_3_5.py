"""Parke's figure 3.5: the eyeballs that his procedure makes, with the fringe around the iris (a) and without (b)."""

# mien: docs = picture, test = compare
import sys
from dataclasses import replace

from plates import GROUND, draw_plate

import mien

EYES = (("with the iris fringe", {}), ("without", {"fringe.size": 0.0, "iris.size": 0.58, "pupil.size": 0.13}))


def main(out: str = "figure_3_5.jpg") -> None:
    head = mien.load_face("head:ben")
    others = [part.name for part in head.topology.parts if not part.name.startswith(("eye.", "spot."))]
    scene = mien.Scene(size_px=(760, 320), background=(GROUND, GROUND), at=(0.0, 0.004, 0.075), fov_deg=2.4)
    scene = replace(scene.turned(0, 0), target=(0.18, 0.03, 1.0))

    def draw(number: int, scene: mien.Scene) -> mien.Picture:
        return mien.draw(head, EYES[number][1], scene, without=others)

    draw_plate(draw, scene, 1, [caption for caption, _ in EYES], grey=False).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
