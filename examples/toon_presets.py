"""Six of the named expressions on every drawn face; each has all of the head's."""

# mien: docs = picture, test = compare
import sys

import mien

NAMES = ("happy", "sad", "angry", "surprised", "skeptical", "laugh")


def main(out: str = "toon_presets.jpg") -> None:
    toons = [name for name, _ in mien.face_names() if name.startswith("toon")]
    scene = mien.Scene(size_px=(180, 198))
    pictures = [
        mien.draw(face, mien.make_pose(face, presets=[name]), scene)
        for face in map(mien.load_face, toons)
        for name in NAMES
    ]
    mien.contact_sheet(pictures, len(NAMES), [name for _ in toons for name in NAMES]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
