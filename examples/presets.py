"""Every preset on one labelled page, made from the face's own table: `mien render head --sheet presets`."""

# mien: docs = picture, test = compare
import sys

import mien


def main(out: str = "presets.jpg") -> None:
    mien.sheet("head", "presets", scene=mien.Scene(size_px=(200, 200)).seen("three-quarter")).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
