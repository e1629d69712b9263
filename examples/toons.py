"""The drawn faces that ship: seven characters, and Gus, who keeps to the rules of 1996."""

# mien: docs = picture, test = compare
import sys

import mien


def main(out: str = "toons.jpg") -> None:
    names = [name for name, _ in mien.face_names() if name.startswith("toon")]
    pictures = [mien.draw(name, {}, mien.Scene(size_px=(300, 330))) for name in names]
    mien.contact_sheet(pictures, 4, names).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
