"""Curves over time as in Parke's Appendix B: given values as dots, words and phones beneath."""

# mien: docs = picture, test = run
import sys
from pathlib import Path

import mien
from mien.formats.plot import plot_timeline

NAMES = ("jaw.rotation", "mouth.width", "mouth.closure", "eyelid.opening", "eyebrow.outer_raise")


def main(out: str = "curves.png") -> None:
    performance = mien.say("How happy is the little stone", seed=1)
    plot_timeline(performance.timeline, performance.face.parameters, Path(out), NAMES)


if __name__ == "__main__":
    main(*sys.argv[1:])
