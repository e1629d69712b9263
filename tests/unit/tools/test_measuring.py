"""The steps of measuring, at values worked out by hand."""

from pathlib import Path

import numpy as np
import pytest

from mien.core import MienError, UnknownNameError

pytest.importorskip("scipy")
TOOLS = Path(__file__).parents[3] / "tools"

CORNERS = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]])
TRIANGLE = np.array([[0, 1, 2]])
UP = np.array([[0.0, 0.0, 1.0]])


@pytest.fixture(autouse=True)
def tools(monkeypatch):
    monkeypatch.syspath_prepend(str(TOOLS))


def two_people():
    """Two people of one vertex and one landmark, and labels of which one is the other doubled and shifted."""
    from measuring.people import People

    moves = {"chin": np.array([[0.001, 0.0, 0.0], [0.003, 0.0, 0.004]])}
    return People(np.zeros((2, 1, 3)), moves, {"weight": np.array([0.25, 0.75])}, 1.0)


@pytest.mark.parametrize(
    ("point", "weights"),
    [
        ((1.0, 1.0, 2.0), (1 / 3, 1 / 3, 1 / 3)),  # above the middle
        ((1.5, -1.0, 0.0), (0.5, 0.5, 0.0)),  # beside an edge
        ((-1.0, -1.0, 0.5), (1.0, 0.0, 0.0)),  # beyond a corner
        ((2.0, 2.0, 0.0), (0.0, 0.5, 0.5)),  # beside the long edge
    ],
)
def test_closest_point_of_a_triangle(point, weights, monkeypatch):
    from measuring import closest

    monkeypatch.setattr(closest, "NEAREST", 2)
    matrix = closest.bind(np.array([point]), UP, CORNERS, np.concatenate([TRIANGLE, TRIANGLE]))
    np.testing.assert_allclose(matrix.toarray(), [weights], atol=1e-12)


def test_a_surface_that_faces_the_other_way_is_left_for_one_farther_off(monkeypatch):
    from measuring import closest

    monkeypatch.setattr(closest, "NEAREST", 2)
    sheets = np.concatenate([0.01 * CORNERS, 0.01 * CORNERS + [0.0, 0.0, 0.02]])
    facing_away_then_up = np.array([[0, 2, 1], [3, 4, 5]])
    matrix = closest.bind(np.array([[0.01, 0.01, 0.001]]), UP, sheets, facing_away_then_up)
    np.testing.assert_allclose(matrix.toarray(), [[0, 0, 0, 1 / 3, 1 / 3, 1 / 3]], atol=1e-12)


def test_similarity_finds_turn_size_and_shift():
    from measuring.reference import similarity

    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    points = np.array([[1.0, 0, 0], [0, 2.0, 0], [0, 0, 3.0], [1.0, 1.0, 1.0]])
    turn, shift = similarity(points, 2.0 * points @ quarter.T + [5.0, 6.0, 7.0])
    np.testing.assert_allclose(turn, 2.0 * quarter, atol=1e-12)
    np.testing.assert_allclose(shift, [5.0, 6.0, 7.0], atol=1e-12)


def test_measure_is_a_sum_of_landmarks_in_mm_about_its_mean():
    # 0.5 * 1 - 0 = 0.5 and 0.5 * 3 - 4 = -2.5: their mean is -1.
    np.testing.assert_allclose(two_people().measured("0.5 chin.x - chin.z"), [1.5, -1.5])
    np.testing.assert_allclose(two_people().measured("2 weight"), [-0.5, 0.5])


def test_what_another_measure_explains_is_taken_off():
    values, fields = two_people().told_apart("chin.x", ["chin.z"])
    np.testing.assert_allclose(values, 0.0, atol=1e-12)
    assert fields.shape == (2, 1, 3)


@pytest.mark.parametrize("measure", ["chim.x", "wait"])
def test_unknown_name_in_a_measure(measure):
    with pytest.raises(UnknownNameError, match=measure[:4]):
        two_people().measured(measure)


@pytest.mark.parametrize("measure", ["chin.x 2", "chin.x * 2", ""])
def test_measure_that_cannot_be_read(measure):
    with pytest.raises(MienError, match="cannot be read"):
        two_people().measured(measure)


def test_smooth_step_is_half_in_the_middle_and_stays_within_its_ends():
    from measuring.skin import smooth_step

    np.testing.assert_array_equal(smooth_step(np.array([-1.0, 0.0, 0.5, 1.0, 2.0])), [0.0, 0.0, 0.5, 1.0, 1.0])
