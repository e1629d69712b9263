"""Drawings made playable by `mien toon from-svg`: as they are drawn, saying ah, shut eyes, laughing."""

# mien: docs = picture, test = compare
import sys
from pathlib import Path

import mien
from mien.faces.toon.reader import parse_toon
from mien.faces.toon.toon import ToonFace
from mien.formats.toon_from_svg import toon_from_svg

DRAWINGS = Path(__file__).parent / "drawings"
POSES = {"as drawn": {}, "ah": {"MB": 0.8}, "eyes shut": {"ELU": 0.0, "ERU": 0.0}}


def main(out: str = "toon_from_svg.jpg") -> None:
    scene = mien.Scene(size_px=(180, 180))
    pictures, labels = [], []
    for name in ("sunny", "mina", "robot", "doodle"):
        guessed = toon_from_svg(DRAWINGS / f"{name}.svg", name)
        face = ToonFace(parse_toon(guessed.to_text(), f"{name}.toon.json"), name)
        pictures += [mien.draw(face, values, scene) for values in POSES.values()]
        pictures.append(mien.draw(face, mien.make_pose(face, presets=["laugh"]), scene))
        labels += [*POSES, "laugh"]
    mien.contact_sheet(pictures, 8, labels).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
