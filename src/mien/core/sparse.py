"""A constant sparse matrix whose products are summed in a fixed order."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


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
        order = np.lexsort((columns, rows))
        rows, columns, weights = rows[order], columns[order], weights[order]
        new = np.ones(len(rows), dtype=bool)
        new[1:] = (rows[1:] != rows[:-1]) | (columns[1:] != columns[:-1])
        place = np.cumsum(new) - 1
        summed = np.zeros(int(place[-1]) + 1 if len(place) else 0)
        np.add.at(summed, place, weights)
        rows, columns = rows[new], columns[new]
        keep = summed != 0.0
        counts = np.bincount(rows[keep], minlength=shape[0])
        starts = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
        return cls(starts, columns[keep].astype(np.int64), summed[keep], shape[1])

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)."""
        return len(self.starts) - 1, self.column_count

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

    def apply(self, values: Floats) -> Floats:
        """(rows, K) products with values (columns, K), each summed from the lowest column to the highest."""
        order, passes = self._diagonals
        total = np.zeros((self.shape[0], values.shape[1]))
        for columns, weights in passes:
            total[: len(columns)] += weights * values[columns]
        out = np.empty_like(total)
        out[order] = total
        return out
