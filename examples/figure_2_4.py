"""Parke's figure 2.4: from one face to another by interpolation; here every parameter goes along, colours too."""

# mien: docs = picture, test = compare
import sys

from plates import draw_plate, plate_scene

import mien

YOUNG = {
    "face.sex": 0.0,
    "face.weight": 0.3,
    "face.chin_to_eye": 0.96,
    "jaw.width": 0.92,
    "chin.shape": 0.35,
    "nose.length": 0.3,
    "nose.end.width": 1.06,
    "lip.upper.thickness": 0.9,
    "lip.lower.thickness": 0.85,
    "cheekbone.shape": 0.8,
    "neck.shape": 0.1,
    "eyebrow.thickness": 0.8,
    "mouth.expression": 0.7,
}
OLD = {
    "face.age": 1.0,
    "face.sex": 0.9,
    "face.weight": 0.55,
    "face.chin_to_eye": 1.05,
    "cheek.hollow": 0.8,
    "forehead.shape": 0.2,
    "nose.length": 0.9,
    "nose.tip": 0.9,
    "nose.bridge.curve": 0.95,
    "nose.bridge.width": 1.15,
    "lip.upper.thickness": 0.05,
    "lip.lower.thickness": 0.2,
    "ear.size": 1.2,
    "neck.shape": 0.8,
    "eyebrow.thickness": 1.5,
    "eyebrow.lower": 0.25,
    "eyelid.opening": 0.62,
    "mouth.expression": 0.85,
}
STEPS = 6


def main(out: str = "figure_2_4.jpg") -> None:
    head = mien.load_face("head:parke1974")
    young = head.neutral.replace({**head.presets["umber"].values, **YOUNG})
    old = head.neutral.replace({**head.presets["silver"].values, **OLD})

    def draw(number: int, scene: mien.Scene) -> mien.Picture:
        return mien.draw(head, young.blend(old, number / (STEPS - 1)), scene)

    captions = [f"{number / (STEPS - 1):g} of the way" for number in range(STEPS)]
    draw_plate(draw, plate_scene((360, 420), 18, 0.88, -0.02), 3, captions, grey=False).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
