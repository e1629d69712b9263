"""A head from the front, from three quarters and from the side."""

# mien: docs = picture, test = compare
import sys

import mien

VIEWS = ("front", "three-quarter", "side")


def main(out: str = "three_views.jpg") -> None:
    scene = mien.Scene(size_px=(400, 460))
    pictures = [mien.draw("head", scene=scene.seen(view)) for view in VIEWS]
    mien.contact_sheet(pictures, 3, VIEWS).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
