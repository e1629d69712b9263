"""A simulated set-up is what its attributes say."""

from dataclasses import replace

import cv2
import numpy as np
import pytest

from mien.capture.records import REST, WORLD, Lens
from mien.capture.simulating import Setup, Simulated, board, cube, face_points, scattered, simulate

DISTORTED = Setup(
    k1=-0.15, k2=0.05, p1=0.003, p2=-0.002, aspect=0.97, off_centre=0.02, sigma_px=0.0, turned_deg=80.0, one_lens=False
)


def seen_by_opencv(simulated: Simulated, photo: str, name: str) -> np.ndarray:
    """(2,) px: OpenCV's centres of pixels are at whole numbers, and half a pixel is in the principal point here."""
    camera, moment = simulated.cameras[photo], simulated.survey.photograph(photo).moment
    lens = camera.lens
    matrix = np.array(
        [[lens.focal_px, 0, lens.principal_px[0]], [0, lens.aspect * lens.focal_px, lens.principal_px[1]], [0, 0, 1]]
    )
    turn, _ = cv2.Rodrigues(camera.rotation)
    shift = -camera.rotation @ camera.place
    place = simulated.places[moment, name]
    return cv2.projectPoints(place[None], turn, shift, matrix, np.array([lens.k1, lens.k2, lens.p1, lens.p2]))[
        0
    ].ravel()


def errors_px(simulated: Simulated) -> np.ndarray:
    """(N, 2), of every click."""
    survey = simulated.survey
    return np.array([[o.u, o.v] - seen_by_opencv(simulated, o.photo, o.point) for o in survey.observations])


def test_exact_clicks_are_where_opencv_sees_the_places() -> None:
    assert np.abs(errors_px(simulate(DISTORTED, 3))).max() < 1e-6


def test_all_is_in_the_pictures_and_fills_them() -> None:
    for setup in (DISTORTED, Setup(references=board(), moments=5, views=2)):
        places = np.array([[o.u, o.v] for o in simulate(setup, 1).survey.observations])
        assert places.min() > 0.0
        assert (places < setup.size_px).all()
        assert (np.ptp(places, axis=0) > 0.6 * np.array(setup.size_px)).any()


def test_a_seed_gives_the_same_survey_and_another_seed_another() -> None:
    setup = Setup(mis_clicks=0.05, reference_sigma_m=1e-4)
    assert simulate(setup, 1).survey == simulate(setup, 1).survey
    assert simulate(setup, 1).survey != simulate(setup, 2).survey


@pytest.mark.parametrize("noise", ["normal", "uniform"])
def test_clicks_err_by_their_sigma(noise: str) -> None:
    errors = errors_px(simulate(Setup(points=1000, noise=noise, sigma_px=2.0), 1))  # type: ignore[arg-type]
    assert abs(errors.std() - 2.0) < 0.1
    assert (np.abs(errors).max() < 2.0 * np.sqrt(3.0)) == (noise == "uniform")


def test_rounded_clicks_lie_on_a_grid_of_that_sigma() -> None:
    step = 5.0
    simulated = simulate(Setup(points=300, noise="rounded", sigma_px=step / np.sqrt(12.0)), 1)
    clicks = np.array([[o.u, o.v] for o in simulated.survey.observations]) / step
    assert np.abs(clicks - np.round(clicks)).max() < 1e-9
    assert abs(errors_px(simulated).std() / (step / np.sqrt(12.0)) - 1.0) < 0.05


def test_mis_clicks_are_those_that_are_told_and_one_at_most_for_each_point() -> None:
    simulated = simulate(Setup(mis_clicks=0.05, sigma_px=1e-3), 1)
    off = np.linalg.norm(errors_px(simulated), axis=1) > 5e-3
    told = [(o.photo, o.point) in simulated.mis_clicks for o in simulated.survey.observations]
    assert off.tolist() == told
    assert off.sum() == round(0.05 * len(off)) == len({name for _, name in simulated.mis_clicks})


def test_points_turned_away_are_hidden() -> None:
    everything, some = (simulate(replace(DISTORTED, turned_deg=angle), 1) for angle in (180.0, 60.0))
    assert len(everything.survey.observations) == 4 * (8 + 40)
    assert 4 * 8 < len(some.survey.observations) < 4 * (8 + 40)
    face, normals = face_points(40)
    for observation in some.survey.observations:
        if observation.point.startswith("p"):
            index = int(observation.point[1:]) - 1
            towards = some.cameras[observation.photo].place - face[index]
            assert normals[index] @ towards > 0.5 * np.linalg.norm(towards)


def test_cameras_stand_apart_look_at_the_middle_and_are_upright() -> None:
    simulated = simulate(Setup(views=3, spread_deg=80.0), 1)
    places = np.array([camera.place for camera in simulated.cameras.values()])
    towards = places / np.linalg.norm(places, axis=1, keepdims=True)
    assert abs(np.degrees(np.arccos(towards[0] @ towards[2])) - 80.0) < 8.0
    assert (np.abs(np.linalg.norm(places, axis=1) - 1.5) < 0.1).all()
    for camera, direction in zip(simulated.cameras.values(), towards, strict=True):
        assert np.allclose(camera.rotation @ camera.rotation.T, np.eye(3))
        assert np.linalg.det(camera.rotation) > 0.0
        assert camera.rotation[2] @ direction < -0.99
        assert camera.rotation[1, 1] < -0.9


def test_lenses_and_places_are_shared_as_told() -> None:
    simulated = simulate(Setup(references=board(), moments=3, views=2, one_lens=False, fixed=True), 1)
    cameras = simulated.cameras
    assert len(cameras) == 6
    assert cameras["m01-view1.jpg"].lens == cameras["m03-view1.jpg"].lens != cameras["m01-view2.jpg"].lens
    assert np.array_equal(cameras["m01-view1.jpg"].place, cameras["m03-view1.jpg"].place)
    assert isinstance(cameras["m01-view1.jpg"].lens, Lens)
    assert not np.allclose(simulated.places["m01", "board 0 0"], simulated.places["m02", "board 0 0"])
    assert np.array_equal(simulated.places["m01", "p001"], simulated.places["m02", "p001"])


def test_a_held_board_keeps_its_size_and_faces_the_cameras() -> None:
    corners = board(4, 3, 0.03)
    simulated = simulate(Setup(references=corners, moments=4), 2)
    own = np.array([[each.x, each.y, each.z] for each in corners])
    for photograph in simulated.survey.photographs:
        held = np.array([simulated.places[photograph.moment, each.name] for each in corners])
        assert np.allclose(np.linalg.norm(held[:, None] - held, axis=2), np.linalg.norm(own[:, None] - own, axis=2))
        seen = {o.point: (o.u, o.v) for o in simulated.survey.observations if o.photo == photograph.name}
        (u0, v0), (u1, _), (_, v2) = seen["board 0 0"], seen["board 3 0"], seen["board 0 2"]
        assert u1 > u0
        assert v2 > v0


@pytest.mark.parametrize("count", [6, 8, 20])
def test_cubes_have_as_many_references_as_asked_for(count: int) -> None:
    references = cube(1.0, count)
    places = np.array([[each.x, each.y, each.z] for each in references])
    assert len({each.name for each in references}) == len(np.unique(places, axis=0)) == count
    assert np.linalg.matrix_rank(places - places.mean(axis=0)) == 3
    assert {each.target for each in references} == {WORLD}
    assert np.array_equal(simulate(Setup(references=references), 1).places[REST, "c111"], [0.5, 0.5, 0.5])


def test_surveyed_references_differ_from_the_true_ones_by_their_sigma() -> None:
    simulated = simulate(Setup(references=scattered(200), reference_sigma_m=1e-3), 1)
    off = [each.x - simulated.places[REST, each.name][0] for each in simulated.survey.references]
    assert abs(float(np.std(off)) - 1e-3) < 2e-4
    assert {each.sigma_m for each in simulated.survey.references} == {1e-3}


def test_face_points_lie_in_the_cube_with_the_nose_in_front() -> None:
    places, normals = face_points(60)
    assert np.abs(places).max() < 0.5 * 0.254
    assert np.argmax(places[:, 2]) == np.argmax(normals[:, 2])
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0)
