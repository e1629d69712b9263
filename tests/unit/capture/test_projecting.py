"""Projection at places worked out by hand, its slopes against differences, and back again."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.capture.projecting import LENS_TERMS, fold, lens_array, project, rays, see, see_slopes, turn, undistort
from mien.capture.records import Camera, Lens

LENS = Lens(focal_px=1000.0, principal_px=(500.0, 400.0), k1=-0.1, k2=0.02)
STRAIGHT = Lens(focal_px=1000.0, principal_px=(500.0, 400.0))
# Stands at z = 2 and looks back along z, upright: its x is the world's x, its y the world's -y.
CAMERA = Camera(lens=LENS, rotation=np.diag([1.0, -1.0, -1.0]), place=np.array([0.0, 0.0, 2.0]))


def test_a_pixel_by_hand() -> None:
    straight = Camera(STRAIGHT, CAMERA.rotation, CAMERA.place)
    assert project(straight, np.array([[0.5, 0.25, 0.0]]))[0] == pytest.approx([750.0, 275.0])
    # r² = 0.25² + 0.125² = 0.078125; 1 - 0.1 r² + 0.02 r⁴ = 0.9923095703125
    assert project(CAMERA, np.array([[0.5, 0.25, 0.0]]))[0] == pytest.approx(
        [500.0 + 250.0 * 0.9923095703125, 400.0 - 125.0 * 0.9923095703125]
    )


def test_behind_the_camera_nothing_is_seen() -> None:
    seen = project(CAMERA, np.array([[0.0, 0.0, 3.0], [0.0, 0.0, 1.0], [0.1, 0.0, 2.0]]))
    assert np.isnan(seen).all(axis=1).tolist() == [True, False, True]


@given(st.floats(-0.45, 0.3), st.floats(-0.1, 0.2), st.floats(0.0, 0.9), st.floats(0.0, 6.3))
def test_undistorted_is_the_way_back(k1: float, k2: float, share: float, angle: float) -> None:
    lens = Lens(800.0, (320.0, 240.0), k1, k2)
    radius = share * min(fold(k1, k2), 1.5)
    direction = radius * np.array([[np.cos(angle), np.sin(angle)]])
    seen = see(lens_array(lens), np.column_stack([direction, [1.0]]))
    assert undistort(lens, seen)[0] == pytest.approx(direction[0], abs=1e-6)


def test_fold() -> None:
    assert fold(0.0, 0.0) == np.inf
    assert fold(0.3, 0.0) == np.inf
    assert fold(-0.3, 0.0) == pytest.approx(np.sqrt(1.0 / 0.9))
    beyond = undistort(Lens(800.0, (0.0, 0.0), -0.3), np.array([[5000.0, 0.0]]))
    assert beyond[0] == pytest.approx([fold(-0.3, 0.0), 0.0])


def test_rays_go_through_what_is_seen() -> None:
    places = np.array([[0.3, -0.2, 0.1], [-0.4, 0.3, -0.5]])
    towards = places - CAMERA.place
    assert rays(CAMERA, project(CAMERA, places)) == pytest.approx(
        towards / np.linalg.norm(towards, axis=1, keepdims=True), abs=1e-12
    )


def test_slopes_are_those_of_differences() -> None:
    lenses = np.array(
        [[1000.0, 500.0, 400.0, -0.1, 0.05, 0.01, -0.02, 0.1], [700.0, 300.0, 200.0, 0.1, -0.02, 0.0, 0.01, -0.1]]
    )
    frame = np.array([[0.3, -0.2, 1.1], [-0.5, 0.4, 2.0]])
    seen, by_lens, by_frame = see_slopes(lenses, frame)
    assert seen == pytest.approx(see(lenses, frame))
    for term in range(LENS_TERMS):
        step = np.eye(LENS_TERMS)[term] * (1e-2 if term < 3 else 1e-6)
        by_difference = (see(lenses + step, frame) - see(lenses - step, frame)) / (2.0 * step[term])
        assert by_lens[:, :, term] == pytest.approx(by_difference, rel=1e-6, abs=1e-6)
    for axis in range(3):
        step = np.eye(3)[axis] * 1e-6
        by_difference = (see(lenses, frame + step) - see(lenses, frame - step)) / 2e-6
        assert by_frame[:, :, axis] == pytest.approx(by_difference, rel=1e-6, abs=1e-4)


def test_turns() -> None:
    assert turn(np.array([0.0, 0.0, np.pi / 2])) @ [1.0, 0.0, 0.0] == pytest.approx([0.0, 1.0, 0.0])
    assert turn(np.zeros((2, 3))) == pytest.approx(np.array([np.eye(3)] * 2))
    small, large = turn(np.array([9e-5, 0.0, 0.0])), turn(np.array([1.1e-4, 0.0, 0.0]))
    assert small[2, 1] == pytest.approx(np.sin(9e-5), rel=1e-9)
    assert large[2, 1] == pytest.approx(np.sin(1.1e-4), rel=1e-9)
