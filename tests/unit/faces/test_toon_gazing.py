"""Gaze as it appears to the viewer: known answers, signs, and that compensating is the inverse of what is seen."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mien import load_face
from mien.faces.toon.gazing import (
    HALF_WIDTH_M,
    MOST_CURVED,
    Seen,
    compensate,
    screen_depth,
    viewer_angles,
    what_is_seen,
)
from mien.faces.toon.motors import motors
from mien.faces.toon.shipped import toon_names
from mien.faces.toon.toon import ToonFace

AHEAD = (0.0, 0.0, 1.0)
PLAIN = Seen(placement=1.0, roundness=1.0, eye_gain=1.5, head_gain=1.3)


def drawn(name: str = "olav") -> ToonFace:
    face = load_face(f"toon:{name}")
    assert isinstance(face, ToonFace)
    return face


def shares_of(face: ToonFace, **changes: float) -> dict[str, float]:
    pose = face.neutral
    return {code: pose[motors()[code].parameter] for code in face.character.motors} | changes


def test_eyes_seem_to_turn_half_as_far_again() -> None:
    assert PLAIN.gaze_deg(10.0, 0.0) == pytest.approx(15.0)
    assert PLAIN.pupil_deg(15.0, 0.0) == pytest.approx(10.0)


def test_the_same_eyes_follow_the_head_and_eyes_that_meet_ours_seem_to_look_past() -> None:
    # Wollaston: the same eyes in a head turned to the left seem to look to the left.
    assert PLAIN.gaze_deg(0.0, 20.0) > PLAIN.gaze_deg(0.0, 0.0)
    # Overshoot: eyes turned back by as much as the head is turned seem to look to its other side.
    assert PLAIN.gaze_deg(-20.0, 20.0) == pytest.approx(-4.0)


def test_a_flat_screen_shows_all_viewers_the_same_gaze_and_a_round_one_none() -> None:
    assert screen_depth(0.0) == 0.0
    assert screen_depth(MOST_CURVED) == pytest.approx(1.0)
    assert screen_depth(-MOST_CURVED) == pytest.approx(-1.0)
    # A tube of radius 0.6 m: an arc of half width 0.09 m rises by 0.6 - sqrt(0.6^2 - 0.09^2) m.
    rise = 0.6 - math.sqrt(0.6**2 - HALF_WIDTH_M**2)
    assert screen_depth(1.0 / 0.6) == pytest.approx(rise / HALF_WIDTH_M)
    assert PLAIN.gaze_deg(0.0, 0.0, 30.0, 0.0) == 0.0
    assert PLAIN.gaze_deg(0.0, 0.0, 30.0, 1.0) == -30.0


def test_viewers_are_seen_under_angles_in_the_senses_of_the_motors() -> None:
    # The own left is the right of the picture, where angles are negative.
    assert viewer_angles(1.0, 0.0, 1.0) == pytest.approx((-45.0, 0.0))
    assert viewer_angles(0.0, 0.5, 0.5) == pytest.approx((0.0, 45.0))
    assert viewer_angles(*AHEAD) == (0.0, 0.0)


@pytest.mark.parametrize("name", toon_names())
def test_compensated_eyes_and_head_seem_to_look_where_they_should(name: str) -> None:
    face = drawn(name)
    seen = what_is_seen(face.character)
    given = shares_of(face, PRH=4.0, PLH=4.0, PRV=-3.0, PLV=-3.0, HH=3.0, HV=-2.0)
    viewer, curvature = (0.05, -0.04, 1.0), 3.0
    changed = compensate(given, face.character, seen, 1.0, viewer, curvature)
    depth = screen_depth(curvature)
    for axis, angle, head, pupils in zip(
        seen, viewer_angles(*viewer), ("HH", "HV"), (("PRH", "PLH"), ("PRV", "PLV")), strict=True
    ):
        wanted = given[head] - angle
        assert axis.facing_deg(changed[head], angle, depth) == pytest.approx(wanted, abs=1e-9)
        for pupil in pupils:
            gaze = axis.gaze_deg(changed[pupil], changed[head], angle, depth)
            assert gaze == pytest.approx(given[pupil] + wanted, abs=1e-9)
    assert {code for code in given if changed[code] != given[code]} == {"HH", "HV", "PRH", "PLH", "PRV", "PLV"}


def test_half_the_amount_goes_half_the_way() -> None:
    face = drawn()
    seen = what_is_seen(face.character)
    given = shares_of(face, PRH=12.0)
    none, half, whole = (compensate(given, face.character, seen, part, AHEAD, 0.0) for part in (0.0, 0.5, 1.0))
    assert none == given
    assert half["PRH"] == pytest.approx(0.5 * (given["PRH"] + whole["PRH"]))
    assert whole["PRH"] == pytest.approx(12.0 / (1.5 * seen[0].placement))


@pytest.mark.parametrize("name", toon_names())
def test_limits_hold_and_pupils_stay_where_motors_can_take_them(name: str) -> None:
    face = drawn(name)
    table = face.parameters
    random = np.random.default_rng(11)
    for _ in range(20):
        pose = face.neutral.replace(
            {row.name: float(random.uniform(row.low, row.high)) for row in table if row.group != "palette"}
        )
        moment = face.moment(pose.replace({"gaze.compensation": 1.0}))
        for code in ("HH", "HV", "PRH", "PRV", "PLH", "PLV"):
            limits = face.character.motors[code]
            assert limits.low_deg <= moment.shares[code] <= limits.high_deg
        for pupil in ("PR", "PL"):
            x, y = face.character.features[pupil].points[pupil]
            across, down = (face.character.motors[pupil + axis] for axis in "HV")
            assert x - across.high - 1e-9 <= moment.points[pupil][0] <= x - across.low + 1e-9
            assert y - down.high - 1e-9 <= moment.points[pupil][1] <= y - down.low + 1e-9


@pytest.mark.parametrize("name", toon_names())
def test_a_face_at_rest_meets_the_viewers_eyes_with_and_without(name: str) -> None:
    face = drawn(name)
    plain, compensated = (face.shape(face.neutral.replace({"gaze.compensation": part})) for part in (0.0, 1.0))
    for path, other in zip(plain.paths, compensated.paths, strict=True):
        assert all(np.array_equal(a, b) for a, b in zip(path.contours, other.contours, strict=True))


def test_a_viewer_aside_of_a_flat_screen_is_not_looked_at_unless_it_is_meant() -> None:
    face = drawn()
    # The viewer stands at the picture's right; told to look straight ahead, the eyes are drawn to the left.
    aside = {"viewer.x": 0.3, "gaze.compensation": 1.0}
    pupil = face.moment(face.neutral.replace(aside)).shares["PRH"]
    assert pupil > 0.0
    # Told to look at that viewer, with eyes and head, the eyes hardly move from the middle.
    at_viewer = {"head.horizontal": -8.0, "pupil.horizontal.right": math.degrees(-math.atan(0.3)) + 8.0}
    assert abs(face.moment(face.neutral.replace({**aside, **at_viewer})).shares["PRH"]) < 0.7 * pupil


def test_a_flat_drawing_turns_less_than_a_solid_one() -> None:
    face = drawn()
    flat, solid = what_is_seen(face.character), what_is_seen(face.character, solid=True)
    assert 0.25 <= flat[0].roundness < solid[0].roundness == 1.0
    assert 0.5 <= flat[0].placement <= 2.5
