"""The nine mouth shapes of Rhubarb on four drawn faces: A shuts, G has the lip under the teeth, H the tongue up."""

# mien: docs = picture, test = compare
import sys

import mien

SHAPES = "ABCDEFGHX"


def main(out: str = "toon_mouths.jpg") -> None:
    scene = mien.Scene(size_px=(150, 165))
    pictures = [
        mien.draw(name, mien.pose_from("rhubarb", {shape: 1.0}, name), scene)
        for name in ("toon:olav", "toon:amara", "toon:pip", "toon:tok")
        for shape in SHAPES
    ]
    mien.contact_sheet(pictures, len(SHAPES), list(SHAPES) * 4).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
