"""The eight expressions that ship: presets are named sets of parameter values."""

# mien: docs = picture, test = compare
import sys
from dataclasses import replace

import mien


def main(out: str = "expressions.jpg") -> None:
    face = mien.load_face("head:ben")
    names = [preset.name for preset in face.presets.values() if preset.kind == "expression"]
    scene = replace(mien.Scene(size_px=(340, 340)), at=(0.0, -0.022, 0.0)).turned(14, 2, 0.82)
    pictures = [mien.draw(face, face.presets[name].values, scene) for name in names]
    mien.contact_sheet(pictures, 4, names).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
