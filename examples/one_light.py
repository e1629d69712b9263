"""Parke's scenes: one light, the diffuse factor and the cosine power, and the bonnet of 1972."""

# mien: docs = picture, test = compare
import sys

import mien
from mien import Scene

SIZE = (340, 400)
PICTURES = (
    ("1972, polygons", "head:parke1972", Scene.parke(size_px=SIZE, subdivide=0, shading="polygon")),
    ("1974, smooth", "head:parke1974", Scene.parke(size_px=SIZE, subdivide=0)),
    ("diffuse factor 0.1", "head:parke1974", Scene.parke(0.1, size_px=SIZE)),
    ("cosine power 4", "head:parke1974", Scene.parke(0.3, 4, size_px=SIZE)),
)


def main(out: str = "one_light.jpg") -> None:
    pictures = [mien.draw(face, {"mouth.expression": 0.7}, scene.seen("three-quarter")) for _, face, scene in PICTURES]
    mien.contact_sheet(pictures, 4, [name for name, *_ in PICTURES]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
