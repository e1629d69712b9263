"""The 21 motors of 1996, each at its maximum, on a drawn face and on the head."""

# mien: docs = picture, test = compare
import sys

import mien
from mien.vocab import vocabulary

DRAWN, HEAD = "toon:amara", "head:ada"


def main(out: str = "toon_motors.jpg") -> None:
    drawn = mien.load_face(DRAWN)
    codes = [row.name for row in vocabulary("toonface")]
    scene = mien.Scene(size_px=(150, 165))
    near = mien.Scene(size_px=(150, 165)).turned(0, 2, 0.72)
    pictures = [mien.draw(drawn, mien.pose_from("toonface", {code: far(drawn, code)}, drawn), scene) for code in codes]
    pictures += [mien.draw(HEAD, mien.pose_from("toonface", {code: far(drawn, code)}, HEAD), near) for code in codes]
    mien.contact_sheet(pictures, 7, [*codes, *codes]).write(out)


def far(face, code):
    return face.parameters[code].high


if __name__ == "__main__":
    main(*sys.argv[1:])
