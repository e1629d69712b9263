from itertools import pairwise

import numpy as np
import pytest

from mien.faces.toon.equations import (
    between_states,
    joint_shares,
    place_along,
    put_along,
)


def point(x, y):
    return np.array([float(x), float(y)])


def paper(vertex, rest, now):
    """A1.1 to A1.4 as they are printed, for one line."""
    (h0, v0), (h1, v1) = rest
    share = (vertex[0] - h0) / (h1 - h0)
    distance = vertex[1] - (vertex[0] * (v1 - v0) / (h1 - h0) + v0 - (v1 - v0) / (h1 - h0) * h0)
    (h0, v0), (h1, v1) = now
    steep = (v1 - v0) / (h1 - h0)
    x = h0 + share * (h1 - h0)
    return x, x * steep + (v0 - steep * h0) + distance


def test_a_vertex_on_a_line_is_where_slope_and_intercept_put_it():
    """From (2, 1) to (6, 9) the slope is 2 (A1.1), the intercept -3 (A1.2): a quarter along, X is 3 and Y 2 * 3 - 3."""
    assert put_along(np.array([0.25]), np.zeros(1), point(2, 1), point(6, 9)).tolist() == [[3.0, 3.0]]


@pytest.mark.parametrize("now", [(point(1, 2), point(9, 5)), (point(0, 8), point(7, -6)), (point(3, 3), point(4, 30))])
def test_a_vertex_on_a_line_of_any_slope_goes_exactly_as_the_paper_prints_it(now):
    rest = (point(2, 1), point(6, 9))
    share, distance = place_along(np.array([[3.0, 3.0]]), *rest)
    assert distance[0] == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_allclose(put_along(share, distance, *now)[0], paper((3.0, 3.0), rest, now), atol=1e-12)


def test_a_vertex_of_a_level_line_goes_as_the_paper_prints_it():
    rest = (point(10, 50), point(40, 50))
    now = (point(10, 50), point(40, 50.4))
    for vertex in ((12, 47), (25, 44), (39, 55)):
        share, distance = place_along(np.array([vertex], dtype=float), *rest)
        np.testing.assert_allclose(put_along(share, distance, *now)[0], paper(vertex, rest, now), atol=0.09)


def test_a_vertex_between_level_lines_goes_exactly_as_the_paper_prints_it():
    rest, now = (point(10, 50), point(40, 50)), (point(10, 42), point(40, 42))
    share, distance = place_along(np.array([[25.0, 44.0]]), *rest)
    np.testing.assert_allclose(put_along(share, distance, *now)[0], paper((25, 44), rest, now), atol=1e-12)
    assert put_along(share, distance, *now)[0].tolist() == [25.0, 36.0]


def test_the_distance_from_a_steep_line_is_kept_and_not_the_height_above_it():
    rest, now = (point(0, 0), point(10, 0)), (point(0, 0), point(6, 8))
    share, distance = place_along(np.array([[5.0, 2.0]]), *rest)
    assert (share[0], distance[0]) == (0.5, 2.0)
    np.testing.assert_allclose(put_along(share, distance, *now), [[3 - 1.6, 4 + 1.2]])


def test_an_upright_line_has_places_too():
    start, end = point(40, 10), point(40, 40)
    share, distance = place_along(np.array([[38.0, 25.0]]), start, end)
    assert (share[0], distance[0]) == (0.5, 2.0)
    np.testing.assert_allclose(put_along(share, distance, start, point(40, 20)), [[38.0, 15.0]])


def test_a_line_without_length_gives_numbers():
    here = point(3, 4)
    share, distance = place_along(np.array([[5.0, 6.0]]), here, here)
    np.testing.assert_allclose(put_along(share, distance, here, here), [[3.0, 6.0]])
    assert np.isfinite(put_along(np.array([0.5]), np.array([1.0]), here, here)).all()


def test_places_at_rest_give_the_vertices_back():
    vertices = np.array([[1.0, 2.0], [-7.0, 9.5], [30.0, -4.0]])
    line = (point(2, 3), point(11, -6))
    np.testing.assert_allclose(put_along(*place_along(vertices, *line), *line), vertices, atol=1e-12)


def test_shares_add_up_to_all_and_the_nearest_line_has_the_most():
    lines = [(point(0, 0), point(10, 0)), (point(10, 0), point(20, 5))]
    vertices = np.array([[5.0, 1.0], [10.0, 3.0], [15.0, 3.0], [9.98, -1.0]])
    shares = joint_shares(vertices, lines)
    np.testing.assert_allclose(shares.sum(axis=0), 1.0)
    assert shares[0, 0] == shares[1, 2] == 1.0
    assert 0.5 <= shares[0, 3] < 1.0


@pytest.mark.parametrize("height", [-3.0, 0.5, 4.0])
def test_neighbours_near_a_joint_do_not_part(height):
    lines = [(point(0, 0), point(10, 0)), (point(10, 0), point(20, 0))]
    moved = [(point(0, 0), point(10, 6)), (point(10, 6), point(20, 0))]
    vertices = np.stack([np.linspace(2.0, 18.0, 1601), np.full(1601, height)], axis=1)
    shares = joint_shares(vertices, lines)
    now = sum(
        share[:, None] * put_along(*place_along(vertices, *line), *there)
        for share, line, there in zip(shares, lines, moved, strict=True)
    )
    steps = np.sqrt((np.diff(now, axis=0) ** 2).sum(axis=1))
    assert steps.max() < 0.15  # vertices lie 0.01 apart at rest; a tear would be some units


def test_a_state_is_between_its_ends():
    low, high = np.array([[0.0, 0.0], [10.0, 0.0]]), np.array([[0.0, 4.0], [14.0, 8.0]])
    assert between_states(low, high, 0.25).tolist() == [[0.0, 1.0], [11.0, 2.0]]  # A1.5, A1.6
    assert between_states(low, high, 0.0).tolist() == low.tolist()
    assert between_states(low, high, 1.0).tolist() == high.tolist()
    ways = [between_states(low, high, share) for share in (0.0, 0.25, 0.5, 0.75, 1.0)]
    for one, other in pairwise(ways):
        np.testing.assert_allclose(other - one, (high - low) / 4.0)
