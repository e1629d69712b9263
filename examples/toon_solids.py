"""A drawn face on an egg or a box, turned freely: what has turned away is hidden."""

# mien: docs = picture, test = compare
import sys

import mien

FACES = ("toon:olav+egg", "toon:gus+egg", "toon:miso+egg", "toon:tok+box")
TURNS = (0, 30, 60, 90, 150)


def main(out: str = "toon_solids.jpg") -> None:
    scene = mien.Scene(size_px=(200, 220))
    pictures = [mien.draw(name, {"solid.turn": turn}, scene) for name in FACES for turn in TURNS]
    mien.contact_sheet(pictures, len(TURNS), [f"{turn} deg" for _ in FACES for turn in TURNS]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
