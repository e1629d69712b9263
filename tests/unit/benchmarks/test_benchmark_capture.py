"""The benchmark of capture measures what it says, on surveys whose truth is known."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mien.capture.projecting import turn
from mien.capture.records import REST, Solution, SolvedPoint
from mien.capture.simulating import Setup, board, cube, simulate

BENCHMARKS = Path(__file__).parents[3] / "benchmarks"


@pytest.fixture
def captured(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    import captured.chessboards
    import captured.opencv
    import captured.simulated

    return captured


@pytest.fixture
def capture(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    import capture

    return capture


def test_an_error_is_the_root_mean_square_in_percent_of_ten_inches(captured):
    simulated = simulate(Setup(points=4), 1)
    off = dict(zip(["p001", "p002", "p003", "p004"], [0.0, 0.0, 0.00254, 0.00254], strict=True))
    places = {key: true + np.array([0.0, off.get(key[1], 1.0), 0.0]) for key, true in simulated.places.items()}
    assert captured.simulated.error_percent(simulated, places) == pytest.approx(np.sqrt(0.5))


def test_ellipsoids_are_counted_that_hold_the_true_place(captured):
    simulated = simulate(Setup(points=4), 1)
    reach = np.sqrt(captured.simulated.NINETY_FIVE)
    off = {"p001": 0.0, "p002": 0.99 * reach, "p003": 1.01 * reach, "p004": -0.5 * reach}
    points = {}
    for key, true in simulated.places.items():
        name = key[1]
        kind = "measured" if name in off else "reference"
        covariance = np.diag([1e-8, 1e-6, 1e-8])
        place = true + np.array([0.0, 1e-3 * off.get(name, 9.0), 0.0])
        points[key] = SolvedPoint(name, REST, place, covariance, (), kind)
    solution = Solution(simulated.survey, simulated.cameras, points, ())
    assert captured.simulated.coverage(simulated, solution) == (3, 4)


@pytest.mark.parametrize("one_lens", [True, False])
def test_opencv_finds_exact_clicks(captured, one_lens):
    setup = Setup(cube(0.254, 20), points=8, views=3, k1=-0.15, k2=0.02, off_centre=0.01, sigma_px=0.0, distance_m=1.0)
    simulated = simulate(replace(setup, one_lens=one_lens), 1)
    flags = captured.opencv.SETTINGS["all free"]
    places = captured.opencv.locate(simulated.survey, simulated.cameras, flags)
    assert len(places) == 8
    assert captured.simulated.error_percent(simulated, places) < 1e-3


def test_a_true_rig_has_no_held_out_error_and_a_wrong_one_has(captured):
    boards = captured.chessboards
    simulated = simulate(
        Setup(board(boards.COLUMNS, boards.ROWS), 1, 2, 2, sigma_px=0.0, one_lens=False, fixed=True), 1
    )
    rig = boards.rig_of(Solution(simulated.survey, simulated.cameras, {}, ()), ("camera1", "camera2"))
    photographs = [each for each in simulated.survey.photographs if each.moment == "m01"]
    pair = [
        np.array(
            [
                (click.u - 0.5, click.v - 0.5)
                for click in simulated.survey.observations
                if click.photo == photograph.name and click.point.startswith("board")
            ]
        )
        for photograph in photographs
    ]
    px, squares = boards.held_out(rig, tuple(pair))
    assert px.shape == (108,)
    assert squares.shape == (54,)
    assert px.max() < 1e-3
    assert squares.max() < 1e-4
    wrong, its_squares = boards.held_out(replace(rig, shift=1.1 * rig.shift), tuple(pair))
    assert wrong.max() > 1.0
    assert its_squares.max() > 0.1


def test_a_board_is_laid_and_not_scaled(captured):
    flat = captured.chessboards.BOARD.astype(float)
    moved = flat @ turn(np.array([0.3, -0.8, 2.0])).T + [1.0, -2.0, 9.0]
    assert captured.chessboards._laid_on(flat, moved).max() < 1e-9
    from_middle = np.linalg.norm(flat - flat.mean(axis=0), axis=1)
    assert captured.chessboards._laid_on(flat, 1.5 * moved) == pytest.approx(0.5 * from_middle)


def test_mis_clicks_are_hunted(captured):
    hunt = captured.simulated.hunt(simulate(captured.simulated.modern(4, mis_clicks=0.02, mis_click_sigmas=60.0), 3))
    assert hunt.made == hunt.found == 5
    assert hunt.false <= 1
    assert hunt.good == 4 * (20 + 40) - 5


def test_refused_surveys_are_told(capture):
    one = capture.Outcome(0.25)
    assert capture.cell([one, one, capture.Outcome(0.25)]) == "0.250 (0.250)"
    assert capture.cell([one, None]) == "0.250 (0.250), 1 refused"
    assert capture.cell([None]) == "1 refused"


def test_a_set_up_is_a_row(capture, capsys):
    (kept,) = capture.compare([(("here", 2), capture.simulated.modern(2))], range(2))
    assert capsys.readouterr().out.startswith("| here | 2 | ")
    assert 0.04 < kept["metric"][0] < 0.14
    assert 0.5 < kept["beside"][1] < kept["beside"][0] < kept["beside"][2] < 2.0
