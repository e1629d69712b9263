"""What OpenCV sees of boards: corners in pixels, row by row.

Source: Duda and Frese 2018, "Accurate detection and localization of checkerboard corners for calibration" (sectors);
Garrido-Jurado et al. 2014, "Automatic generation and detection of highly reliable fiducial markers" (ChArUco).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mien.core.mesh import Points

from .board_order import order_corners
from .project_records import Board

LONGEST_PX = 1600
"""Boards are looked for in pictures no longer than that; their corners are then placed in the whole one."""

CHESSBOARD_WINDOW = 0.3
"""Of the least side of a square: more takes in other corners where a board is seen aslant. On the stereo photographs
that come with OpenCV's documentation 80 of 1404 corners were taken for mis-clicks without it, and 10 with it."""

MARKER_WINDOW = 0.9
"""Of what is clear of markers around a corner."""

HALF_PX = 0.5
"""OpenCV counts from the middle of the first pixel, and we from its corner."""


def find_chessboard(gray: NDArray[np.uint8], size: tuple[int, int]) -> Points | None:
    """Corners of a chessboard, (rows, columns, 2) px; nothing if it is not seen as a whole.

    Args:
        gray: (H, W) 0..255.
        size: corners between squares, (columns, rows).
    """
    import cv2

    small, scale = _reduced(gray)
    found, corners = cv2.findChessboardCornersSB(small, size, flags=cv2.CALIB_CB_EXHAUSTIVE)
    if not found:
        flags = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE
        found, corners = cv2.findChessboardCorners(small, size, flags=flags)
    if not found:
        return None
    grid = _enlarged(np.asarray(corners, float).reshape(size[1], size[0], 2), scale)
    return order_corners(_refined(gray, grid, CHESSBOARD_WINDOW), gray) + HALF_PX


def find_charuco(gray: NDArray[np.uint8], board: Board) -> Points:
    """Corners of a ChArUco board, (rows, columns, 2) px, NaN where one is not seen."""
    small, scale = _reduced(gray)
    grids = [_detect_charuco(small, board, legacy) for legacy in (False, True)]
    grid = _enlarged(max(grids, key=lambda each: int(np.isfinite(each).sum())), scale)
    clear = (1.0 - board.marker_m / board.square_m) / 2.0  # of a square, from its corner to the marker in it
    return _refined(gray, grid, MARKER_WINDOW * clear) + HALF_PX


def _detect_charuco(gray: NDArray[np.uint8], board: Board, legacy: bool) -> Points:
    """As ``find_charuco``; ``legacy`` boards, made before OpenCV 4.6, begin with a marker if their rows are even."""
    import cv2

    columns, rows = board.corners
    grid = np.full((rows * columns, 2), np.nan)
    markers = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, board.dictionary))
    pattern: Any = cv2.aruco.CharucoBoard((board.columns, board.rows), board.square_m, board.marker_m, markers)
    pattern.setLegacyPattern(legacy)
    corners, numbers, _, _ = cv2.aruco.CharucoDetector(pattern).detectBoard(gray)
    if numbers is not None and len(numbers):
        grid[np.asarray(numbers).ravel()] = np.asarray(corners, float).reshape(-1, 2)
    return grid.reshape(rows, columns, 2)


def _reduced(gray: NDArray[np.uint8]) -> tuple[NDArray[np.uint8], float]:
    """The picture in a size that is searched quickly, and how much smaller it is."""
    import cv2

    scale = max(gray.shape) / LONGEST_PX
    if scale <= 1.0:
        return gray, 1.0
    height, width = gray.shape
    small = cv2.resize(gray, (round(width / scale), round(height / scale)), interpolation=cv2.INTER_AREA)
    return np.asarray(small, np.uint8), scale


def _enlarged(grid: Points, scale: float) -> Points:
    """Corners in the whole picture, still counted from the middle of its first pixel."""
    return (grid + HALF_PX) * scale - HALF_PX


def _refined(gray: NDArray[np.uint8], grid: Points, window: float) -> Points:
    """Corners moved to where the edges of the squares cross, by what is seen so much of a square around them."""
    import cv2

    seen = np.isfinite(grid[..., 0])
    if not seen.any():
        return grid
    half = int(np.clip(window * _least_side(grid), 2, 25))
    stop = (cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_MAX_ITER, 60, 1e-4)
    points = grid[seen].astype(np.float32).reshape(-1, 1, 2)
    moved = cv2.cornerSubPix(gray, points, (half, half), (-1, -1), stop)
    refined = grid.copy()
    refined[seen] = np.asarray(moved, float).reshape(-1, 2)
    return refined


def _least_side(grid: Points) -> float:
    """The shortest side of a square that is seen, px."""
    sides = np.concatenate([np.linalg.norm(np.diff(grid, axis=axis), axis=-1).ravel() for axis in (0, 1)])
    sides = sides[np.isfinite(sides)]
    return float(sides.min()) if sides.size else 8.0
