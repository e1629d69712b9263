"""A constant sparse matrix whose products are summed in a fixed order."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def sort_pairs(first: Ints, second: Ints) -> tuple[Ints, NDArray[np.bool_]]:
    """Order (N,) of pairs by first, then second number, equal ones as given; and whether each begins a new pair."""
    order = stable_order(second)
    order = order[stable_order(first[order])]
    a, b = first[order], second[order]
    new = np.ones(len(order), dtype=bool)
    new[1:] = (a[1:] != a[:-1]) | (b[1:] != b[:-1])
    return order, new


def stable_order(numbers: Ints) -> Ints:
    """Order (N,) of whole numbers, equal ones as given."""
    # NumPy sorts numbers of sixteen bits by their digits, in a tenth of the time that comparing takes.
    small = not len(numbers) or (numbers.min() >= 0 and numbers.max() < 1 << 16)
    return np.argsort(numbers.astype(np.uint16) if small else numbers, kind="stable")


@dataclass(frozen=True, eq=False)
class SparseMatrix:
    """Rows of (column, weight) pairs, in compressed rows: row r has entries ``starts[r]:starts[r + 1]``."""

    starts: Ints
    columns: Ints
    weights: Floats
    column_count: int

    @classmethod
    def from_entries(cls, rows: Ints, columns: Ints, weights: Floats, shape: tuple[int, int]) -> SparseMatrix:
        """The matrix with these entries; equal places are added up in the order given."""
        order, new = sort_pairs(rows, columns)
        # In order, one after the other: the sum of many weights depends on it.
        summed = np.bincount(np.cumsum(new) - 1, weights[order]) if len(order) else np.zeros(0)
        first = order[new]
        keep = summed != 0.0
        counts = np.bincount(rows[first[keep]], minlength=shape[0])
        starts = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
        return cls(starts, columns[first[keep]].astype(np.int64), summed[keep], shape[1])

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)."""
        return len(self.starts) - 1, self.column_count

    @cached_property
    def mixed(self) -> tuple[Ints, Ints, NDArray[np.uint32], Floats]:
        """The rows (M,) that are no mere copies of the column of their number; starts, columns and weights of them."""
        counts, number = np.diff(self.starts), np.arange(self.shape[0])
        first = np.minimum(self.starts[:-1], len(self.columns) - 1)
        rows = np.flatnonzero((counts != 1) | (self.columns[first] != number) | (self.weights[first] != 1.0))
        starts = np.concatenate([[0], np.cumsum(counts[rows])]).astype(np.int64)
        entries = np.repeat(self.starts[rows] - starts[:-1], counts[rows]) + np.arange(starts[-1])
        return rows, starts, self.columns[entries].astype(np.uint32), self.weights[entries]

    @cached_property
    def _diagonals(self) -> tuple[Ints, list[tuple[Ints, Floats]]]:
        """Rows from most entries to fewest, and the k-th entry of each row that has one: short, dense passes."""
        counts = np.diff(self.starts)
        order = np.argsort(-counts, kind="stable")
        passes = []
        for k in range(int(counts.max()) if len(counts) else 0):
            entries = self.starts[order[: int((counts > k).sum())]] + k
            passes.append((self.columns[entries], self.weights[entries][:, None]))
        return order, passes

    def after(self, first: SparseMatrix) -> SparseMatrix:
        """The matrix that does what ``first`` and then this one do."""
        counts = np.diff(first.starts)[self.columns]
        row = np.repeat(np.arange(self.shape[0]), np.diff(self.starts))
        before = np.cumsum(counts) - counts
        entries = np.repeat(first.starts[self.columns] - before, counts) + np.arange(int(counts.sum()))
        weights = np.repeat(self.weights, counts) * first.weights[entries]
        shape = (self.shape[0], first.shape[1])
        return SparseMatrix.from_entries(np.repeat(row, counts), first.columns[entries], weights, shape)

    def apply(self, values: Floats) -> Floats:
        """(rows, K) products with values (columns, K), each summed from the lowest column to the highest."""
        order, passes = self._diagonals
        total = np.zeros((self.shape[0], values.shape[1]))
        for columns, weights in passes:
            total[: len(columns)] += weights * values[columns]
        out = np.empty_like(total)
        out[order] = total
        return out
