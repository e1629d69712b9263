"""Where outlines cross themselves: known answers, the degenerate cases, and the same as comparing all pairs."""

from itertools import combinations
from time import perf_counter

import numpy as np
import pytest

from mien.faces.toon.checks_crossing import find_crossings
from mien.faces.toon.checks_drawn import find_inside

SQUARE = [(0, 0), (10, 0), (10, 10), (0, 10)]
TURN = np.array([[0.6, 0.8], [-0.8, 0.6]])


def crossings(points):
    return list(find_crossings(np.array(points, dtype=float)))


def test_a_bow_crosses_in_its_middle():
    (found,) = crossings([(0, 0), (10, 10), (10, 0), (0, 10)])
    assert (found.first, found.second) == (0, 2)
    assert found.at == pytest.approx((5.0, 5.0))


@pytest.mark.parametrize(
    "points",
    [
        SQUARE,
        [*SQUARE, (0, 0)],
        [(0, 0), (0, 0), (10, 0), (10, 10), (10, 10)],
        [(0, 0), (10, 0), (10, 10), (5, 0), (0, 10)],  # a vertex on an edge, from inside
        [(0, 0), (10, 10), (20, 0), (20, 20), (10, 10), (0, 20)],  # two corners that meet
        [(0, 0), (10, 0), (5, 0), (5, 5)],  # a line that runs back on itself
        [(0, 0), (10, 0), (20, 0), (20, 5), (10, 0), (0, 5)],
        [(0, 0), (1, 1)],
        [(3, 3)] * 9,
    ],
)
def test_outlines_that_only_touch_themselves_do_not_cross(points):
    assert crossings(points) == []


@pytest.mark.parametrize(
    ("points", "at"),
    [
        ([(0, 0), (10, 0), (10, 10), (5, 0), (5, -5), (0, -5)], (5, 0)),  # through a vertex on an edge
        ([(0, 0), (20, 20), (20, 0), (10, 10), (0, 20)], (10, 10)),
        ([(0, 0), (10, 10), (20, 20), (20, 0), (10, 10), (0, 20)], (10, 10)),  # both have a vertex there
    ],
)
def test_crossings_in_a_vertex_are_found(points, at):
    found = crossings(points)
    assert len(found) == 1
    assert found[0].at == pytest.approx(at)


@pytest.mark.parametrize("seed", range(6))
def test_the_same_as_comparing_all_pairs(seed):
    points = np.random.default_rng(seed).uniform(0.0, 100.0, (40, 2))
    ends = [(points[k], points[(k + 1) % 40]) for k in range(40)]

    def side(a, b, c):
        return np.sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))

    wanted = {
        (one, other)
        for one, other in combinations(range(40), 2)
        if (one - other) % 40 not in (1, 39)
        and side(*ends[one], ends[other][0]) != side(*ends[one], ends[other][1])
        and side(*ends[other], ends[one][0]) != side(*ends[other], ends[one][1])
    }
    assert {(found.first, found.second) for found in crossings(points)} == wanted


def test_five_thousand_vertices_take_no_time():
    count = 5000
    angles = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    star = np.stack([np.cos(angles), np.sin(angles)], axis=1) * np.where(np.arange(count) % 2, 100.0, 60.0)[:, None]
    comb = np.stack([np.where(np.arange(count) % 2, 100.0, 0.0), 0.01 * np.arange(count)], axis=1)
    comb[-1, 0] = -5.0
    start = perf_counter()
    for points in (star, comb, comb @ TURN):
        assert crossings(points) == []
    comb[2000] = 50.0, 20.1
    assert len(crossings(comb @ TURN)) > 1
    assert perf_counter() - start < 5.0


def test_points_inside():
    points = np.array([(5.0, 5.0), (15.0, 5.0), (1.0, 1.0), (-1.0, 5.0)])
    assert find_inside(points, (np.array(SQUARE, dtype=float),)).tolist() == [True, False, True, False]
    assert find_inside(points, (np.array(SQUARE[::-1], dtype=float),)).tolist() == [True, False, True, False]
