"""Hands drawn with the characters: poses are presets, and `[wave]` in a text asks for a move."""

# mien: docs = picture, test = compare
import sys

import mien

POSES = ("open", "fist", "point", "victory", "thumbs_up")


def main(out: str = "toon_hands.jpg") -> None:
    scene = mien.Scene(size_px=(200, 220))
    faces = [mien.load_face(name) for name in ("toon:pip", "toon:amara", "toon:tok")]
    pictures = [mien.draw(face, mien.make_pose(face, presets=[name]), scene) for face in faces for name in POSES]
    mien.contact_sheet(pictures, len(POSES), [name for _ in faces for name in POSES]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
