"""The sparse matrix against a dense one, and its fixed order of summation."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mien.core.sparse import SparseMatrix, sort_pairs


def make(entries, shape):
    rows, columns, weights = (np.array(column) for column in zip(*entries, strict=True))
    return SparseMatrix.from_entries(rows.astype(np.int64), columns.astype(np.int64), weights.astype(float), shape)


def test_known_product():
    matrix = make([(0, 0, 2.0), (0, 2, 1.0), (2, 1, -1.0)], (3, 3))
    values = np.array([[1.0, 10.0], [2.0, 20.0], [3.0, 30.0]])
    assert matrix.shape == (3, 3)
    assert matrix.apply(values).tolist() == [[5, 50], [0, 0], [-2, -20]]


def test_equal_places_are_added_up_and_zeros_left_out():
    matrix = make([(0, 1, 0.25), (0, 1, 0.5), (1, 0, 1.0), (1, 0, -1.0)], (2, 2))
    assert matrix.starts.tolist() == [0, 1, 1]
    assert matrix.columns.tolist() == [1]
    assert matrix.weights.tolist() == [0.75]


def test_rows_are_summed_from_the_lowest_column_to_the_highest():
    # In this order the small ones are lost; in any other they are not.
    values = np.array([[1.0], [1e16], [1.0], [-1e16]])
    matrix = make([(0, 3, 1.0), (0, 2, 1.0), (0, 1, 1.0), (0, 0, 1.0)], (1, 4))
    total = 0.0
    for value in values[:, 0]:
        total += value
    assert matrix.apply(values)[0, 0] == total


def test_no_entries_give_zeros():
    none = np.zeros(0, dtype=np.int64)
    matrix = SparseMatrix.from_entries(none, none, np.zeros(0), (3, 2))
    assert matrix.apply(np.ones((2, 4))).tolist() == np.zeros((3, 4)).tolist()


@given(data=st.data(), rows=st.integers(1, 6), columns=st.integers(1, 6))
def test_it_equals_a_dense_matrix(data, rows, columns):
    place = st.tuples(st.integers(0, rows - 1), st.integers(0, columns - 1), st.integers(-8, 8))
    entries = data.draw(st.lists(place, min_size=1, max_size=30))
    dense = np.zeros((rows, columns))
    for row, column, weight in entries:
        dense[row, column] += weight
    values = np.arange(columns * 2.0).reshape(columns, 2)
    np.testing.assert_array_equal(make(entries, (rows, columns)).apply(values), dense @ values)


@given(st.lists(st.tuples(st.integers(0, 70000), st.integers(0, 3)), max_size=40))
def test_pairs_are_sorted_as_python_sorts_them(pairs):
    first, second = np.array(pairs, dtype=np.int64).reshape(-1, 2).T
    order, new = sort_pairs(first, second)
    assert order.tolist() == sorted(range(len(pairs)), key=lambda number: pairs[number])
    assert new.sum() == len(set(pairs))


def test_rows_that_are_no_copy_of_their_column_are_listed():
    matrix = make([(0, 0, 1.0), (1, 1, 2.0), (2, 0, 1.0), (4, 1, 0.5), (4, 2, 0.5)], (5, 3))
    rows, starts, columns, weights = matrix.mixed
    assert rows.tolist() == [1, 2, 3, 4]
    assert starts.tolist() == [0, 1, 2, 2, 4]
    assert columns.tolist() == [1, 0, 1, 2]
    assert weights.tolist() == [2.0, 1.0, 0.5, 0.5]
