"""Decentring and aspect of lenses: seen, taken back, and asked for only where the clicks tell it."""

from dataclasses import replace

import numpy as np
import pytest

from mien.capture.projecting import lens_array, see, undistort
from mien.capture.records import Lens
from mien.capture.simulating import Setup, board, cube, simulate
from mien.capture.solving import solve

LENS = Lens(530.0, (330.0, 240.0), -0.28, 0.1, (), 0.004, -0.003, 1.05)
PLACES = np.array([[0.3, -0.2, 1.0], [-0.8, 0.5, 2.0], [0.0, 0.0, 1.0], [0.5, 0.5, 1.2]])
BOARDS = Setup(board(), points=1, views=2, moments=8, size_px=(640, 480), distance_m=0.4, one_lens=False, fixed=True)


def test_it_moves_what_is_seen_by_hand() -> None:
    seen = see(lens_array(Lens(100.0, (0.0, 0.0), p1=0.01, p2=0.02)), np.array([[1.0, 2.0, 1.0]]))
    # r² = 5: u = 100 (1 + 0.01 · 4 + 0.02 · 7), v = 100 (2 + 0.01 · 13 + 0.02 · 4)
    assert seen[0] == pytest.approx([118.0, 221.0])
    taller = see(lens_array(Lens(100.0, (7.0, 9.0), aspect=1.1)), np.array([[1.0, 2.0, 1.0]]))
    assert taller[0] == pytest.approx([107.0, 229.0])


def test_undistorted_is_the_way_back() -> None:
    directions = undistort(LENS, see(lens_array(LENS), PLACES))
    assert directions == pytest.approx(PLACES[:, :2] / PLACES[:, 2:], abs=1e-10)


def test_it_is_found_where_boards_tell_it() -> None:
    setup = replace(BOARDS, k1=-0.28, k2=0.1, p1=0.004, p2=-0.003, aspect=1.02, sigma_px=0.1)
    simulated = simulate(setup, 1)
    for name, camera in solve(simulated.survey).cameras.items():
        lens, true = camera.lens, simulated.cameras[name].lens
        assert {"decentring", "aspect"} <= set(lens.freed)
        assert lens.aspect == pytest.approx(1.02, abs=1e-3)
        assert (lens.p1, lens.p2) == pytest.approx((true.p1, true.p2), abs=5e-4)
        assert lens.principal_px == pytest.approx(true.principal_px, abs=2.0)


@pytest.mark.parametrize("setup", [Setup(cube(0.254, 8), points=15, k1=-0.1), replace(BOARDS, k1=-0.28, sigma_px=0.1)])
def test_it_is_none_where_they_do_not(setup: Setup) -> None:
    lenses = [camera.lens for camera in solve(simulate(setup, 1).survey).cameras.values()]
    assert {(lens.p1, lens.p2, lens.aspect) for lens in lenses} == {(0.0, 0.0, 1.0)}
    assert not any({"decentring", "aspect"} & set(lens.freed) for lens in lenses)
