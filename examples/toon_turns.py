"""A drawn head turns by the depth of its polygons: what lies in front moves farther."""

# mien: docs = picture, test = compare
import sys

import mien

TURNS = (-1.0, -0.5, 0.0, 0.5, 1.0)


def main(out: str = "toon_turns.jpg") -> None:
    scene = mien.Scene(size_px=(220, 242))
    pictures, labels = [], []
    for face in map(mien.load_face, ("toon:amara", "toon:pip", "toon:bau")):
        reach = face.parameters["HH"].high
        for share in TURNS:
            pictures.append(mien.draw(face, {"HH": reach * share, "PLH": 10 * share, "PRH": 10 * share}, scene))
            labels.append(f"{reach * share:g} deg")
    mien.contact_sheet(pictures, len(TURNS), labels).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
