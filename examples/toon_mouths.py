"""The fifteen visemes of Oculus on every drawn face: PP shuts, FF has the lip under the teeth, U is round."""

# mien: docs = picture, test = compare
import sys

import mien
from mien.vocab import vocabulary


def main(out: str = "toon_mouths.jpg") -> None:
    toons = [mien.load_face(name) for name, _ in mien.face_names() if name.startswith("toon")]
    names = vocabulary("oculus").names
    scene = mien.Scene(size_px=(130, 143))
    pictures = [mien.draw(face, mien.pose_from("oculus", {name: 1.0}, face), scene) for name in names for face in toons]
    mien.contact_sheet(pictures, len(toons), [name for name in names for _ in toons]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
