"""A blink in five steps: lids are two-dimensional shapes, interpolated and put back on a sphere around the eye."""

# mien: docs = picture, test = compare
import sys
from dataclasses import replace

import mien

OPENINGS = (0.75, 0.5, 0.3, 0.15, 0.0)


def main(out: str = "blink.jpg") -> None:
    scene = replace(mien.Scene(size_px=(300, 200)), at=(0.0, 0.008, 0.07)).turned(8, 0, 0.42)
    pictures = [mien.draw("head", {"eyelid.opening": opening}, scene) for opening in OPENINGS]
    mien.contact_sheet(pictures, 5, [f"eyelid.opening {opening:g}" for opening in OPENINGS]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
