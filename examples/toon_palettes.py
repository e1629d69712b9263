"""Each character's palettes: colours are parameters, so that a palette is a preset like any other."""

# mien: docs = picture, test = compare
import sys

import mien


def main(out: str = "toon_palettes.jpg") -> None:
    scene = mien.Scene(size_px=(200, 220))
    pictures, labels = [], []
    for name in ("toon:olav", "toon:amara", "toon:tok", "toon:miso"):
        face = mien.load_face(name)
        palettes = [preset.name for preset in face.presets.values() if preset.kind == "palette"][:4]
        pictures += [mien.draw(face, mien.make_pose(face, presets=[palette]), scene) for palette in palettes]
        labels += palettes
    mien.contact_sheet(pictures, 4, labels).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
