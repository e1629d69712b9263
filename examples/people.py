"""The people who ship: one topology, and for each a shape, hair and colours; some with a beard or glasses."""

# mien: docs = picture, test = compare
import sys

import mien


def main(out: str = "people.jpg") -> None:
    scene = mien.Scene(size_px=(240, 280)).turned(22, 3, 1.16)
    names = [name for name, _ in mien.face_names() if name.startswith("head") and "parke" not in name]
    pictures = [mien.draw(name, {"mouth.expression": 0.75}, scene) for name in names]
    mien.contact_sheet(pictures, 6, names).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
