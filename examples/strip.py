"""Frames of the film that scripts/demo makes, one a phone of its first line."""

# mien: docs = picture, test = compare
import sys
from dataclasses import replace
from pathlib import Path

import mien

POEM = Path(__file__).with_name("stone.txt")
COUNT = 12


def main(out: str = "strip.jpg") -> None:
    performance = mien.say(POEM.read_text(encoding="utf-8"))
    timeline, face = performance.timeline, performance.face
    scene = replace(mien.Scene(size_px=(150, 170)), at=(0.0, -0.04, 0.03)).turned(22, 3, 0.66)
    phones = [cue for cue in timeline.phones if cue.symbol != "SIL" and cue.length_s > 0.04][:COUNT]
    values = timeline.values([cue.centre_s for cue in phones], face.parameters)
    pictures = [mien.draw(face, mien.Pose(face.parameters, row), scene) for row in values]
    mien.contact_sheet(pictures, COUNT, [cue.symbol.rstrip("012") for cue in phones]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
