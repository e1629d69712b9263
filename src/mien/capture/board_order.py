"""Which corner of a chessboard is the first: seen from the front, on a black square, the same in all photographs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mien.core.mesh import Points

PLAIN = 8.0
"""Squares that differ by less brightness (of 255) do not tell where the board begins."""


def order_corners(grid: Points, gray: NDArray[np.uint8]) -> Points:
    """The grid turned so that rows run to the right and columns down as the board is seen from its front.

    Of the turns that are left, the first square between corners is dark if not all of them look alike; then the rows
    run to the right in the picture.

    Args:
        grid: (R, C, 2) px from the middle of the first pixel.
        gray: (H, W) 0..255.
    """
    grid = grid if _is_from_front(grid) else grid[:, ::-1]
    turns = _turns(grid)
    dark = [turned for turned in turns if _begins_dark(turned, gray)]
    return max(dark or turns, key=lambda turned: float(_direction(turned)[0]))


def match_direction(grid: Points, other: Points) -> Points:
    """The grid turned so that its rows run as in another photograph, as far as its squares leave that open."""
    if not _looks_alike(grid.shape[0], grid.shape[1]):
        return grid
    turns = _turns(grid) if grid.shape[0] == grid.shape[1] and grid.shape[0] % 2 == 0 else [grid, grid[::-1, ::-1]]
    return max(turns, key=lambda turned: float(_direction(turned) @ _direction(other)))


def _looks_alike(rows: int, columns: int) -> bool:
    """Whether a board with so many corners is the same upside down: its squares are odd or even both ways."""
    return (rows - columns) % 2 == 0


def _turns(grid: Points) -> list[Points]:
    """The grid as it can be turned without changing its shape."""
    half = [grid, grid[::-1, ::-1]]
    if grid.shape[0] != grid.shape[1]:
        return half
    quarter = grid.transpose(1, 0, 2)[:, ::-1]
    return [*half, quarter, quarter[::-1, ::-1]]


def _is_from_front(grid: Points) -> bool:
    right, down = grid[:, -1] - grid[:, 0], grid[-1] - grid[0]
    along, across = right.mean(axis=0), down.mean(axis=0)
    return bool(along[0] * across[1] - along[1] * across[0] > 0.0)


def _direction(grid: Points) -> Points:
    """Unit vector along the rows."""
    along = (grid[:, -1] - grid[:, 0]).mean(axis=0)
    return np.asarray(along / np.linalg.norm(along))


def _begins_dark(grid: Points, gray: NDArray[np.uint8]) -> bool:
    """Whether the square between the first four corners is one of the dark ones."""
    middles = (grid[:-1, :-1] + grid[:-1, 1:] + grid[1:, :-1] + grid[1:, 1:]) / 4.0
    columns, rows = np.rint(middles).astype(int).reshape(-1, 2).T
    height, width = gray.shape
    light = gray[np.clip(rows, 0, height - 1), np.clip(columns, 0, width - 1)].astype(float).reshape(middles.shape[:2])
    odd = np.add.outer(np.arange(light.shape[0]), np.arange(light.shape[1])) % 2 == 1
    return bool(light[odd].mean() - light[~odd].mean() > PLAIN) if odd.any() else True
