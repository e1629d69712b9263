"""Doubled vertices: a strip cut along an edge, a crease that ends, a crease that would span a polygon."""

import numpy as np
import pytest

from mien.core import MienError
from mien.core.creases import double_creases

#  3--4--5
#  |  |  |
#  0--1--2      and the same again below: 6 7 8
GRID = [[0, 1, 4, 3], [1, 2, 5, 4], [6, 7, 1, 0], [7, 8, 2, 1]]


def test_a_crease_from_border_to_border_parts_the_two_sides():
    cut, doubled = double_creases(GRID, [(0, 1), (1, 2)], 9)
    assert sorted(doubled.tolist()) == [0, 1, 2]
    upper, lower = {*cut[0], *cut[1]}, {*cut[2], *cut[3]}
    assert not upper & lower
    assert cut[:2] == GRID[:2]


def test_a_crease_that_ends_inside_fades():
    cut, doubled = double_creases(GRID, [(0, 1)], 9)
    # The middle vertex still joins all four polygons around its other edges.
    assert doubled.tolist() == [0]
    assert {*cut[0], *cut[1]} & {*cut[2], *cut[3]} == {1, 2}


def test_new_vertices_stand_for_those_they_double():
    cut, doubled = double_creases(GRID, [(0, 1), (1, 4)], 9)
    source = np.concatenate([np.arange(9), doubled])
    np.testing.assert_array_equal(source[cut], GRID)


def test_polygons_may_have_any_number_of_corners():
    #  a triangle and a pentagon along the edge 0 1
    cut, doubled = double_creases([[0, 1, 2], [1, 0, 3, 4, 5]], [(1, 0)], 6)
    assert cut == [[0, 1, 2], [7, 6, 3, 4, 5]]
    assert doubled.tolist() == [0, 1]


def test_a_crease_across_a_polygon_is_refused():
    with pytest.raises(MienError, match="span"):
        double_creases(GRID, [(0, 4)], 9)
