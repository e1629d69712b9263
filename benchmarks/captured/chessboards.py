"""Stereo photographs of a chessboard, by us and by ``cv2.stereoCalibrate``, judged on pairs that neither had.

The board of a held-out pair is laid, six numbers, where it fits its corners in both photographs best; what remains is
the error in pixels. Its corners triangulated, and laid on a board of true size, give the error in space.
"""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from scipy.optimize import least_squares

from mien.capture.records import Observation, Photograph, Reference, Solution, Survey
from mien.capture.solving import solve

PACKAGE = "opencv-doc"
INSIDE = "usr/share/doc/opencv-doc/examples/data"
COLUMNS, ROWS = 9, 6
SQUARE_M = 0.025
"""Nobody has told the size of the squares: errors are given as shares of one."""

WINDOW_PX = 5
SIGMA_PX = 0.2
SIDES = ("left", "right")
BOARD = np.array([(x, y, 0.0) for y in range(ROWS) for x in range(COLUMNS)], dtype=np.float32)
UNTIL = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 100, 1e-9)
PEERS = {
    "stereoCalibrate, its defaults": 0,
    "stereoCalibrate, k1 k2 p1 p2": cv2.CALIB_FIX_K3,
    "stereoCalibrate, square pixels, k1 k2 p1 p2": cv2.CALIB_FIX_K3 | cv2.CALIB_FIX_ASPECT_RATIO,
    "stereoCalibrate, square pixels, k1 k2": cv2.CALIB_FIX_K3
    | cv2.CALIB_FIX_ASPECT_RATIO
    | cv2.CALIB_ZERO_TANGENT_DIST,
}

Corners = Mapping[str, tuple[np.ndarray, np.ndarray]]
"""(54, 2) px of OpenCV in the left and the right photograph, by pair."""


@dataclass(frozen=True)
class Rig:
    """Two lenses, (3, 3) and (5,), and (3, 3), (3,) squares from the left camera to the right one."""

    matrices: tuple[np.ndarray, np.ndarray]
    distortions: tuple[np.ndarray, np.ndarray]
    turn: np.ndarray
    shift: np.ndarray


@contextmanager
def photographs(folder: Path | None) -> Iterator[Path]:
    """The folder, or one of Debian's package that lasts as long as it is needed."""
    if folder is not None:
        yield folder
        return
    with tempfile.TemporaryDirectory() as temporary:
        subprocess.run(["apt-get", "download", "-q", PACKAGE], cwd=temporary, check=True, capture_output=True)
        package = next(Path(temporary).glob(f"{PACKAGE}_*.deb"))
        subprocess.run(["dpkg-deb", "-x", package, temporary], check=True)
        yield Path(temporary) / INSIDE


def find_corners(folder: Path) -> tuple[Corners, tuple[int, int]]:
    """Corners of all pairs in which the whole board is found, and (width, height) px."""
    found, size = {}, (0, 0)
    for left in sorted(folder.glob("left[0-9][0-9].jpg")):
        pair = []
        for path in (left, left.with_name(left.name.replace("left", "right"))):
            gray = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
            seen, rough = cv2.findChessboardCorners(gray, (COLUMNS, ROWS))
            size = (gray.shape[1], gray.shape[0])
            if seen:
                fine = cv2.cornerSubPix(gray, rough, (WINDOW_PX, WINDOW_PX), (-1, -1), (3, 50, 1e-4))
                pair.append(fine.reshape(-1, 2))
        if len(pair) == len(SIDES):
            found[left.stem.removeprefix("left")] = (pair[0], pair[1])
    return found, size


def opencv_rig(corners: Corners, size: tuple[int, int], flags: int) -> Rig:
    """What OpenCV makes of these pairs: each camera by itself, then both together."""
    world, flags = [BOARD] * len(corners), flags | cv2.CALIB_USE_INTRINSIC_GUESS
    pictures = [[pair[side] for pair in corners.values()] for side in (0, 1)]
    lenses = []
    for seen in pictures:
        guess = cv2.initCameraMatrix2D(world, seen, size)
        lenses += cv2.calibrateCamera(world, seen, size, guess, None, flags=flags, criteria=UNTIL)[1:3]
    _, *found = cv2.stereoCalibrate(world, *pictures, *lenses, size, flags=flags, criteria=UNTIL)
    one, bent, other, its_bent, turn, shift = found[:6]
    return Rig((one, other), (bent.ravel(), its_bent.ravel()), turn, shift.ravel())


def our_rig(corners: Corners, size: tuple[int, int]) -> Rig:
    """What mien makes of them."""
    return rig_of(solve(survey_of(corners, size)))


def survey_of(corners: Corners, size: tuple[int, int]) -> Survey:
    """Two cameras on tripods and a board that is held before them."""
    names = [f"corner {number}" for number in range(len(BOARD))]
    references = [
        Reference(name, *(SQUARE_M * float(value) for value in place), target="board")
        for name, place in zip(names, BOARD, strict=True)
    ]
    taken, clicks = [], []
    for moment, pair in corners.items():
        for side, seen in zip(SIDES, pair, strict=True):
            photograph = Photograph(f"{side}{moment}.jpg", size, side, moment, fixed=True)
            taken.append(photograph)
            clicks += [
                Observation(photograph.name, name, float(u) + 0.5, float(v) + 0.5, SIGMA_PX)
                for name, (u, v) in zip(names, seen, strict=True)
            ]
    return Survey(tuple(taken), tuple(clicks), tuple(references))


def rig_of(solution: Solution, sides: Sequence[str] = SIDES) -> Rig:
    """A solution of such a survey in the terms of OpenCV."""
    left, right = (
        next(solution.cameras[each.name] for each in solution.survey.photographs if each.camera == side)
        for side in sides
    )
    matrices, distortions = [], []
    for lens in (left.lens, right.lens):
        (u, v), focal = lens.principal_px, lens.focal_px
        matrices.append(np.array([[focal, 0.0, u - 0.5], [0.0, focal * lens.aspect, v - 0.5], [0.0, 0.0, 1.0]]))
        distortions.append(np.array([lens.k1, lens.k2, lens.p1, lens.p2, 0.0]))
    shift = right.rotation @ (left.place - right.place) / SQUARE_M
    return Rig((matrices[0], matrices[1]), (distortions[0], distortions[1]), right.rotation @ left.rotation.T, shift)


def held_out(rig: Rig, pair: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Errors (108,) px of the corners of a pair the rig was not made from, and (54,) squares."""
    turn, shift = cv2.solvePnP(BOARD, pair[0], rig.matrices[0], rig.distortions[0])[1:3]

    def residual(laid: np.ndarray) -> np.ndarray:
        turned = rig.turn @ cv2.Rodrigues(laid[:3])[0]
        places = (laid[:3], laid[3:]), (cv2.Rodrigues(turned)[0], rig.turn @ laid[3:] + rig.shift)
        off = [
            cv2.projectPoints(BOARD, *place, matrix, bent)[0].reshape(-1, 2) - seen
            for place, matrix, bent, seen in zip(places, rig.matrices, rig.distortions, pair, strict=True)
        ]
        return np.concatenate(off).ravel()

    off = residual(least_squares(residual, np.concatenate([turn.ravel(), shift.ravel()]), xtol=1e-10).x)
    rays = [
        cv2.undistortPoints(seen[:, None].astype(float), matrix, bent).reshape(-1, 2).T
        for seen, matrix, bent in zip(pair, rig.matrices, rig.distortions, strict=True)
    ]
    found = cv2.triangulatePoints(np.eye(3, 4), np.column_stack([rig.turn, rig.shift]), *rays)
    return np.linalg.norm(off.reshape(-1, 2), axis=1), _laid_on(BOARD, (found[:3] / found[3]).T)


def _laid_on(board: np.ndarray, found: np.ndarray) -> np.ndarray:
    """Distances (N,) of points from a board moved, but not scaled, to fit them.

    Source: Kabsch 1976, "A solution for the best rotation to relate two sets of vectors".
    """
    one, other = board - board.mean(axis=0), found - found.mean(axis=0)
    left, _, right = np.linalg.svd(one.T @ other)
    handed = np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    return np.linalg.norm(one @ left @ handed @ right - other, axis=1)


def cross_validate(folder: Path, folds: int) -> Iterator[tuple[str, float, float]]:
    """(calibration, px, squares): root mean square errors of corners left out; every pair is left out once."""
    corners, size = find_corners(folder)
    names = list(corners)
    makers = {"mien": lambda chosen: our_rig(chosen, size)}
    makers |= {name: lambda chosen, flags=flags: opencv_rig(chosen, size, flags) for name, flags in PEERS.items()}
    for maker_name, make in makers.items():
        off: list[tuple[np.ndarray, np.ndarray]] = []
        for fold in range(folds):
            left_out: Sequence[str] = names[fold::folds]
            rig = make({name: pair for name, pair in corners.items() if name not in left_out})
            off += [held_out(rig, corners[name]) for name in left_out]
        px, squares = (float(np.sqrt((np.concatenate(each) ** 2).mean())) for each in zip(*off, strict=True))
        yield maker_name, px, squares
