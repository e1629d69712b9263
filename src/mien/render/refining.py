"""Products with a constant sparse matrix, compiled: the same sums in the same order as ``SparseMatrix.apply``."""

# Numba finds the types of arguments by itself, so that the functions below name none.
# mypy: allow-untyped-defs, allow-untyped-calls, no-check-untyped-defs

from __future__ import annotations

from mien.compiling import kernel


@kernel("i8[:], i8[:], u4[:], f8[:], f8[:,:], i8, i8, f8[:,:]")
def multiply_rows(rows, starts, columns, weights, values, first, last, out):
    """Fill the rows ``rows[first:last]`` of ``out`` (R, 3) with the matrix's products with ``values`` (C, 3)."""
    for n in range(first, last):
        x, y, z = 0.0, 0.0, 0.0
        for entry in range(starts[n], starts[n + 1]):
            column, weight = columns[entry], weights[entry]
            x += weight * values[column, 0]
            y += weight * values[column, 1]
            z += weight * values[column, 2]
        row = rows[n]
        out[row, 0], out[row, 1], out[row, 2] = x, y, z


@kernel("i8[:], i8[:], u4[:], f8[:], f8[:,:], f8[:,:], i8, i8, f8[:,:], f8[:,:]")
def multiply_rows_by_two(rows, starts, columns, weights, values, others, first, last, out, other_out):
    """The same for two values at once: the entries are read once only."""
    for n in range(first, last):
        x, y, z = 0.0, 0.0, 0.0
        r, g, b = 0.0, 0.0, 0.0
        for entry in range(starts[n], starts[n + 1]):
            column, weight = columns[entry], weights[entry]
            x += weight * values[column, 0]
            y += weight * values[column, 1]
            z += weight * values[column, 2]
            r += weight * others[column, 0]
            g += weight * others[column, 1]
            b += weight * others[column, 2]
        row = rows[n]
        out[row, 0], out[row, 1], out[row, 2] = x, y, z
        other_out[row, 0], other_out[row, 1], other_out[row, 2] = r, g, b
