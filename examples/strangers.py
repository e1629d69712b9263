"""Strangers: shape and colours drawn by chance, as people differ; `--random SEED` on the command line."""

# mien: docs = picture, test = compare
import sys

import mien

HAIR_OF = ("head:ada", "head:ben", "head:marisol", "head:omar", "head:elif", "head:kenji")


def main(out: str = "strangers.jpg") -> None:
    scene = mien.Scene(size_px=(240, 260)).turned(20, 3, 1.1)
    pictures = []
    for seed in range(18):
        face = mien.load_face(HAIR_OF[seed % len(HAIR_OF)])
        pictures.append(mien.draw(face, mien.make_pose(face, {"mouth.expression": 0.7}, seed=seed), scene))
    mien.contact_sheet(pictures, 6, [f"--random {seed}" for seed in range(18)]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
