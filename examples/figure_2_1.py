"""Parke's figure 2.1: a block letter H becomes an aircraft, two phases of one topology."""

# mien: docs = picture, test = compare
from pathlib import Path

from plates import draw_plate

import mien

FOLDER = Path(__file__).parent / "keypose/aircraft.keypose"
STEPS = 6


def main(out: str = "figure_2_1.jpg") -> None:
    face = mien.load_face(FOLDER)
    scene = mien.Scene(
        size_px=(400, 400),
        position=(0.28, -0.46, 0.62),
        at=(0.0, 0.0, 0.0),
        fov_deg=20.0,
        shading="polygon",
        subdivide=0,
    )
    numbers = [1.0 + step / (STEPS - 1) for step in range(STEPS)]

    def draw(step: int, scene: mien.Scene) -> mien.Picture:
        return mien.draw(face, {"phase.number": numbers[step]}, scene)

    draw_plate(draw, scene, 3, [f"phase {number:.1f}" for number in numbers], grey=False).write(out)


if __name__ == "__main__":
    main()
