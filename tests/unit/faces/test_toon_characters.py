"""The characters that ship: their motors all do something, mouths and eyes shut, nothing tears or flies off."""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import cache
from importlib import resources
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from mien import load_face
from mien.core import Drawing, Path, Pose
from mien.faces.toon.motors import motors, paper_codes
from mien.faces.toon.presets import share_at
from mien.faces.toon.records import STEPS
from mien.faces.toon.shipped import toon_names
from mien.faces.toon.toon import ToonFace

Floats = NDArray[np.float64]

NAMES = ("agat", "amara", "bau", "gus", "miso", "olav", "pip", "tok")
STRICT = ("gus",)
EXTENDED = tuple(name for name in NAMES if name not in STRICT)
PAPER_KEYS = {"id", "kind", "fill", "feature", "motor", "path", "min", "max"}
CORNERS = ("MRH", "MRV", "MLH", "MLV")


@cache
def toon(name: str) -> ToonFace:
    face = load_face(f"toon:{name}")
    assert isinstance(face, ToonFace)
    return face


def document(name: str) -> dict[str, Any]:
    return dict(json.loads(text(name)))


def text(name: str) -> str:
    folder = resources.files("mien.faces.toon").joinpath("data", "characters")
    return folder.joinpath(f"{name}.toon.json").read_text(encoding="utf-8")


def pose(face: ToonFace, **activations: float) -> Pose:
    """A pose of activations by code: 1 at a motor's maximum, -1 at its minimum."""
    known = {code: amount for code, amount in activations.items() if code in face.character.motors}
    return face.neutral.replace(
        {motors()[code].parameter: share_at(code, face.character, amount) for code, amount in known.items()}
    )


def random_poses(face: ToonFace, count: int, seed: int) -> Iterator[Pose]:
    """Half of the motors anywhere, half of them at a limit."""
    generator = np.random.default_rng(seed)
    codes = list(face.character.motors)
    for _ in range(count):
        amounts = generator.uniform(-1.0, 1.0, len(codes))
        ends = generator.uniform(size=len(codes)) < 0.5
        amounts[ends] = np.sign(amounts[ends])
        yield pose(face, **dict(zip(codes, amounts.tolist(), strict=True)))


def paths(drawing: Drawing) -> dict[str, Path]:
    return {path.name: path for path in drawing.paths}


def area(path: Path) -> float:
    return sum(abs(float(np.dot(c[:, 0], np.roll(c[:, 1], -1)) - np.dot(c[:, 1], np.roll(c[:, 0], -1)))) / 2.0
               for c in path.contours)  # fmt: skip


def middle(path: Path) -> Floats:
    stacked = np.concatenate(path.contours)
    return np.asarray((stacked.min(axis=0) + stacked.max(axis=0)) / 2.0)


def is_inside(points: Floats, path: Path) -> NDArray[np.bool_]:
    """Which points lie in a path, by crossings of a ray."""
    inside = np.zeros(len(points), dtype=bool)
    for contour in path.contours:
        for (x0, y0), (x1, y1) in zip(contour, np.roll(contour, -1, axis=0), strict=True):
            if y0 != y1:
                crosses = (y0 > points[:, 1]) != (y1 > points[:, 1])
                inside ^= crosses & (points[:, 0] < x0 + (points[:, 1] - y0) * (x1 - x0) / (y1 - y0))
    return inside


def apart(one: Path, other: Path) -> float:
    """The largest distance of a vertex of either from the nearest of the other."""
    a, b = np.concatenate(one.contours), np.concatenate(other.contours)
    distances = np.hypot(*(a[:, None] - b[None]).transpose(2, 0, 1))
    return float(max(distances.min(axis=0).max(), distances.min(axis=1).max()))


def test_they_are_these() -> None:
    assert toon_names() == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_files_are_small_and_a_polygon_is_a_line(name: str) -> None:
    assert len(text(name)) < 40_000
    lines = text(name).splitlines()
    assert sum(line.lstrip().startswith('{"id": ') for line in lines) == len(document(name)["polygons"])
    assert document(name)["license"] == "CC0-1.0"
    assert document(name)["doc"]


@pytest.mark.parametrize("name", NAMES)
def test_all_motors_of_the_paper_are_there_and_move_something(name: str) -> None:
    face = toon(name)
    assert set(paper_codes()) <= set(face.character.motors)
    still = []
    for code, limits in face.character.motors.items():
        base = {"MB": 0.6} if code == "TG" else {}
        rest = face.shape(pose(face, **base))
        for end in (-1.0, 1.0):
            if code in ("TG", "HY", "HI", "HM", "HO", "HP", "MT", "MB") and end < 0.0:
                continue  # rest is their minimum
            if (
                motors()[code].unit == "share"
                and not (limits.low if end < 0.0 else limits.high)
                and motors()[code].point
            ):
                continue
            moved = face.shape(pose(face, **base, **{code: end}))
            far = max(float(np.abs(b - a).max()) for one, other in zip(rest.paths, moved.paths, strict=True)
                      for a, b in zip(one.contours, other.contours, strict=True))  # fmt: skip
            if far < 0.9:
                still.append((code, end, far))
    assert still == []


@pytest.mark.parametrize("name", NAMES)
def test_a_mouth_shuts_whatever_its_corners_do(name: str) -> None:
    face = toon(name)
    generator = np.random.default_rng(3)
    for _ in range(12):
        corners = {code: float(generator.choice([-1.0, 0.0, 1.0])) for code in CORNERS}
        shut = pose(face, MB=-1.0, MT=-1.0, **corners).replace({"mouth.bottom": 0.0})
        mouth = paths(face.shape(shut))["mouth"]
        assert area(mouth) < (2.0 if name in STRICT else 1e-6), corners
        (contour,) = mouth.contours
        top, bottom = (contour[: len(contour) // 2], contour[len(contour) // 2 :]) if name not in STRICT else (
            contour[:5], np.concatenate([contour[4:], contour[:1]]))  # fmt: skip
        assert float(np.abs(top - bottom[::-1]).max()) < 0.2, corners


@pytest.mark.parametrize("name", EXTENDED)
def test_lips_never_cross(name: str) -> None:
    face = toon(name)
    still = {"HH": 0.0, "HV": 0.0, "HT": 0.0}
    for any_pose in random_poses(face, 40, 23):
        mouth = paths(face.shape(any_pose.replace({motors()[code].parameter: at for code, at in still.items()})))[
            "mouth"
        ]
        (contour,) = mouth.contours
        top, bottom = contour[: len(contour) // 2], contour[len(contour) // 2 :][::-1]
        assert (top[:, 1] >= bottom[:, 1] - 1e-9).all()
        assert (np.diff(top[:, 0]) > 0.0).all()


@pytest.mark.parametrize("name", NAMES)
def test_a_mouth_opens(name: str) -> None:
    face = toon(name)
    opening = [area(paths(face.shape(pose(face, MB=amount)))["mouth"]) for amount in (0.0, 0.3, 0.6, 1.0)]
    assert opening == sorted(opening)
    assert opening[-1] > 500.0


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("lower", [-1.0, 0.0, 1.0])
def test_shut_lids_cover_the_eyes_whatever_the_lower_lids_do(name: str, lower: float) -> None:
    face = toon(name)
    shut = paths(face.shape(pose(face, ERU=-1.0, ELU=-1.0, ERL=lower, ELL=lower, PRV=1.0, PLV=-1.0)))
    for side in "RL":
        eye = shut[f"eye_{side}"]
        if name in STRICT:
            (outline,) = eye.contours
            grid = middle(eye) + 0.97 * (outline - middle(eye))
            assert is_inside(grid, shut[f"lid_{side}"]).all()
        else:
            assert area(eye) < 1.0


@pytest.mark.parametrize("name", NAMES)
def test_pupils_stay_in_their_eyes(name: str) -> None:
    face = toon(name)
    for across in (-1.0, 0.0, 1.0):
        for up in (-1.0, 0.0, 1.0):
            drawn = paths(face.shape(pose(face, PRH=across, PLH=across, PRV=up, PLV=up)))
            for side in "RL":
                pupil, eye = drawn[f"pupil_{side}"], drawn[f"eye_{side}"]
                assert is_inside(middle(pupil)[None], eye).all(), (across, up)
                cut = [region.contours for region in pupil.inside]
                assert name in STRICT or any(contours is eye.contours for contours in cut)
                assert name not in STRICT or is_inside(np.concatenate(pupil.contours), eye).all(), (across, up)


@pytest.mark.parametrize("name", NAMES)
def test_nothing_tears_or_flies_off(name: str) -> None:
    face = toon(name)
    width, height = face.character.size
    rest = face.shape(face.neutral)
    sizes = [[len(contour) for contour in path.contours] for path in rest.paths]
    for number, any_pose in enumerate(random_poses(face, 60, 17)):
        drawn = face.shape(any_pose)
        assert [[len(contour) for contour in path.contours] for path in drawn.paths] == sizes
        for path in drawn.paths:
            points = np.concatenate(path.contours)
            assert np.isfinite(points).all(), (number, path.name)
            assert (np.abs(points - [width / 2, height / 2]) < [width * 1.2, height * 1.2]).all(), (number, path.name)


@pytest.mark.parametrize("name", NAMES)
def test_what_is_a_mirror_image_at_rest_is_one_in_mirrored_poses(name: str) -> None:
    face = toon(name)
    width = face.character.size[0]

    def mirror(path: Path) -> Path:
        return Path(path.name, tuple(c * [-1.0, 1.0] + [width, 0.0] for c in path.contours), path.color)

    rest = paths(face.shape(face.neutral))
    pairs = [(one, f"{one[:-1]}L") for one in rest if one.endswith("_R") and f"{one[:-1]}L" in rest] + [("mouth",) * 2]
    pairs = [(one, other) for one, other in pairs if apart(mirror(rest[one]), rest[other]) < 0.5]
    assert len(pairs) >= (1 if name == "bau" else 4)
    for any_pose in random_poses(face, 6, 5):
        drawn, mirrored = (paths(face.shape(each)) for each in (any_pose, any_pose.mirrored()))
        for one, other in pairs:
            assert apart(mirror(drawn[one]), mirrored[other]) < 1.0, (one, other)


@pytest.mark.parametrize("name", EXTENDED)
def test_proportions_at_both_ends_leave_pupils_in_eyes(name: str) -> None:
    face = toon(name)
    limits = face.character.proportions
    assert limits
    for side in (0, 1):
        drawn = paths(face.shape(face.neutral.replace({each: ends[side] for each, ends in limits.items()})))
        for eye in "RL":
            assert is_inside(middle(drawn[f"pupil_{eye}"])[None], drawn[f"eye_{eye}"]).all()


@pytest.mark.parametrize("name", EXTENDED)
def test_palettes_are_other_moods_of_the_whole(name: str) -> None:
    palette, variants = toon(name).character.palette, toon(name).character.palettes
    assert 2 <= len(variants) <= 4
    for variant in variants.values():
        assert sum(variant.get(entry, color) != color for entry, color in palette.items()) > len(palette) / 2


@pytest.mark.parametrize("name", STRICT)
def test_a_strict_face_has_the_papers_rules_alone(name: str) -> None:
    file = document(name)
    assert file["mode"] == "strict"
    assert not {"palettes", "parts", "proportions"} & file.keys()
    assert set(file["motors"]) == set(paper_codes())
    assert all(set(polygon) <= PAPER_KEYS for polygon in file["polygons"])
    assert all(set(feature) == {"points"} for feature in file["features"].values())


@pytest.mark.parametrize("name", STRICT)
def test_a_strict_face_is_drawn_in_six_steps_and_cut_by_its_holes(name: str) -> None:
    face = toon(name)
    kinds = {polygon.id: polygon.kind for polygon in face.character.polygons}
    drawing = face.shape(face.neutral)
    steps = [STEPS.index(kinds[path.name]) for path in drawing.paths]
    assert steps == sorted(steps)
    assert set(steps) == set(range(6))
    holes = [path.name for path in drawing.paths if kinds[path.name] == "hole"]
    for path in drawing.paths:
        assert len(path.outside) == (len(holes) if kinds[path.name] == "face" else 0)
        assert path.inside == ()
        assert path.rule == "evenodd"


@pytest.mark.parametrize("name", ["sad", "worried", "pout"])
def test_the_mouth_of_a_cat_that_is_unhappy_hangs_at_its_corners(name: str) -> None:
    """Its two arcs hang too: only corners below the depth of the arcs do not look like a smile."""
    character = toon("miso").character
    values = toon("miso").presets[name].values
    deepest = max(depth for _, depth in character.features["M"].shape)
    for code in ("MRV", "MLV"):
        limits = character.motors[code]
        share = values[motors()[code].parameter]
        assert limits.low + share * (limits.high - limits.low) < -deepest
