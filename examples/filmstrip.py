"""Consecutive frames of a sentence at 12 frames a second, with the phone that is heard: lips shut at p, b and m."""

# mien: docs = picture, test = compare
import sys
from dataclasses import replace

import mien

FPS = 12
LINE = "How happy is the little stone"


def main(out: str = "filmstrip.jpg") -> None:
    performance = mien.say(LINE, face="head:ada")
    timeline, face = performance.timeline, performance.face
    scene = replace(mien.Scene(size_px=(200, 200)), at=(0.0, -0.045, 0.03)).turned(20, 2, 0.66)
    pictures = [mien.draw(face, pose, scene) for pose in timeline.poses(face.parameters, FPS)]
    labels = [phone_at(timeline.phones, number / FPS) for number in range(len(pictures))]
    mien.contact_sheet(pictures, 8, labels).write(out)


def phone_at(phones, time_s):
    return next((cue.symbol for cue in phones if cue.start_s <= time_s < cue.end_s), "")


if __name__ == "__main__":
    main(*sys.argv[1:])
