"""Small pictures that must stay the same to the byte of every pixel.

On a mismatch the new picture, the difference and the difference times eight are written to tests/golden/new with a
page to review them. To accept a picture, copy it from there to tests/golden/pictures, one by one, and say in
CHANGELOG.md under Look what changed.
"""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import mien
from mien import Scene

HERE = Path(__file__).parent
SIZE = (128, 128)
PLAIN = Scene(size_px=SIZE).seen("three-quarter")
CASES = {
    "neutral": ("head", {}, PLAIN),
    "laugh": ("head:ben", "laugh", PLAIN),
    "shut": ("head:ada", {"eyelid.opening": 0.0}, Scene(size_px=SIZE)),
    "turned": ("head:imani", {"head.turn": 25, "head.tilt": -8, "jaw.rotation": 6}, PLAIN),
    "asymmetric": ("head:tom", {"mouth.expression.left": 0.0, "eyebrow.arch.right": 0.0}, PLAIN),
    "polygons": ("head:parke1972", {}, Scene.parke(size_px=SIZE, subdivide=0, shading="polygon")),
    "gouraud": ("head:parke1974", {"jaw.rotation": 8}, Scene.parke(size_px=SIZE, subdivide=0)),
    "wire": ("head:parke1974", {}, Scene(size_px=SIZE, subdivide=0, shading="wire")),
    "transparent": ("head:kenji", "surprised", Scene(size_px=SIZE, background=((0, 0, 0, 0), (0, 0, 0, 0)))),
    "toon_laugh": ("toon:olav", "laugh", PLAIN),
    "toon_strict": ("toon:gus", {"MB": 0.5, "HH": 12, "ELU": 0.0}, PLAIN),
    "toon_turned": ("toon:amara", {"HH": 20, "HV": -8, "HT": 6, "PLH": 15, "PRH": 15}, PLAIN),
    "toon_clear": ("toon:tok", "skeptical", Scene(size_px=SIZE, background=((0, 0, 0, 0), (0, 0, 0, 0)))),
    "toon_egg": ("toon:gus+egg", {"solid.turn": 45, "MB": 0.4}, PLAIN),
}


@pytest.mark.parametrize("name", CASES)
def test_picture_is_the_accepted_one(name):
    address, values, scene = CASES[name]
    face = mien.load_face(address)
    values = face.presets[values].values if isinstance(values, str) else values
    pixels = mien.draw(face, values, scene, threads=2).pixels
    accepted = HERE / "pictures" / f"{name}.png"
    before = np.asarray(Image.open(accepted).convert("RGBA")) if accepted.is_file() else np.zeros_like(pixels)
    if not np.array_equal(before, pixels):
        page = review(name, before, pixels)
        pytest.fail(f"{name}: {int((before != pixels).any(axis=2).sum())} pixels differ — look at {page}")


def review(name, before, after):
    place = HERE / "new"
    place.mkdir(exist_ok=True)
    apart = np.abs(before.astype(int) - after.astype(int))[..., :3]
    for kind, pixels in (
        ("new", after),
        ("difference", apart.astype(np.uint8)),
        ("magnified", np.minimum(apart * 8, 255).astype(np.uint8)),
    ):
        suffix = "" if kind == "new" else f".{kind}"
        Image.fromarray(pixels).save(place / f"{name}{suffix}.png")
    rows = "".join(
        f"<tr><td>{p.stem}<td><img src=../pictures/{p.name}><td><img src={p.name}>"
        f"<td><img src={p.stem}.difference.png><td><img src={p.stem}.magnified.png>"
        for p in sorted(place.glob("*.png"))
        if p.stem.count(".") == 0
    )
    page = place / "review.html"
    page.write_text(f"<table><tr><th>picture<th>accepted<th>new<th>difference<th>times eight{rows}</table>")
    return page
