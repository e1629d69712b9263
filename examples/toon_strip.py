"""Consecutive frames of a sentence that a drawn face says, at 12 frames a second, with the phone that is heard."""

# mien: docs = picture, test = compare
import sys

from filmstrip import phone_at

import mien

FPS = 12
LINE = "How happy is the little stone"


def main(out: str = "toon_strip.jpg") -> None:
    performance = mien.say(LINE, face="toon:miso")
    timeline, face = performance.timeline, performance.face
    scene = mien.Scene(size_px=(180, 198))
    pictures = [mien.draw(face, pose, scene) for pose in timeline.poses(face.parameters, FPS)]
    labels = [phone_at(timeline.phones, number / FPS) for number in range(len(pictures))]
    mien.contact_sheet(pictures, 8, labels).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
