"""Where a drawn face seems to look, to a viewer before it and to viewers at its side, as drawn and compensated.

The arrow under each picture is seen from above: it starts at the face and points to where its eyes seem to look; the
dot is the viewer.
"""

# mien: docs = picture, test = compare
import math
import sys
from dataclasses import replace

import numpy as np
from PIL import Image, ImageDraw

import mien
from mien.faces.toon.gazing import what_is_seen

FACE = "toon:olav"
SIZE = (220, 242)
FOOT = 110
TURNS = (-24.0, -12.0, 0.0, 12.0, 24.0)
VIEWERS = (-35.0, -18.0, 0.0, 18.0, 35.0)


def main(out: str = "toon_gaze.jpg") -> None:
    face = mien.load_face(FACE)
    pictures, labels = [], []
    for amount in (0.0, 1.0):
        for turn in TURNS:
            told = {"head.horizontal": turn, "pupil.horizontal.left": -turn, "pupil.horizontal.right": -turn}
            picture, gaze = look(face, {**told, "gaze.compensation": amount}, 0.0)
            pictures.append(picture)
            labels.append(f"{'compensated' if amount else 'as told'}: {past(gaze)}")
    for amount in (0.0, 1.0):
        for viewer in VIEWERS:
            picture, gaze = look(face, {"gaze.compensation": amount}, viewer)
            pictures.append(picture)
            labels.append(f"{'compensated' if amount else 'as told'}: {past(gaze)}")
    mien.contact_sheet(pictures, len(TURNS), labels).write(out)


def look(face, values, viewer_deg):
    """The picture that a viewer sees from the side of a flat screen, and where the eyes seem to look from there."""
    angle = math.radians(viewer_deg)
    pose = face.neutral.replace({**values, "viewer.x": -math.sin(angle), "viewer.z": math.cos(angle)})
    picture = mien.draw(face, pose, mien.Scene(size_px=SIZE))
    shares = face.moment(pose).shares
    gaze = what_is_seen(face.character)[0].gaze_deg(shares["PRH"], shares["HH"], viewer_deg)
    return replace(picture, pixels=with_foot(picture.pixels, viewer_deg, gaze)), gaze


def past(gaze_deg):
    """How far from the viewer's eyes, in words."""
    side = "left" if gaze_deg > 0 else "right"
    return "at the viewer" if abs(gaze_deg) < 0.5 else f"{abs(gaze_deg):.0f}° to the {side}"


def with_foot(pixels, viewer_deg, gaze_deg):
    """The picture as narrow as its slant makes it, over a plan of face, viewer and gaze."""
    width, height = SIZE
    sheet = Image.new("RGBA", (width, height + FOOT), "white")
    narrow = round(width * math.cos(math.radians(viewer_deg)))
    sheet.paste(Image.fromarray(pixels).resize((narrow, height)), ((width - narrow) // 2, 0))
    draw = ImageDraw.Draw(sheet)
    top = (width / 2, height + 12)
    viewer = spot(top, viewer_deg, 80)
    draw.line([top[0] - 40, top[1], top[0] + 40, top[1]], fill="#999999", width=3)
    draw.line([*top, *viewer], fill="#cccccc", width=1)
    draw.ellipse([viewer[0] - 5, viewer[1] - 5, viewer[0] + 5, viewer[1] + 5], fill="#333333")
    end = spot(top, viewer_deg + gaze_deg, 78)
    draw.line([*top, *end], fill="#d4502f", width=4)
    for side in (-150, 150):
        draw.line([*end, *spot(end, viewer_deg + gaze_deg + side, 12)], fill="#d4502f", width=4)
    return np.asarray(sheet)


def spot(start, angle_deg, length):
    """A point in the plan: 0 degrees is down, to the viewers, and positive to the left."""
    angle = math.radians(angle_deg)
    return start[0] - length * math.sin(angle), start[1] + length * math.cos(angle)


if __name__ == "__main__":
    main(*sys.argv[1:])
