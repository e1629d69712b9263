"""Corners of boards in drawn photographs whose corners are known."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from PIL import Image

from mien.capture.board_order import match_direction, order_corners
from mien.capture.board_sigmas import LEAST_PX, USUAL_PX, corner_sigma
from mien.capture.boards import board_references, corner_names, find_board, find_corners
from mien.capture.project_records import Board
from mien.capture.records import Photograph
from mien.core import MienError

CELL = 60
CHESS = Board("board", "chessboard", 10, 7, 0.025)
EVEN = Board("board", "chessboard", 9, 7, 0.025)
CHARUCO = Board("card", "charuco", 8, 6, 0.03, 0.022, "DICT_4X4_50")


def chess_sheet(board: Board) -> np.ndarray:
    """The board as it is printed, dark at the upper left, with a white rim."""
    squares = np.add.outer(np.arange(board.rows), np.arange(board.columns)) % 2 * 255
    return np.pad(np.kron(squares, np.ones((CELL, CELL))).astype(np.uint8), CELL, constant_values=255)


def charuco_sheet(board: Board, legacy: bool = False) -> np.ndarray:
    markers = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, board.dictionary))
    pattern = cv2.aruco.CharucoBoard((board.columns, board.rows), 0.03, 0.022, markers)
    pattern.setLegacyPattern(legacy)
    return np.pad(pattern.generateImage((board.columns * CELL, board.rows * CELL)), CELL, constant_values=255)


def sheet_corners(board: Board) -> np.ndarray:
    """(rows, columns, 2) px of the sheet, from its corner."""
    columns, rows = board.corners
    x, y = np.meshgrid(np.arange(columns), np.arange(rows))
    return CELL * (np.stack([x, y], axis=-1) + 2.0)


def homography(angle_deg: float, scale: float, tilt: float, at: tuple[float, float]) -> np.ndarray:
    """A view of a sheet: turned, sized, tilted, with the middle of the sheet at a place."""
    angle = np.radians(angle_deg)
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    tilted = np.array([[1, 0, 0], [0, 1, 0], [tilt, 0.4 * tilt, 1.0]])
    middle = np.array([[1, 0, -6 * CELL], [0, 1, -4.5 * CELL], [0, 0, 1.0]])
    return np.array([[1, 0, at[0]], [0, 1, at[1]], [0, 0, 1.0]]) @ tilted @ np.diag([scale, scale, 1.0]) @ turn @ middle


def seen(sheet: np.ndarray, view: np.ndarray, size: tuple[int, int] = (1200, 900), noise: float = 3.0) -> np.ndarray:
    """A photograph of a sheet, without stairs at its edges; ``view`` counts from corners of pixels."""
    fine = np.diag([3.0, 3.0, 1.0]) @ view
    half = np.array([[1, 0, 0.5], [0, 1, 0.5], [0, 0, 1.0]])
    middles = np.linalg.inv(half) @ fine @ half
    large = cv2.warpPerspective(sheet, middles, (3 * size[0], 3 * size[1]), borderValue=128, flags=cv2.INTER_LINEAR)
    small = cv2.GaussianBlur(cv2.resize(large, size, interpolation=cv2.INTER_AREA), (0, 0), 0.7).astype(float)
    return np.clip(small + np.random.default_rng(0).normal(0, noise, small.shape), 0, 255).astype(np.uint8)


def moved(view: np.ndarray, corners: np.ndarray) -> np.ndarray:
    whole = np.concatenate([corners, np.ones((*corners.shape[:2], 1))], axis=-1) @ view.T
    return whole[..., :2] / whole[..., 2:]


@pytest.mark.parametrize("angle", [0, 40, -60, 85, 135, 180, 250])
def test_a_chessboard_begins_at_the_same_corner_however_it_is_turned(angle: float) -> None:
    view = homography(angle, 0.9, 2e-4, (600, 450))
    found = find_board(CHESS, seen(chess_sheet(CHESS), view))
    assert found is not None
    error = found - moved(view, sheet_corners(CHESS))
    assert np.abs(error).max() < 0.3
    assert np.sqrt((error**2).mean()) < 0.04


def test_corners_in_a_large_photograph_are_as_exact() -> None:
    view = homography(20, 3.5, 1e-4, (2000, 1500))
    found = find_board(CHESS, seen(chess_sheet(CHESS), view, (4000, 3000)))
    assert found is not None
    assert np.abs(found - moved(view, sheet_corners(CHESS))).max() < 0.3


@pytest.mark.parametrize("scale", [0.9, 3.0])
def test_charuco_also_where_a_part_is_hidden(scale: float) -> None:
    size = (1200, 900) if scale < 1 else (4000, 3000)
    view = homography(110, scale, 1e-4, (size[0] / 2, size[1] / 2))
    picture = seen(charuco_sheet(CHARUCO), view, size)
    picture[:, : int(0.45 * size[0])] = 90
    found = find_board(CHARUCO, picture)
    assert found is not None
    true = moved(view, sheet_corners(CHARUCO))
    shown = np.isfinite(found[..., 0])
    assert 6 <= shown.sum() < 35
    assert np.sqrt(((found[shown] - true[shown]) ** 2).mean()) < 0.08
    assert true[shown][:, 0].min() > 0.45 * size[0]


def test_charuco_of_before_opencv_4_6() -> None:
    view = homography(-30, 0.9, 1e-4, (600, 450))
    found = find_board(CHARUCO, seen(charuco_sheet(CHARUCO, legacy=True), view))
    assert found is not None
    assert np.abs(found - moved(view, sheet_corners(CHARUCO))).max() < 0.6


def test_nothing_is_found_where_there_is_none() -> None:
    noise = np.random.default_rng(1).integers(0, 255, (300, 400), np.uint8)
    assert find_board(CHESS, noise) is None
    assert find_board(CHARUCO, noise) is None


def test_references_are_the_corners_as_the_board_is_made() -> None:
    references = {each.name: (each.x, each.y, each.z, each.target) for each in board_references(CHESS)}
    assert list(references) == corner_names(CHESS)
    assert len(references) == 54
    assert references["board:0:0"] == pytest.approx((0.0, 0.125, 0.0, "board"))
    assert references["board:5:8"] == pytest.approx((0.2, 0.0, 0.0, "board"))


def test_seen_from_its_front_the_frame_of_a_board_is_right_handed() -> None:
    """x to the right, y up, z towards who looks: the corners of a board seen upright lie so in the picture."""
    view = homography(0, 0.9, 0.0, (600, 450))
    found = find_board(CHESS, seen(chess_sheet(CHESS), view))
    assert found is not None
    places = {each.name: each for each in board_references(CHESS)}
    right, up = places["board:0:1"], places["board:0:0"]
    assert found[0, 1, 0] > found[0, 0, 0]
    assert right.x > places["board:0:0"].x
    assert found[0, 0, 1] < found[1, 0, 1]
    assert up.y > places["board:1:0"].y


def test_a_mirrored_grid_is_turned_to_its_front() -> None:
    sheet, grid = chess_sheet(CHESS), sheet_corners(CHESS) - 0.5
    for mirrored in (grid, grid[:, ::-1], grid[::-1], grid[::-1, ::-1]):
        np.testing.assert_array_equal(order_corners(mirrored, sheet), grid)


def test_a_board_that_looks_alike_upside_down_lies_as_in_another_photograph() -> None:
    grid = sheet_corners(EVEN)
    leaning = moved(homography(80, 1.0, 0.0, (0, 0)), grid)
    over = moved(homography(110, 1.0, 0.0, (0, 0)), grid)
    np.testing.assert_array_equal(match_direction(over[::-1, ::-1], leaning), over)
    np.testing.assert_array_equal(match_direction(over, leaning), over)
    other = sheet_corners(CHESS)
    np.testing.assert_array_equal(match_direction(other[::-1, ::-1], other), other[::-1, ::-1])


def test_sigma_is_the_noise_of_the_corners() -> None:
    grid = moved(homography(25, 1.0, 4e-4, (600, 450)), sheet_corners(CHESS))
    bent = grid + 2e-8 * (grid - 600.0) * ((grid - 600.0) ** 2).sum(axis=-1, keepdims=True)
    assert corner_sigma(bent) == LEAST_PX
    noises = [np.random.default_rng(seed).normal(0, 0.4, grid.shape) for seed in range(20)]
    assert np.mean([corner_sigma(bent + noise) for noise in noises]) == pytest.approx(0.4, rel=0.06)
    hidden = bent.copy()
    hidden[2:] = np.nan
    assert corner_sigma(hidden) == USUAL_PX


def photos(folder: Path, *pictures: np.ndarray) -> list[Photograph]:
    found = []
    for number, picture in enumerate(pictures):
        path = folder / f"{number}.png"
        Image.fromarray(picture).save(path)
        found.append(Photograph(path.name, picture.shape[::-1], "a", "smile", path=path))
    return found


def test_corners_are_named_and_one_search_each_is_told(tmp_path: Path) -> None:
    views = [homography(angle, 0.9, 2e-4, (600, 450)) for angle in (10, 170)]
    pictures = photos(tmp_path, *(seen(chess_sheet(EVEN), view) for view in views), np.full((90, 120), 200, np.uint8))
    told: list[tuple[int, int]] = []
    found = {(each.photo, each.point): each for each in find_corners([EVEN], pictures, lambda *each: told.append(each))}
    assert told == [(0, 3), (1, 3), (2, 3), (3, 3)]
    assert len(found) == 2 * 48
    corner = found["0.png", "board:0:0"]
    assert (corner.u, corner.v) == pytest.approx(tuple(moved(views[0], sheet_corners(EVEN))[0, 0]), abs=0.3)
    assert LEAST_PX <= corner.sigma_px < 0.2
    turned = found["1.png", "board:0:0"]  # more than a quarter of a turn away: taken for the other end
    assert (turned.u, turned.v) == pytest.approx(tuple(moved(views[1], sheet_corners(EVEN))[-1, -1]), abs=0.3)


def test_boards_that_are_not_there_are_told(tmp_path: Path) -> None:
    pictures = photos(tmp_path, np.full((90, 120), 200, np.uint8))
    with pytest.raises(MienError, match=r"board 'board' is in none of the photographs — want all of its 10x7 squares"):
        find_corners([CHESS], pictures)
    named = Board("card", "charuco", 8, 6, 0.03, 0.022, "DICT_4X4_50", ("0.png",))
    with pytest.raises(MienError, match=r"0\.png: the board 'card' is not found — want 8x6 squares with markers"):
        find_corners([named], pictures)
    with pytest.raises(MienError, match=r"b\.png: the file is not there to look for the board 'board' in"):
        find_corners([CHESS], [Photograph("b.png", (9, 9), "a")])
