"""Drawn faces as drawings, and back again."""

from collections import Counter
from pathlib import Path
from xml.etree import ElementTree

import pytest

from mien.faces.registry import load_face
from mien.faces.toon.reader import parse_toon
from mien.faces.toon.shipped import toons
from mien.faces.toon.toon import ToonFace
from mien.formats.svg_reader import read_svg
from mien.formats.toon_from_svg import toon_from_svg
from mien.formats.toon_to_svg import toon_to_svg

DRAWINGS = Path(__file__).parents[3] / "examples" / "drawings"
FACES = ("doodle", "grin", "mina", "robot", "sunny")
LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"


def again(tmp_path, face, pose=None):
    path = tmp_path / "again.svg"
    path.write_text(toon_to_svg(face, face.neutral if pose is None else pose), encoding="utf-8")
    return toon_from_svg(path, "again")


def guessed(name):
    document = toon_from_svg(DRAWINGS / f"{name}.svg", name)
    return ToonFace(parse_toon(document.to_text(), name), name)


def kinds(character):
    """How many polygons of each kind each feature has; lines of shut eyes and mouths show nothing in a drawing."""
    return Counter(
        (polygon.kind, polygon.feature or (polygon.stroke.feature if polygon.stroke else ""))
        for polygon in character.polygons
        if polygon.kind in ("hole", "pupil", "feature") and not polygon.fade and polygon.id != "mouth_shut"
    )


@pytest.mark.parametrize("name", FACES)
def test_a_guessed_face_comes_back_with_the_same_features(name, tmp_path):
    face = guessed(name)
    back = ToonFace(parse_toon(again(tmp_path, face).to_text(), name), name)
    wanted = kinds(face.character)
    if name == "robot":
        wanted["feature", "M"] += 1  # the line of the shut mouth is there: it lies on the open one
    assert kinds(back.character) == wanted
    for feature, there in face.character.features.items():
        for point, place in there.points.items():
            assert back.character.features[feature].points[point] == pytest.approx(place, abs=3.0), point


@pytest.mark.parametrize("name", [address for address, _ in toons().items()])
def test_every_shipped_face_can_be_drawn_on_and_read_again(name, tmp_path):
    face = load_face(name)
    character = parse_toon(again(tmp_path, face).to_text(), name)
    features = {feature for kind, feature in kinds(character) if kind in ("hole", "pupil")}
    assert {"ER", "EL", "PR", "PL", "M"} <= features
    for eye in ("ER", "EL"):
        for point, place in face.character.features[eye].points.items():
            assert character.features[eye].points[point] == pytest.approx(place, abs=12.0), point


def test_layers_are_named_and_curves_stay_curves(tmp_path):
    root = ElementTree.fromstring(toon_to_svg(guessed("mina"), guessed("mina").neutral))
    groups = [element.get(LABEL) for element in root if element.tag.endswith("}g")]
    assert {"head", "eye_right", "eye_left", "pupil_right", "brow_left", "mouth", "nose", "ear_right"} <= set(groups)
    ids = [element.get("id") for element in root.iter() if element.get("id")]
    assert len(ids) == len(set(ids))
    face = next(element for element in root.iter() if element.get("id") == "face")
    assert face.get("d").startswith("M200,98 C262,98 298,140 298,214 C")
    lash = next(element for element in root.iter() if element.get("id") == "lash_R")
    assert (lash.get("fill"), lash.get("stroke-width")) == ("none", "5.5")


def test_a_pose_is_drawn_as_it_is(tmp_path):
    face = guessed("sunny")
    pose = face.neutral.replace({"mouth.bottom": 1.0})
    path = tmp_path / "open.svg"
    path.write_text(toon_to_svg(face, pose), encoding="utf-8")
    shapes = {shape.names[-1]: shape for shape in read_svg(path).shapes}
    drawn = {item.name: item for item in face.shape(pose).paths}
    low = max(y for contour in shapes["mouth"].outline for segment in contour.segments for _, y in segment)
    assert low == pytest.approx(400.0 - drawn["mouth"].contours[0][:, 1].min(), abs=0.01)
    assert shapes["mouth_line"].color[:3] == pytest.approx((0x65 / 255, 0x47 / 255, 0x1B / 255))


def test_the_same_face_gives_the_same_text():
    face = guessed("robot")
    assert toon_to_svg(face, face.neutral) == toon_to_svg(face, face.neutral)
