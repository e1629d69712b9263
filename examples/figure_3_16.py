"""Parke's figure 3.16: what the shape of a head can be, with the values of his captions; where he gives none, ours."""

# mien: docs = picture, test = compare
import sys

from plates import draw_plate, plate_scene

import mien

HEADS = (
    ("the initial face", {}),
    ("forehead 0", {"forehead.shape": 0.0}),
    ("neck 1", {"neck.shape": 1.0}),
    ("jaw 0.8", {"jaw.width": 0.8}),
    ("chin to mouth 0.85", {"face.chin_to_mouth": 0.85}),
    ("chin to mouth 0.9, to eye 0.8", {"face.chin_to_mouth": 0.9, "face.chin_to_eye": 0.8}),
    ("head's height 1.15", {"head.scale.height": 1.15}),
    ("end of the nose 0.8", {"nose.end.width": 0.8}),
    ("end of the nose down", {"nose.end.up": -30}),
    ("head's width 0.95, cheekbones", {"head.scale.width": 0.95, "cheekbone.shape": 0.8}),
    (
        "head's width 1.1, nose, brows, cheeks",
        {
            "head.scale.width": 1.1,
            "nose.end.up": 25,
            "nose.end.width": 1.1,
            "nose.bridge.width": 0.7,
            "eyebrow.up": -20,
            "cheekbone.shape": 0.75,
            "cheek.hollow": 0.8,
        },
    ),
)


def main(out: str = "figure_3_16.jpg") -> None:
    def draw(number: int, scene: mien.Scene) -> mien.Picture:
        return mien.draw("head:parke1974", HEADS[number][1], scene)

    draw_plate(draw, plate_scene((320, 370), 38, 0.95, -0.032), 4, [caption for caption, _ in HEADS]).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
