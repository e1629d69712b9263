"""Products with a constant sparse matrix, compiled: the same sums in the same order as ``SparseMatrix.apply``."""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: allow-untyped-defs, allow-untyped-calls, no-check-untyped-defs

from __future__ import annotations

from mien.compiling import kernel


@kernel("i8[:], i8[:], f8[:], f8[:,:], i8, i8, f8[:,:]")
def multiply_rows(starts, columns, weights, values, first, last, out):
    """Fill rows first:last of ``out`` (R, 3) with the matrix's products with ``values`` (C, 3)."""
    for row in range(first, last):
        x, y, z = 0.0, 0.0, 0.0
        for entry in range(starts[row], starts[row + 1]):
            column, weight = columns[entry], weights[entry]
            x += weight * values[column, 0]
            y += weight * values[column, 1]
            z += weight * values[column, 2]
        out[row, 0], out[row, 1], out[row, 2] = x, y, z
