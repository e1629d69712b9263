"""Drawings become characters: which shapes are which features, and that what comes out plays."""

from pathlib import Path

import numpy as np
import pytest

from mien.core import LoadError, MienError
from mien.faces.toon.checks import check_file
from mien.faces.toon.reader import parse_toon
from mien.faces.toon.toon import ToonFace
from mien.formats.toon_from_svg import toon_from_svg
from mien.formats.toon_from_svg_colors import Palette
from mien.formats.toon_from_svg_lenses import fit_lens, weight
from mien.formats.toon_from_svg_pieces import box_of

DRAWINGS = Path(__file__).parents[3] / "examples" / "drawings"
FACES = ("doodle", "grin", "mina", "robot", "sunny")

EMOJI = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 36 36"><circle cx="18" cy="18" r="17" fill="#fc4"/>{}</svg>'
)
EYES = '<ellipse cx="12" cy="14" rx="2" ry="3"/><ellipse cx="24" cy="14" rx="2" ry="3"/>'
MOUTH = '<path d="M11 24Q18 29 25 24" fill="none" stroke="#000"/>'


def guess(tmp_path, inside):
    path = tmp_path / "drawing.svg"
    path.write_text(EMOJI.format(inside), encoding="utf-8")
    return toon_from_svg(path, "someone")


def play(guessed):
    return ToonFace(parse_toon(guessed.to_text(), "guessed"), "guessed")


def roles(guessed):
    return {(part.role, part.side) for part in guessed.found.parts}


def box(face, name, **values):
    path = next(path for path in face.shape(face.neutral.replace(values)).paths if path.name == name)
    points = np.concatenate(path.contours)
    return (*points.min(axis=0), *points.max(axis=0))


@pytest.fixture(scope="module")
def faces():
    return {name: play(toon_from_svg(DRAWINGS / f"{name}.svg", name)) for name in FACES}


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("sunny", "face cheek:R cheek:L pupil:R pupil:L mouth_line"),
        ("grin", "face outline brow:R brow:L white:R white:L ring:R ring:L pupil:R pupil:L "
         "mouth teeth tongue mouth_ring"),
        ("doodle", "face  brow:R brow:L ring:R ring:L pupil:R pupil:L nose mouth_line"),
        ("robot", "body ear:R ear:L face brow:R brow:L white:R white:L pupil:R pupil:L nose mouth teeth"),
        (
            "mina",
            "hair body ear:R ear:L face cheek:R cheek:L white:R white:L pupil:R pupil:L "
            "lash:R lash:L brow:R brow:L nose lip",
        ),
    ],
)  # fmt: skip
def test_features_are_found_by_name_or_by_place(name, wanted):
    found = roles(toon_from_svg(DRAWINGS / f"{name}.svg", name))
    assert found - {("", "")} == {(role, side) for role, _, side in (word.partition(":") for word in wanted.split())}


@pytest.mark.parametrize("name", FACES)
def test_at_rest_a_face_is_as_it_was_drawn(name, faces):
    guessed = toon_from_svg(DRAWINGS / f"{name}.svg", name)
    height = faces[name].character.size[1]
    drawn = {path.name: np.concatenate(path.contours) for path in faces[name].shape(faces[name].neutral).paths}
    boxes = [box_of([(x, height - y) for x, y in points]) for points in drawn.values()]
    for part in guessed.found.parts:
        outer = part.piece.box.grown(part.piece.shape.width / 2.0)
        assert any(
            max(abs(a - b) for a, b in zip((each.left, each.top, each.right, each.bottom),
                                           (outer.left, outer.top, outer.right, outer.bottom), strict=True)) < 1.0
            for each in boxes
        ), part.role  # fmt: skip


@pytest.mark.parametrize("name", FACES)
def test_lids_meet_and_a_mouth_opens_and_shuts(name, faces):
    face = faces[name]
    moment = face.moment(face.neutral.replace({"eyelid.upper.right": 0.0}))
    assert moment.eye_opening("ER") == pytest.approx(0.0, abs=1e-6)
    low = [box(face, "mouth", **{"mouth.bottom": share})[1] for share in (0.0, 0.5, 1.0)]
    assert low[0] > low[1] > low[2]
    shut = face.moment(face.neutral.replace({"mouth.bottom": 0.0})).points
    gap = shut["MB"][1] - shut["MT"][1]
    assert gap < 0.1 * (shut["ML"][0] - shut["MR"][0])


def test_the_outline_of_an_eye_shuts_with_it(faces):
    def height(share):
        _, low, _, high = box(faces["grin"], "eye_R", **{"eyelid.upper.right": share})
        return high - low

    left, low, right, high = box(faces["grin"], "eye_R", **{"eyelid.upper.right": 0.0})
    assert height(1.0) > 60.0
    # What is left is the arc of the lower lid, without an area.
    path = next(
        path
        for path in faces["grin"].shape(faces["grin"].neutral.replace({"eyelid.upper.right": 0.0})).paths
        if path.name == "eye_R"
    )
    x, y = path.contours[0].T
    area = abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2.0
    assert area < 0.03 * (right - left) * 66.0
    assert high - low < 40.0


def test_pupils_look_where_they_are_told(faces):
    for face in faces.values():
        still, aside = (
            box(face, "pupil_R", **{"pupil.horizontal.right": angle, "pupil.vertical.right": angle})
            for angle in (0, 20)
        )
        assert aside[0] < still[0] - 1.0
        assert aside[1] > still[1] + 1.0


@pytest.mark.parametrize("name", FACES)
def test_every_preset_leaves_a_guessed_face_whole(name, faces):
    face = faces[name]
    for preset in face.presets.values():
        for path in face.shape(face.neutral.replace(dict(preset.values))).paths:
            assert all(np.isfinite(contour).all() for contour in path.contours)


def test_the_order_of_the_drawing_is_kept(faces):
    names = [path.name for path in faces["mina"].shape(faces["mina"].neutral).paths]
    wanted = ["hair", "ear_R", "face", "eye_R", "pupil_R", "lash_R", "brow_R", "nose", "mouth", "lip_upper", "hair_2"]
    assert [name for name in names if name in wanted] == wanted


def test_a_name_tells_the_feature_and_the_place_tells_the_side(tmp_path):
    named = (
        '<g id="eye-left"><circle cx="12" cy="14" r="3" fill="#fff"/><circle id="pupil" cx="12" cy="14" r="1"/></g>'
        '<g id="oeil_droit"><circle cx="24" cy="14" r="3" fill="#fff"/><circle id="pupille" cx="24" cy="14" r="1"/></g>'
        '<path id="Mund" d="M14 24h8v3h-8z"/>'
    )
    guessed = guess(tmp_path, named)
    assert [(part.role, part.side) for part in guessed.found.parts] == [
        ("face", ""), ("white", "R"), ("pupil", "R"), ("white", "L"), ("pupil", "L"), ("mouth", ""),
    ]  # fmt: skip
    assert guessed.rig.features["ER"]["points"]["ERO"][0] == pytest.approx(100.0, abs=0.5)


@pytest.mark.parametrize(
    ("inside", "wanted"),
    [
        ("", "no two shapes alike, left and right"),
        (MOUTH, "no two shapes alike, left and right"),
        (EYES, "eyes are there, but no shape or line in the middle below"),
        (EYES.split("/>")[0] + "/>" + MOUTH, "no two shapes alike"),
        ('<circle id="eye" cx="12" cy="14" r="2"/>' + MOUTH, "only one eye is named, line 1"),
    ],
)
def test_a_drawing_without_a_face_says_what_was_looked_for(tmp_path, inside, wanted):
    with pytest.raises(LoadError, match=f"no face is found: {wanted}.* name layers or ids after features"):
        guess(tmp_path, inside)


@pytest.mark.parametrize(
    "inside",
    [
        EYES + '<path id="teeth" d="M12 24h12v2h-12z"/>' + MOUTH,
        EYES.replace('rx="2"', 'id="eye" rx="0.001"') + MOUTH,
        '<path id="lash_1" d="M9 12q3-3 6 0" stroke="#000"/><path id="lash_2" d="M21 12q3-3 6 0" stroke="#000"/>'
        + MOUTH,
        EYES + MOUTH + '<circle id="ear" cx="1" cy="18" r="3"/>',
    ],
    ids=["teeth only", "eyes without size", "lashes only", "one ear"],
)
def test_odd_drawings_become_faces(tmp_path, inside):
    assert {"ER", "EL", "M"} <= set(play(guess(tmp_path, inside)).character.features)


def test_a_teapot_is_no_face():
    with pytest.raises(LoadError, match=r"teapot\.svg: no face is found"):
        toon_from_svg(DRAWINGS / "teapot.svg", "teapot")


def test_two_eyes_in_one_path_are_two(tmp_path):
    both = '<path d="M10 12h4v4h-4zM22 12h4v4h-4z"/>'
    assert {("pupil", "R"), ("pupil", "L")} <= roles(guess(tmp_path, both + MOUTH))


def test_eyes_drawn_as_arcs_turn_over_when_they_shut(tmp_path):
    arcs = '<path d="M9 15Q12 10 15 15M21 15Q24 10 27 15" fill="none" stroke="#000"/>'
    face = play(guess(tmp_path, arcs + MOUTH))
    _, low, _, high = box(face, "eye_R")
    _, shut_low, _, shut_high = box(face, "eye_R", **{"eyelid.upper.right": 0.0})
    assert shut_high < high - 5.0
    assert shut_low < low


def test_filled_arcs_are_eyes_that_smile(tmp_path):
    arcs = '<path d="M9 15C9 9 15 9 15 15H14C14 10.5 10 10.5 10 15ZM21 15C21 9 27 9 27 15H26C26 10.5 22 10.5 22 15Z"/>'
    assert {("arc", "R"), ("arc", "L")} <= roles(guess(tmp_path, arcs + MOUTH))


def test_a_muzzle_around_a_line_is_no_mouth(tmp_path):
    muzzle = '<ellipse cx="18" cy="25" rx="8" ry="6" fill="#fffaf0"/><path d="M17 20h2l-1 1.5z" fill="#e06a7a"/>'
    line = '<path d="M13 25Q18 29 23 25" fill="none" stroke="#400"/>'
    parts = {part.role: part.piece for part in guess(tmp_path, EYES + muzzle + line).found.parts}
    assert parts["mouth_line"].stroked
    assert parts["nose"].box.width < 40.0


def test_lips_around_an_opening_go_along_with_it(tmp_path):
    lips = '<path d="M10 22h16q-1 8-8 8t-8-8z" fill="#c33"/><path d="M11 23h14q-1 6-7 6t-7-6z" fill="#400"/>'
    face = play(guess(tmp_path, EYES + lips))
    low = [box(face, "mouth_rim", **{"mouth.bottom": share})[1] for share in (0.0, 1.0)]
    assert low[0] - low[1] > 50.0


def test_a_shape_is_clipped_by_the_one_that_is_there_or_by_one_that_is_not_seen(tmp_path):
    clips = (
        '<clipPath id="a"><circle cx="18" cy="18" r="17"/></clipPath><clipPath id="b"><path d="M4 4h9v9z"/></clipPath>'
    )
    shade = '<path id="shade" d="M18 0h18v36H18z" fill="#e80" clip-path="url(#a)"/>'
    patch = '<path id="patch" d="M0 0h18v9H0z" fill="#a50" clip-path="url(#b)"/>'
    guessed = guess(tmp_path, clips + shade + patch + EYES + MOUTH)
    polygons = {polygon["id"]: polygon for polygon in guessed.document["polygons"]}
    assert polygons["shade"]["clip"] == ["face"]
    assert polygons["patch"]["clip"] == ["clip"]
    assert polygons["clip"]["opacity"] == 0
    assert play(guessed).shape(play(guessed).neutral).paths[1].inside


def test_the_canvas_has_the_usual_size_and_a_background_is_one(tmp_path):
    guessed = guess(tmp_path, EYES + MOUTH)
    assert guessed.document["size"] == [400.0, 400.0]
    robot = toon_from_svg(DRAWINGS / "robot.svg", "robot").document
    assert robot["palette"][robot["background"]] == "#DDE7F2"
    assert all(polygon["id"] != "bg" for polygon in robot["polygons"])


def test_the_same_drawing_gives_the_same_bytes():
    once, again = (toon_from_svg(DRAWINGS / "mina.svg", "mina").to_text() for _ in range(2))
    assert once == again


def test_a_coarser_tolerance_gives_fewer_points(tmp_path):
    path = tmp_path / "traced.svg"
    jagged = (
        "M12 24"
        + "".join(f"L{12 + number / 50:.2f} {24 + 0.02 * (number % 2):.2f}" for number in range(600))
        + "V27H12Z"
    )
    path.write_text(EMOJI.format(EYES + f'<path d="{jagged}"/>'))
    fine, coarse = (len(toon_from_svg(path, "traced", tolerance).to_text()) for tolerance in (0.01, 2.0))
    assert coarse < 0.6 * fine
    with pytest.raises(MienError, match="tolerance 0 is out of range"):
        toon_from_svg(path, "traced", 0.0)


def test_a_lens_fits_an_ellipse_and_a_box():
    turn = np.linspace(0.0, 2.0 * np.pi, 200, endpoint=False)
    lens = fit_lens([list(zip(30 * np.cos(turn), 20 * np.sin(turn), strict=True))], closed=True)
    assert (lens.left, lens.bottom) == (pytest.approx((-30, 0), abs=0.5), pytest.approx((0, 20), abs=0.1))
    assert lens.profile == (2.0, 2.0)
    square = fit_lens([[(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]], closed=True)
    assert weight(square.profile, 0.75) > 0.95


def test_colours_that_look_alike_share_a_name():
    palette = Palette()
    assert palette.add((1.0, 0.8, 0.3, 1.0), "face") == "skin"
    assert palette.add((1.0, 0.81, 0.3, 0.5), "hair") == "skin"
    assert palette.add((0.88, 0.23, 0.23, 1.0)) == "red"
    assert palette.add((0.88, 0.13, 0.23, 1.0)) == "red2"
    assert palette.codes()["skin"] == "#FFCC4C"


@pytest.mark.parametrize("name", FACES)
def test_a_guessed_face_has_no_faults(name, tmp_path):
    path = tmp_path / f"{name}.toon.json"
    path.write_text(toon_from_svg(DRAWINGS / f"{name}.svg", name).to_text(), encoding="utf-8")
    assert check_file(path).faults == ()
