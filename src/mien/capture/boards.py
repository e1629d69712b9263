"""Corners of chessboards and ChArUco boards, found in photographs by OpenCV.

A corner is called ``target:row:column``, both from 0 at the upper left of the board. In the frame of the board x runs
along its rows to the right, y up and z out of it, from its lower left corner.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mien.core import MienError
from mien.core.mesh import Points

from .board_corners import find_charuco, find_chessboard
from .board_order import match_direction
from .board_sigmas import corner_sigma
from .photographs import read_gray
from .project_records import Board
from .records import Observation, Photograph, Reference

LEAST_CORNERS = 6
"""Fewer of a ChArUco board tell little of where it lies, and are wrong more often than not."""


def corner_name(board: Board, row: int, column: int) -> str:
    """What a corner is called."""
    return f"{board.target}:{row}:{column}"


def corner_names(board: Board) -> list[str]:
    """Names of all corners, row by row."""
    columns, rows = board.corners
    return [corner_name(board, row, column) for row in range(rows) for column in range(columns)]


def board_references(board: Board) -> list[Reference]:
    """Where its corners are in the frame of the board."""
    columns, rows = board.corners
    return [
        Reference(
            corner_name(board, row, column),
            column * board.square_m,
            (rows - 1 - row) * board.square_m,
            0.0,
            target=board.target,
        )
        for row in range(rows)
        for column in range(columns)
    ]


def find_corners(
    boards: Sequence[Board], photographs: Sequence[Photograph], report: Callable[[int, int], None] | None = None
) -> tuple[Observation, ...]:
    """Corners of boards seen in photographs, with how exact they are.

    A chessboard that looks the same upside down is taken to lie the same way round in all photographs of a moment,
    within a quarter of a turn.

    Args:
        boards: to look for.
        photographs: to look in.
        report: is told how many searches are done, and how many there are.

    Raises:
        MienError: a board is not in a photograph that it is said to be in, or in none; a photograph is not there.
    """
    searches = [(board, photo) for board in boards for photo in photographs if board.may_be_in(photo.name)]
    found: list[Observation] = []
    directions: dict[tuple[str, str], Points] = {}
    for done, (board, photo) in enumerate(searches):
        if report is not None:
            report(done, len(searches))
        corners = find_board(board, read_gray(_path(photo, board)))
        if corners is None:
            _check_unnamed(board, photo)
            continue
        if board.kind == "chessboard":
            corners = match_direction(corners, directions.setdefault((board.target, photo.moment), corners))
        found += _observations(board, photo, corners)
    if report is not None and searches:
        report(len(searches), len(searches))
    for board in boards:
        if not any(each.point.startswith(f"{board.target}:") for each in found):
            raise MienError(f"board {board.target!r} is in none of the photographs — {_advice(board)}")
    return tuple(found)


def find_board(board: Board, gray: NDArray[np.uint8]) -> Points | None:
    """Its corners in a picture, (rows, columns, 2) px, NaN where one is not seen; nothing if it is not there."""
    if board.kind == "chessboard":
        return find_chessboard(gray, board.corners)
    corners = find_charuco(gray, board)
    return None if np.isfinite(corners[..., 0]).sum() < LEAST_CORNERS else corners


def _path(photo: Photograph, board: Board) -> Path:
    if photo.path is None:
        raise MienError(
            f"{photo.name}: the file is not there to look for the board {board.target!r} in — put it into the folder, "
            "or keep boards.csv of an earlier run"
        )
    return photo.path


def _check_unnamed(board: Board, photo: Photograph) -> None:
    if board.photographs:
        raise MienError(
            f"{photo.name}: the board {board.target!r} is not found — {_advice(board)}, or take the photograph out of "
            "'photographs' of the board"
        )


def _advice(board: Board) -> str:
    across, down = board.columns, board.rows
    if board.kind == "charuco":
        return f"want {across}x{down} squares with markers of {board.dictionary}, sharp and with light from all sides"
    return f"want all of its {across}x{down} squares (not corners) in the picture, sharp, with a white rim around them"


def _observations(board: Board, photo: Photograph, corners: Points) -> Iterable[Observation]:
    sigma = corner_sigma(corners)
    for row, column in np.argwhere(np.isfinite(corners[..., 0])):
        u, v = (round(float(x), 3) for x in corners[row, column])
        yield Observation(photo.name, corner_name(board, row, column), u, v, sigma)
