"""Thórisson's caricature as one number: expressions at 0.5, 1, 1.5, 2 and 3 of their distance from neutral."""

# mien: docs = picture, test = compare
import sys

import mien

AMOUNTS = (0.5, 1.0, 1.5, 2.0, 3.0)
ROWS = (("head:ada", "smile"), ("head:ben", "angry"), ("toon:olav", "sad"), ("toon:miso", "surprised"))


def main(out: str = "caricature.jpg") -> None:
    scene = mien.Scene(size_px=(200, 220)).turned(14, 2, 0.95)
    pictures, labels = [], []
    for name, preset in ROWS:
        face = mien.load_face(name)
        pose = mien.make_pose(face, presets={preset: 0.7})
        pictures += [mien.draw(face, mien.exaggerate(pose, amount), scene) for amount in AMOUNTS]
        labels += [f"{preset} x {amount:g}" for amount in AMOUNTS]
    mien.contact_sheet(pictures, len(AMOUNTS), labels).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
