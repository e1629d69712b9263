"""Drawn faces on an egg and a box: known answers, what is hidden, and that rest is as it was drawn."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from mien import load_face
from mien.core import Drawing, MienError, Scene, UnknownNameError
from mien.faces.toon.polygons import Contours
from mien.faces.toon.shipped import toon_names
from mien.faces.toon.solid import SOLIDS, OnSolid
from mien.faces.toon.solid_box import Box
from mien.faces.toon.solid_egg import Egg
from mien.faces.toon.solid_form import area
from mien.faces.toon.solid_motion import Motion
from mien.faces.toon.solid_rim import COUNT, INSIDE, directions, measure_reach, place_around, reach
from mien.render import draw

BALL = np.full(COUNT, 100.0)


def turned(turn: float, nod: float = 0.0, tilt: float = 0.0) -> Motion:
    return Motion.of(turn, nod, tilt, (0.0, 0.0))


def circle(x: float, y: float, radius: float, count: int = 120) -> np.ndarray:
    angle = np.arange(count) * (2.0 * np.pi / count)
    return np.stack([x + radius * np.cos(angle), y + radius * np.sin(angle)], axis=1)


def solids(name: str) -> list[OnSolid]:
    faces = [load_face(f"toon:{name}+{solid}") for solid in SOLIDS]
    return [face for face in faces if isinstance(face, OnSolid)]


def inside(contours: Contours | list[np.ndarray], x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Which points (P,) lie where contours run around, in sum."""
    rounds = np.zeros(len(x), dtype=np.int64)
    for contour in contours:
        a, b = (contour[:, axis] - at[:, None] for axis, at in enumerate((x, y)))
        next_a, next_b = np.roll(a, -1, axis=1), np.roll(b, -1, axis=1)
        left = a * next_b - next_a * b
        rounds += ((b <= 0.0) & (next_b > 0.0) & (left > 0.0)).sum(axis=1)
        rounds -= ((b > 0.0) & (next_b <= 0.0) & (left < 0.0)).sum(axis=1)
    return rounds != 0


def contours_of(drawing: Drawing, name: str) -> Contours:
    return tuple(contour for path in drawing.paths if path.name == name for contour in path.contours)


@pytest.mark.parametrize("name", toon_names())
def test_at_rest_it_is_the_flat_drawing(name: str) -> None:
    flat = load_face(f"toon:{name}")
    wanted = flat.shape(flat.neutral)
    for face in solids(name):
        drawing = face.shape(face.neutral)
        assert drawing.background == wanted.background
        for path, other in zip(drawing.paths, wanted.paths, strict=True):
            assert (path.name, path.color, path.rule) == (other.name, other.color, other.rule)
            assert all(np.array_equal(a, b) for a, b in zip(path.contours, other.contours, strict=True))


@pytest.mark.parametrize("name", toon_names())
def test_it_hardly_changes_by_a_hundredth_of_a_degree(name: str) -> None:
    points = np.random.default_rng(4).uniform(0.0, 440.0, (2, 400))
    for face in solids(name):
        rest, moved = (face.shape(face.neutral.replace({"solid.turn": angle})) for angle in (0.0, 0.01))
        for path in rest.paths:
            here, there = (inside(contours_of(drawing, path.name), *points) for drawing in (rest, moved))
            assert (here != there).mean() < 0.01


def test_a_point_of_the_ball_goes_where_the_rotation_takes_it() -> None:
    # (60, 0) lies 80 before the middle of a ball of radius 100; 30 degrees to the own left, the right as seen.
    square = circle(60.0, 0.0, 0.01)
    (seen,) = Egg(BALL, turned(30.0)).carry([[square]])[0]
    assert seen.mean(axis=0) == pytest.approx((60.0 * math.cos(math.pi / 6) + 40.0, 0.0), abs=1e-3)
    (seen,) = Egg(BALL, turned(0.0, 30.0)).carry([[circle(0.0, 60.0, 0.01)]])[0]
    assert seen.mean(axis=0) == pytest.approx((0.0, 60.0 * math.cos(math.pi / 6) + 40.0), abs=1e-3)
    (seen,) = Egg(BALL, turned(0.0, 0.0, 90.0)).carry([[circle(0.0, 60.0, 0.01)]])[0]
    assert seen.mean(axis=0) == pytest.approx((60.0, 0.0), abs=1e-3)
    # (-60, 0), 53.1 degrees from the side of the ball, goes out of sight by more than that.
    assert Egg(BALL, turned(-53.0)).carry([[circle(-60.0, 0.0, 0.01)]])[0] != []
    assert Egg(BALL, turned(-53.3)).carry([[circle(-60.0, 0.0, 0.01)]])[0] == []


def test_the_senses_are_those_of_the_modelled_head() -> None:
    head = load_face("head").unsubdivided
    rest = head.shape(head.neutral).points
    nose = int(np.argmax(rest[:, 2]))
    for name, axis in (("head.turn", 0), ("head.nod", 1)):
        moved = head.shape(head.neutral.replace({name: 10.0})).points
        place = turned(*((10.0, 0.0) if axis == 0 else (0.0, 10.0))).apply(np.array([[0.0, 0.0, 1.0]]))[0]
        assert np.sign(moved[nose, axis] - rest[nose, axis]) == np.sign(place[axis]) == 1.0


@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize(
    "angles",
    [(35.0, 0.0), (60.0, 20.0), (90.0, 0.0), (-90.0, 0.0), (120.0, -30.0), (180.0, 0.0), (0.0, 90.0), (10.0, 179.0)],
)
@pytest.mark.parametrize("outline", [(0.0, 0.0, 100.0), (40.0, 10.0, 50.0), (-60.0, -20.0, 45.0), (5.0, 3.0, 20.0)])
def test_what_is_seen_is_what_rays_hit(
    outline: tuple[float, float, float], angles: tuple[float, float], back: bool
) -> None:
    motion = turned(*angles)
    drawn = circle(*outline)
    seen = Egg(BALL, motion).carry([[drawn]], back=back)[0]
    random = np.random.default_rng(3)
    x, y = random.uniform(-97.0, 97.0, (2, 1500))
    ahead = np.sqrt(np.maximum(100.0**2 - x * x - y * y, 0.0))
    on_ball = x * x + y * y < 97.0**2
    # Back from the picture to the drawing: the transpose of the rotation.
    right, up, forward = np.array(motion.rows).T @ np.stack([x, y, ahead])
    wanted = inside([drawn], right, up) & ((forward < 0.0) == back)
    got = inside(seen, x, y)
    wrong = (got != wanted) & on_ball
    # Near outlines the corners of polygons, and the rim's margin of 3 %, may tell otherwise.
    assert wrong.mean() < 0.035


def test_the_whole_ball_is_filled_from_everywhere_when_the_drawing_goes_around() -> None:
    for angles in [(0.1, 0.0), (45.0, 10.0), (90.0, 0.0), (135.0, 60.0), (180.0, 0.0), (-91.0, -89.0)]:
        egg = Egg(BALL * INSIDE, turned(*angles))
        seen = [*egg.carry([[circle(0.0, 0.0, 100.0)]])[0], *egg.carry([[circle(0.0, 0.0, 100.0)]], back=True)[0]]
        assert sum(area(contour) for contour in seen) == pytest.approx(math.pi * 100.0**2, rel=0.07)


def test_a_tall_egg_is_seen_as_a_tall_ellipsoid() -> None:
    # Half axes 100, 200, 100: nodded by 30 degrees it is sqrt((200 cos 30)^2 + (100 sin 30)^2) high.
    ways = directions()
    tall = 1.0 / np.sqrt((ways[:, 0] / 100.0) ** 2 + (ways[:, 1] / 200.0) ** 2)
    outline = Egg(tall * INSIDE, turned(0.0, 30.0)).outline
    assert outline[:, 1].max() == pytest.approx(math.sqrt(3.0e4 + 2.5e3), rel=0.03)
    assert outline[:, 0].max() == pytest.approx(100.0, rel=0.03)


def test_reach_is_where_one_leaves_the_polygons() -> None:
    ways = directions()
    np.testing.assert_allclose(place_around(ways), np.arange(COUNT), atol=1e-9)
    # Beyond a gap there is more, which does not count.
    ring = [circle(0.0, 0.0, 50.0, 400), circle(200.0, 0.0, 30.0)]
    radii = measure_reach([ring[:1], ring[1:]], 3)
    np.testing.assert_allclose(radii, 50.0 * INSIDE, rtol=1e-3)
    np.testing.assert_allclose(reach(radii, ways * 7.0), radii, rtol=1e-12)


def test_a_narrow_spike_does_not_count() -> None:
    spike = np.array([[-2.0, 30.0], [0.0, 120.0], [2.0, 30.0]])
    radii = measure_reach([[circle(0.0, 0.0, 50.0, 400)], [spike]], 3)
    assert radii[COUNT // 4] == pytest.approx(50.0 * INSIDE, rel=1e-3)


def test_a_box_has_a_front_and_walls() -> None:
    square = np.array([[-10.0, -10.0], [10.0, -10.0], [10.0, 10.0], [-10.0, 10.0]])
    edges = [np.full(4, True)]
    box = Box(20.0, turned(30.0))
    (front,) = box.plate([square])
    np.testing.assert_allclose(front[:, 0], square[:, 0] * math.cos(math.pi / 6) + 10.0, atol=1e-9)
    (wall,) = box.walls([square], edges)
    assert abs(area(wall)) == pytest.approx(20.0 * 40.0 / 2.0)  # The left wall, 40 deep, seen at half its depth.
    assert wall[:, 0].max() == pytest.approx(front[:, 0].min())
    assert Box(20.0, turned(90.0)).walls([square], edges)
    assert Box(20.0, turned(30.0)).walls([square], [np.full(4, False)]) == []
    assert len(Box(20.0, turned(30.0, 30.0)).walls([square], edges)) == 1  # Left and bottom wall, in one piece.
    assert turned(150.0).shows_front is False


@pytest.mark.parametrize("name", toon_names())
def test_nothing_of_the_face_is_seen_from_behind(name: str) -> None:
    for face in solids(name):
        for angle in (150.0, -150.0, 180.0):
            drawing = face.shape(face.neutral.replace({"solid.turn": angle}))
            shown = {path.name for path in drawing.paths if path.contours}
            assert not shown & {"pupil_R", "pupil_L", "eye_R", "eye_L", "mouth", "nose", "glint_R"}


@pytest.mark.parametrize("name", toon_names())
def test_the_far_eye_is_cut_at_the_horizon(name: str) -> None:
    face = solids(name)[0]
    head = np.concatenate([c for path in face.shape(face.neutral).paths for c in path.contours if path.name != "coat"])
    for angle in (60.0, 75.0):
        drawing = face.shape(face.neutral.replace({"solid.turn": angle}))
        far = [contour for eye in ("eye_L", "pupil_L") for contour in contours_of(drawing, eye)]
        assert all(np.isfinite(contour).all() and len(contour) >= 3 for contour in far)
        assert all((contour >= head.min(axis=0) - 1.0).all() for contour in far)
        near, gone = (sum(abs(area(c)) for c in contours_of(drawing, eye)) for eye in ("eye_R", "eye_L"))
        assert gone < near


@pytest.mark.parametrize("name", toon_names())
def test_any_pose_from_any_side_is_a_drawing(name: str) -> None:
    random = np.random.default_rng(5)
    for face in solids(name):
        table = face.parameters
        for _ in range(3):
            values = random.uniform(table.lows, table.highs)
            drawing = face.shape(face.neutral.replace(dict(zip(table.names, values, strict=True))))
            again = face.shape(face.neutral.replace(dict(zip(table.names, values, strict=True))))
            assert sum(bool(path.contours) for path in drawing.paths) >= 1
            for path, other in zip(drawing.paths, again.paths, strict=True):
                assert all(np.array_equal(a, b) for a, b in zip(path.contours, other.contours, strict=True))
                assert all(np.abs(contour).max() < 3000.0 for contour in path.contours)


@pytest.mark.parametrize("name", ["toon:agat+egg", "toon:olav+egg"])
def test_nothing_flashes_while_it_turns(name: str) -> None:
    face = load_face(name)
    scene = Scene(size_px=(60, 66))
    angles = [*range(-180, 181, 6)]
    pictures = [draw(face, face.neutral.replace({"solid.turn": float(turn)}), scene).astype(float) for turn in angles]
    steps = np.array([np.abs(one - other).mean() for one, other in pairwise(pictures)])
    around = np.array([steps[max(0, number - 3) : number + 4].mean() for number in range(len(steps))])
    assert (steps < 2.5 * around).all()


def test_motors_of_the_head_turn_the_body() -> None:
    face = solids("olav")[0]
    motor = face.shape(face.neutral.replace({"head.horizontal": -20.0, "head.vertical": 5.0}))
    angle = face.shape(face.neutral.replace({"solid.turn": 20.0, "solid.nod": 5.0}))
    for path, other in zip(motor.paths, angle.paths, strict=True):
        assert all(np.array_equal(a, b) for a, b in zip(path.contours, other.contours, strict=True))


def test_the_body_stays() -> None:
    face = solids("olav")[0]
    rest, moved = (face.shape(face.neutral.replace({"solid.turn": angle})) for angle in (0.0, 80.0))
    # Its edges are cut more finely, so it is the extent that is compared.
    here, there = (np.concatenate(contours_of(drawing, "coat")) for drawing in (rest, moved))
    np.testing.assert_allclose(there.min(axis=0), here.min(axis=0), atol=1e-9)
    np.testing.assert_allclose(there.max(axis=0), here.max(axis=0), atol=1e-9)


def test_addresses() -> None:
    assert load_face("toon:olav+egg").name == "toon:olav+egg"
    with pytest.raises(UnknownNameError, match="egg"):
        load_face("toon:olav+eggs")
    with pytest.raises(UnknownNameError, match="olav"):
        load_face("toon:olaf+egg")
    with pytest.raises(MienError):
        load_face("head+egg")
