"""Eyes, lids and brows: Parke's formulas at hand-computed values, and no sliver when shut."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mien.core import Pose, Scene
from mien.faces.head import eyes, lids
from mien.faces.head.head import Head
from mien.faces.head.measured import archive
from mien.faces.head.residual import Residual, apply_residual, read_residual
from mien.render import draw
from support import in_python

HEAD = Head(hair="bald")
REST = Pose.neutral(HEAD.parameters)
PEOPLE = sorted((Path(__file__).parent / "people").glob("*.npz"))
"""Residuals of four people measured on ICT-FaceKit."""

lens_centre, look_at, closing = in_python(eyes.lens_centre), in_python(eyes.look_at), in_python(lids.closing)

AHEAD = np.array([0.0, 0.0, 1.0])
GREEN = {
    f"{name}.color.{channel}": value
    for name in ("white", "iris", "pupil", "fringe", "spot")
    for channel, value in (("red", 0.0), ("green", 1.0), ("blue", 0.0))
}
VIEWS = ((0, 0), (20, 0), (-20, 0), (0, -15), (0, 15), (35, -10))


def eye_pixels(face, opening, views=VIEWS, subdivide=2):
    """Pixels in which some of the eyeballs, painted green, is seen."""
    pose = Pose.neutral(face.parameters).replace({**GREEN, "eyelid.opening": opening})
    scene = replace(Scene(size_px=(300, 180), subdivide=subdivide), at=(0.0, 0.005, 0.07))
    count = 0
    for yaw, pitch in views:
        r, g, b, _ = np.moveaxis(draw(face, pose, scene.turned(yaw, pitch, 0.4)).astype(int), -1, 0)
        count += int(((g > r + 40) & (g > b + 40)).sum())
    return count


def ring_radii(iris, pupil, fringe):
    radii = np.zeros((7, 2))
    in_python(eyes.fill_radii)(iris, pupil, fringe, radii)
    return radii.tolist()


def test_rings_lie_where_figure_3_2_puts_them():
    pupil, iris, fringe, middle, edge, *_ = ring_radii(iris=0.6, pupil=0.28, fringe=0.0)
    assert pupil == pytest.approx((0.96, 0.28))
    assert iris == pytest.approx((0.8, 0.6))
    phi = math.asin(fringe[1])
    half = phi + (math.pi / 2 - phi) / 2
    assert middle == pytest.approx((math.cos(half), math.sin(half)))
    assert edge == [0.0, 1.0]


def test_a_pupil_larger_than_the_iris_stays_inside_it():
    pupil, iris, *_ = ring_radii(iris=0.3, pupil=1.0, fringe=0.12)
    assert pupil[1] < iris[1]


def test_the_lens_centre_solves_appendix_a():
    assert lens_centre(0.6) == pytest.approx(0.2)
    for iris in (0.1, 0.39, 0.7):
        assert iris**2 + (iris + lens_centre(iris)) ** 2 == pytest.approx(1.0)
    assert lens_centre(0.75) < 0.0


def test_each_eye_has_sizes_of_its_own():
    one = HEAD.shape(REST.replace({"pupil.size.left": 0.3})).points - HEAD.shape(REST).points
    assert np.abs(one[HEAD._layout.span["eye.left"]]).max() > 0.001
    assert np.abs(one[HEAD._layout.span["eye.right"]]).max() == 0.0


def test_eyes_look_at_a_target_each_by_itself():
    target = np.array([0.1, 0.05, 0.5])
    for centre in archive().floats("eye_centre"):
        forward = look_at(centre, target, 0.0, 0.0)
        alpha = math.atan2(target[0] - centre[0], target[2] - centre[2])
        beta = math.atan2(target[1] - centre[1], math.hypot(target[0] - centre[0], target[2] - centre[2]))
        expected = (math.sin(alpha) * math.cos(beta), math.sin(beta), math.cos(alpha) * math.cos(beta))
        np.testing.assert_allclose(forward, expected, atol=1e-12)


@pytest.mark.parametrize("target", [(0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, 3.0, -0.1), (-2.0, -2.0, 0.01)])
def test_no_target_turns_an_eye_farther_than_an_eye_turns(target):
    forward = look_at(np.zeros(3), np.array(target), 0.0, 0.0)
    assert np.isfinite(forward).all()
    assert math.degrees(math.atan2(abs(forward[0]), forward[2])) <= 45.0 + 1e-9
    assert abs(math.degrees(math.asin(forward[1]))) <= 35.1


def test_added_turn_and_nod_are_degrees():
    forward = look_at(np.zeros(3), AHEAD, 20.0, 0.0)
    np.testing.assert_allclose(forward, (math.sin(math.radians(20)), 0.0, math.cos(math.radians(20))), atol=1e-12)
    forward = look_at(np.zeros(3), AHEAD, 0.0, -12.0)
    np.testing.assert_allclose(forward, (0.0, math.sin(math.radians(-12)), math.cos(math.radians(12))), atol=1e-12)


def spot_direction(light, viewer, centre=(0.0, 0.0, 0.0), radius=1.0, iris=0.39):
    return in_python(eyes.spot_direction)(centre, radius, AHEAD, iris, light, viewer)


def spot_points(light, viewer):
    points = np.empty((6, 3))
    in_python(eyes.place_spot)(np.zeros(3), 0.012, AHEAD, (0.39, 0.058), light, viewer, eyes.circle(6), points)
    return points


def test_the_spot_halves_the_angle_between_light_and_viewer():
    far = 1e6
    direction, shown = spot_direction(np.array([far, 0.0, far]), np.array([0.0, 0.0, far]))
    bulge, radius = lens_centre(0.39), 0.39 * math.sqrt(2.0)
    half = math.radians(22.5)
    expected = np.array([radius * math.sin(half), 0.0, bulge + radius * math.cos(half)])
    np.testing.assert_allclose(direction, expected / np.linalg.norm(expected), atol=1e-5)
    assert shown == 1.0


def test_the_spot_depends_on_where_the_eye_is_and_on_nothing_else():
    light, viewer, place = np.array([-0.4, 0.3, 0.5]), np.array([0.1, 0.0, 0.6]), np.array([0.032, 0.03, 0.07])
    middle = spot_direction(light, viewer, radius=0.012)
    moved = spot_direction(light + place, viewer + place, centre=place, radius=0.012)
    stayed = spot_direction(light, viewer, centre=place, radius=0.012)
    np.testing.assert_allclose(moved[0], middle[0], atol=1e-14)
    assert np.abs(np.subtract(stayed[0], middle[0])).max() > 0.01


def test_an_iris_too_large_for_a_lens_reflects_on_the_ball():
    direction, _ = spot_direction(np.array([0.0, 1e6, 1e6]), np.array([0.0, 0.0, 1e6]), iris=0.8)
    half = math.radians(22.5)
    np.testing.assert_allclose(direction, (0.0, math.sin(half), math.cos(half)), atol=1e-5)


def test_the_spot_follows_light_and_viewer():
    light, viewer = np.array([-1.0, 1.0, 2.0]), np.array([0.0, 0.0, 1.0])
    first = spot_points(light, viewer).mean(axis=0)
    assert spot_points(light * [-1, 1, 1], viewer).mean(axis=0)[0] == pytest.approx(-first[0])
    assert spot_points(light, viewer + np.array([0.5, 0.0, 0.0])).mean(axis=0)[0] > first[0]


def test_a_light_behind_the_head_is_reflected_nowhere_and_breaks_nothing():
    for light in ((0.0, 0.0, -3.0), (1e-9, 0.0, -3.0), (-1e-9, 0.0, -3.0), (0.0, -5.0, -3.0)):
        points = spot_points(np.array(light), np.array([0.0, 0.0, 1.0]))
        assert np.isfinite(points).all()
        assert np.ptp(points, axis=0).max() < 0.012 * 0.01


def test_pupil_and_spot_are_polygons_of_his_number_of_sides():
    classic = HEAD.unsubdivided.topology
    assert len(classic.polygon(classic.part("eye.left").first)) == 12
    assert len(classic.polygon(classic.part("spot.left").first)) == 6


def test_opening_goes_from_shut_over_rest_to_wide():
    rest = HEAD.parameters["eyelid.opening.left"].default
    assert closing(0.0, rest) == 1.0
    assert closing(rest, rest) == 0.0
    assert closing(1.0, rest) == 0.0


@pytest.mark.parametrize("face", [HEAD, HEAD.unsubdivided], ids=["cage", "surface"])
def test_no_sliver_of_eye_shows_when_the_lids_are_shut(face):
    assert eye_pixels(face, 0.0, subdivide=2 if face is HEAD else 0) == 0
    assert eye_pixels(face, 0.2, views=((0, 0),), subdivide=2 if face is HEAD else 0) > 20


def test_more_opening_shows_more_eye():
    seen = [eye_pixels(HEAD, opening, views=((0, 0),)) for opening in (0.0, 0.25, 0.5, 0.75, 1.0)]
    assert (np.diff(seen) > 0).all()


@pytest.mark.parametrize("opening", [0.0, 0.3, 0.75, 1.0])
@pytest.mark.parametrize("target", [(0.0, 0.0, 1.0), (0.0, -0.6, 1.0), (0.0, 0.6, 1.0)])
def test_lids_stay_outside_the_ball(opening, target):
    pose = REST.replace(
        {"eyelid.opening": opening, **dict(zip(("target.x", "target.y", "target.z"), target, strict=True))}
    )
    skin = HEAD.shape(pose).points
    lids = archive().measured("cage").lids
    centre = archive().floats("eye_centre")[0]
    outer = lids.index[(lids.side > 0) & (lids.ring >= 2)]
    distance = np.linalg.norm(skin[outer] - centre, axis=1)
    assert distance.min() > float(archive().floats("eye_radius"))


@pytest.mark.parametrize("path", PEOPLE, ids=lambda path: path.stem)
def test_lids_of_other_people_shut_without_a_sliver(path):
    # These four showed one with the neutral head's arcs (99 to 530 pixels at 500 x 300).
    residual = read_residual(path, len(archive().mirror))
    assert eye_pixels(Head(hair="bald", residual=residual), 0.0) == 0


def test_a_residual_of_nothing_changes_next_to_nothing():
    count = len(archive().mirror)
    nothing = Residual(np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(3))
    for kind in ("cage", "surface"):
        plain = archive().measured(kind)
        fitted = apply_residual(plain, nothing, archive()).lids
        assert np.abs(fitted.elevation - plain.lids.elevation).max() < 0.02
        assert np.abs(fitted.elevation_shut - plain.lids.elevation_shut).max() < 0.06
    with_nothing = Head(hair="bald", residual=nothing)
    assert np.abs(with_nothing.shape(REST).points - HEAD.shape(REST).points).max() < 5e-4


def test_brow_arch_raises_and_lowers_the_brow_around_rest():
    span = HEAD._layout.span["brow.left"]

    def height(values):
        return HEAD.shape(REST.replace(values)).points[span][:, 1].mean()

    assert height({"eyebrow.arch": 0.0}) > height({}) + 0.004
    assert height({"eyebrow.arch": 1.0}) < height({}) - 0.001


def test_brow_separation_moves_the_inner_end_only():
    span = HEAD._layout.span["brow.left"]
    moved = (HEAD.shape(REST.replace({"eyebrow.separation": 25})).points - HEAD.shape(REST).points)[span]
    along = archive().floats("brow_along")
    assert moved[along == 0.0, 0].min() > 0.002
    assert np.abs(moved[along > 0.7]).max() < 0.0005


def test_a_wide_eye_is_the_measured_one():
    moved = HEAD.shape(REST.replace({"eyelid.opening.left": 1.0})).points - HEAD.shape(REST).points
    wide = archive().measured("cage").morphs["eyeWide_L"]
    np.testing.assert_allclose(moved[: len(wide)], wide, atol=1e-12)
