"""First guesses of cameras and places, from exact pictures."""

import numpy as np
import pytest

from mien.capture.homogeneous import homogeneous_matrix, metric_camera, nearest_to_rays
from mien.capture.placing import place_camera, spread_triples, three_point_poses
from mien.capture.projecting import lens_array, project, rays, turn
from mien.capture.records import Camera, Lens
from mien.core.errors import MienError

LENS = Lens(focal_px=3000.0, principal_px=(2000.0, 1500.0))
PLACES = np.random.default_rng(4).uniform(-0.2, 0.2, (12, 3))
CAMERA = Camera(LENS, turn(np.array([0.2, 2.9, -0.1])), np.array([0.3, 0.1, 1.5]))
OTHER = Camera(LENS, turn(np.array([0.1, 3.3, 0.2])), np.array([-0.4, 0.2, 1.4]))


@pytest.fixture(autouse=True)
def _cameras_see_all() -> None:
    assert np.isfinite(project(CAMERA, PLACES)).all()
    assert np.isfinite(project(OTHER, PLACES)).all()


@pytest.mark.parametrize("origin", [(0.0, 0.0, 0.0), tuple(CAMERA.place)])
def test_homogeneous_matrix_gives_the_camera(origin: tuple[float, float, float]) -> None:
    # The second origin lies in the camera, where Appendix C cannot go.
    places = PLACES - origin
    found = metric_camera(homogeneous_matrix(places, project(CAMERA, PLACES)), places)
    assert found is not None
    assert found.lens.focal_px == pytest.approx(3000.0, rel=1e-6)
    assert found.lens.principal_px == pytest.approx((2000.0, 1500.0), abs=1e-3)
    assert found.rotation == pytest.approx(CAMERA.rotation, abs=1e-7)
    assert found.place + origin == pytest.approx(CAMERA.place, abs=1e-6)


def test_a_mirrored_frame_has_no_camera() -> None:
    mirrored = PLACES * [-1.0, 1.0, 1.0]
    assert metric_camera(homogeneous_matrix(mirrored, project(CAMERA, PLACES)), mirrored) is None


def test_too_few_and_flat() -> None:
    with pytest.raises(MienError, match="got 5"):
        homogeneous_matrix(PLACES[:5], project(CAMERA, PLACES[:5]))
    flat = PLACES * [1.0, 1.0, 0.0]
    with pytest.raises(MienError, match="plane"):
        homogeneous_matrix(flat, project(CAMERA, flat))


def test_rays_meet() -> None:
    place = np.array([0.05, -0.1, 0.02])
    directions = np.vstack([rays(camera, project(camera, place[None])) for camera in (CAMERA, OTHER)])
    assert nearest_to_rays(np.array([CAMERA.place, OTHER.place]), directions) == pytest.approx(place, abs=1e-9)
    assert nearest_to_rays(np.array([CAMERA.place, CAMERA.place]), directions[[0, 0]]) is None
    assert nearest_to_rays(np.array([[0.0, 0, 0], [1.0, 0, 0]]), np.array([[0.0, 0.6, -0.8], [0.6, 0.0, -0.8]])) is None


def test_three_points_leave_the_pose_among_others() -> None:
    towards = (PLACES[:3] - CAMERA.place) @ CAMERA.rotation.T
    directions = towards / np.linalg.norm(towards, axis=1, keepdims=True)
    rotations, centres, triples = three_point_poses(PLACES[None, :3], directions[None])
    assert 1 <= len(rotations) <= 4
    assert set(triples.tolist()) == {0}
    assert min(np.linalg.norm(centre - CAMERA.place) for centre in centres) < 1e-7


@pytest.mark.parametrize("flat", [False, True])
def test_a_pose_from_points_of_which_some_are_wrong(flat: bool) -> None:
    places = PLACES * [1.0, 1.0, 0.0] if flat else PLACES
    seen = project(CAMERA, places)
    seen[[2, 7]] = seen[[7, 2]]
    pose = place_camera(places, seen, lens_array(LENS), 4000.0)[0]
    assert pose.place == pytest.approx(CAMERA.place, abs=1e-3)
    assert pose.rotation == pytest.approx(CAMERA.rotation, abs=1e-3)


def test_points_on_a_line_place_nothing() -> None:
    line = np.linspace(0.0, 1.0, 5)[:, None] * [0.1, 0.1, 0.1]
    assert len(spread_triples(line, project(CAMERA, line))) == 0
    assert place_camera(line, project(CAMERA, line), lens_array(LENS), 4000.0) == []
