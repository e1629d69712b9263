"""Appendix C of the thesis, on cameras that can be worked out by hand."""

from dataclasses import replace

import numpy as np
import pytest

from mien.capture.appendix_c import locate, picture, solve_system, transformation
from mien.capture.simulating import Setup, board, cube, simulate
from mien.capture.solving import solve
from mien.core.errors import MienError

CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64)
# A camera at z = 10 that looks back along z: u = x / (1 - z/10), v = y / (1 - z/10).
FRONT = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -0.1], [0.0, 0.0, 1.0]])
# Another at x = 10 that looks back along x: u = -z / (1 - x/10), v = y / (1 - x/10).
SIDE = np.array([[0.0, 0.0, -0.1], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])


def test_eight_corners_give_the_matrix() -> None:
    assert picture(FRONT, np.array([[1.0, 2.0, 5.0]]))[0] == pytest.approx([2.0, 4.0])
    assert transformation(CORNERS, picture(FRONT, CORNERS)) == pytest.approx(FRONT, abs=1e-9)
    assert transformation(CORNERS[:6], picture(SIDE, CORNERS[:6])) == pytest.approx(SIDE, abs=1e-9)


def test_a_point_lies_where_its_planes_meet() -> None:
    place = np.array([0.3, -0.2, 0.7])
    seen = np.array([picture(matrix, place[None])[0] for matrix in (FRONT, SIDE)])
    assert locate(np.array([FRONT, SIDE]), seen) == pytest.approx(place, abs=1e-12)


def test_elimination_exchanges_rows() -> None:
    matrix = np.array([[1e-9, 1.0], [1.0, 1e-9]])
    assert solve_system(matrix, np.array([2.0, 3.0]), "no") == pytest.approx([3.0, 2.0], abs=1e-6)


@pytest.mark.parametrize(
    ("places", "words"),
    [
        (CORNERS[:5], "got 5"),
        (CORNERS * [1.0, 1.0, 0.0] + [0.0, 0.0, 0.5], "plane"),
        (np.vstack([CORNERS, CORNERS * 0.5]) - [0.0, 0.0, 10.0], "T43"),
    ],
)
def test_what_cannot_be_told(places: np.ndarray, words: str) -> None:
    # Of the last the origin lies where the camera stands.
    pictures = picture(FRONT, places + (np.array([0.0, 0.0, 10.0]) if words == "T43" else 0.0))
    with pytest.raises(MienError, match=words):
        transformation(places, pictures)


def test_one_view_and_one_line() -> None:
    with pytest.raises(MienError, match="two views"):
        locate(FRONT[None], np.zeros((1, 2)))
    with pytest.raises(MienError, match="one line"):
        locate(np.array([FRONT, FRONT]), np.zeros((2, 2)))


def test_a_survey_without_bent_lenses() -> None:
    simulated = simulate(Setup(references=cube(count=20), points=20, views=3), 2)
    solution = solve(simulated.survey, method="appendix-c")
    assert solution.method == "appendix-c"
    measured = {key: each for key, each in solution.points.items() if each.kind == "measured"}
    off = np.array([each.place - simulated.places[key] for key, each in measured.items()])
    assert np.sqrt((off**2).sum(axis=1).mean()) < 0.001 * 0.254
    statistics = [d @ np.linalg.solve(each.covariance, d) for d, each in zip(off, measured.values(), strict=True)]
    assert 1.5 < np.mean(statistics) < 5.0  # χ² of 3 degrees of freedom
    for name, camera in solution.cameras.items():
        assert camera.place == pytest.approx(simulated.cameras[name].place, abs=0.02)


def test_far_origin_and_boards() -> None:
    simulated = simulate(Setup(references=cube(count=20), points=5, views=2), 2)
    place = simulated.cameras["view1.jpg"].place
    moved = tuple(
        replace(each, x=each.x - place[0], y=each.y - place[1], z=each.z - place[2])
        for each in simulated.survey.references
    )
    solution = solve(replace(simulated.survey, references=moved), method="appendix-c")
    off = solution.points["rest", "p001"].place + place - simulated.places["rest", "p001"]
    assert np.linalg.norm(off) < 0.001
    carried = replace(simulated.survey, references=tuple(replace(each, target="board") for each in moved))
    with pytest.raises(MienError, match="lie still"):
        solve(carried, method="appendix-c")
    flat = simulate(Setup(references=tuple(replace(each, target="world") for each in board()), points=4, views=2), 1)
    with pytest.raises(MienError, match="plane"):
        solve(flat.survey, method="appendix-c")


def test_no_references() -> None:
    survey = simulate(Setup(points=4, views=2), 1).survey
    with pytest.raises(MienError, match="no references"):
        solve(replace(survey, references=()), method="appendix-c")
