"""All named expressions of the head on every drawn face."""

# mien: docs = picture, test = compare
import sys

import mien


def main(out: str = "toon_presets.jpg") -> None:
    toons = [mien.load_face(name) for name, _ in mien.face_names() if name.startswith("toon")]
    names = [preset.name for preset in mien.load_face("head").presets.values() if preset.kind == "expression"]
    scene = mien.Scene(size_px=(110, 121))
    pictures = [mien.draw(face, mien.make_pose(face, presets=[name]), scene) for name in names for face in toons]
    mien.contact_sheet(pictures, len(toons), [name for name in names for _ in toons]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
