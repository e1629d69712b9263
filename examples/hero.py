"""Three people, each a pose of the same parameters."""

# mien: docs = picture, test = compare
import sys

import mien

PEOPLE = (
    ("head:imani", {"mouth.expression": 0.45, "cheek.raise": 0.25, "eyebrow.arch": 0.55, "head.tilt": 4}),
    ("head", {"mouth.expression": 0.7, "eyebrow.arch": 0.55, "head.turn": -4}),
    ("head:ada", {"mouth.expression": 0.6, "cheek.raise": 0.15, "eyebrow.arch": 0.5, "head.tilt": -5}),
)


def main(out: str = "hero.jpg") -> None:
    scene = mien.Scene(size_px=(400, 460)).turned(20, 3, 1.14)
    mien.contact_sheet([mien.draw(face, values, scene) for face, values in PEOPLE], 3).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
