"""Points of several moments as phases of one face."""

from __future__ import annotations

import numpy as np
import pytest

from mien.capture.bodies import fit_centre, settle_bodies
from mien.capture.marks import Marks, plain_marks
from mien.capture.phases import measure_phases
from mien.capture.records import Photograph, Solution, SolvedPoint, Survey
from mien.capture.registering import Motion
from mien.core import UnknownNameError
from mien.faces.keypose.records import KeyposeTopology, Polygon, SkinPart

SIDE = 5
"""Points of a side of the patch of skin that is measured here."""
GRID = np.array(
    [[0.02 * column, 0.02 * row, 0.002 * (row - column) ** 2] for row in range(SIDE) for column in range(SIDE)]
)
TURN = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])


def patch() -> KeyposeTopology:
    """Squares over the grid; its first column is the midline."""
    corners = [
        (a, a + SIDE, a + SIDE + 1, a + 1) for row in range(SIDE - 1) for a in range(row * SIDE + 1, row * SIDE + SIDE)
    ]
    midline = tuple(range(1, SIDE * SIDE, SIDE))
    return KeyposeTopology((SkinPart("skin", tuple(Polygon(row, "#c0a090") for row in corners)),), midline)


def solution(moments: dict[str, np.ndarray], hidden: dict[str, tuple[int, ...]], sigma_m: float = 1e-5) -> Solution:
    """A solution of points called 1, 2, …, without those that are hidden (from 0)."""
    points = {
        (moment, str(k + 1)): SolvedPoint(str(k + 1), moment, place, np.eye(3) * sigma_m**2, ("a.jpg", "b.jpg"))
        for moment, places in moments.items()
        for k, place in enumerate(places)
        if k not in hidden.get(moment, ())
    }
    photographs = tuple(Photograph(f"{moment}.jpg", (100, 100), "a", moment) for moment in moments)
    return Solution(Survey(photographs, (), ()), {}, points, ())


def moved(places: np.ndarray, turn: np.ndarray = TURN) -> np.ndarray:
    """A head that is held another way."""
    return places @ turn.T + [0.3, -0.1, 0.2]


def test_a_head_that_turns_and_smiles_keeps_still_but_for_the_smile():
    smile = GRID.copy()
    smile[20:] += [0.0, 0.003, 0.0]
    marks = Marks(plain_marks(25).names, ("",) * 25, ((),) * 25, GRID)
    found = measure_phases(solution({"rest": GRID, "smile": moved(smile)}, {}), patch(), marks)
    assert found.names == ("rest", "smile")
    np.testing.assert_allclose(found.places[0], GRID, atol=2e-5)
    np.testing.assert_allclose(found.places[1], smile, atol=6e-5)
    assert found.measured.all()
    assert not found.remarks


def test_hidden_points_are_guessed_and_told():
    marks = Marks(plain_marks(25).names, ("",) * 25, ((),) * 25, GRID)
    found = measure_phases(solution({"rest": GRID + np.array([0.0, 0.001, 0.0])}, {"rest": (12, 13)}), patch(), marks)
    np.testing.assert_allclose(found.places[0][12:14] - found.places[0][7:9], GRID[12:14] - GRID[7:9], atol=1e-4)
    assert found.measured[0].sum() == 23
    assert found.remarks[0] == "rest: 2 of 25 points were not measured, they are guessed from neighbours."
    assert found.remarks[1] == "2 points were measured at no moment: 13, 14"


def test_the_midline_comes_to_lie_on_the_plane_of_symmetry():
    marks = Marks(plain_marks(25).names, ("",) * 25, ((),) * 25, GRID)
    turn = np.array([[np.cos(0.02), 0.0, np.sin(0.02)], [0.0, 1.0, 0.0], [-np.sin(0.02), 0.0, np.cos(0.02)]])
    found = measure_phases(solution({"rest": moved(GRID, turn)}, {}), patch(), marks)
    np.testing.assert_allclose(found.places[0][::5, 0], 0.0, atol=1e-12)
    np.testing.assert_allclose(found.places[0], GRID, atol=5e-5)


def test_points_known_too_badly_are_not_believed():
    marks = Marks(plain_marks(25).names, ("",) * 25, ((),) * 25, GRID)
    rough = solution({"rest": GRID}, {})
    worst = SolvedPoint("7", "rest", GRID[6] + 0.05, np.eye(3) * 0.01**2, ("a.jpg", "b.jpg"))
    points = {**rough.points, ("rest", "7"): worst}
    found = measure_phases(Solution(rough.survey, {}, points, ()), patch(), marks)
    assert not found.measured[0, 6]
    np.testing.assert_allclose(found.places[0, 6], GRID[6], atol=2e-4)


def test_a_still_point_that_is_none_is_named():
    with pytest.raises(UnknownNameError, match="still point 'nasion'"):
        measure_phases(solution({"rest": GRID}, {}), patch(), plain_marks(25), still=("nasion",))


def test_what_is_shut_lies_on_what_it_touches():
    touches = ((),) * 12 + ((("blink", "8"),),) + ((),) * 12
    marks = Marks(plain_marks(25).names, ("",) * 25, ((),) * 25, GRID, touches)
    shut = {"rest": GRID, "blink": GRID}
    found = measure_phases(solution(shut, {"blink": (12,)}), patch(), marks)
    np.testing.assert_allclose(found.places[1, 12], GRID[7], atol=1e-4)
    assert not found.measured[1, 12]
    seen = measure_phases(solution(shut, {}), patch(), marks)
    np.testing.assert_allclose(seen.places[1, 12], GRID[12], atol=1e-4)


BALL = np.random.default_rng(5).normal(size=(12, 3))
BALL = 0.012 * BALL / np.linalg.norm(BALL, axis=1, keepdims=True)


def test_an_eyeball_half_hidden_keeps_its_shape():
    marks = Marks(plain_marks(12).names, ("eye",) * 12, ((),) * 12, BALL)
    truth = np.stack([1.1 * BALL, Motion(TURN, np.array([0.01, 0.0, 0.0])).apply(1.1 * BALL)])
    places, seen = truth.copy(), np.ones((2, 12), dtype=bool)
    places[0, 8:], places[1, 6:], seen[0, 8:], seen[1, 6:] = 0.0, 0.0, False, False
    settle_bodies(places, seen, marks)
    np.testing.assert_allclose(places, truth, atol=1e-9)


@pytest.mark.parametrize(("shown", "lower"), [(0, 0.0), (3, 0.002)])
def test_hidden_teeth_go_along_with_the_chin_and_onto_the_few_that_are_seen(shown, lower):
    chin = np.array([[0.0, -0.1, 0.09], [0.01, -0.1, 0.09], [0.0, -0.09, 0.1], [0.01, -0.11, 0.08]])
    model = np.concatenate([BALL, chin])
    follows = (("13", "14", "15", "16"),) * 12 + ((),) * 4
    marks = Marks(plain_marks(16).names, ("teeth",) * 12 + ("",) * 4, follows, model)
    drop = Motion(TURN, np.array([0.0, -0.02, 0.0]))
    places = np.stack([drop.apply(model), model])
    places[1, :12, 1] -= lower
    truth = places[1].copy()
    seen = np.ones((2, 16), dtype=bool)
    places[1, shown:12], seen[1, shown:12] = 0.0, False
    settle_bodies(places, seen, marks)
    np.testing.assert_allclose(places[1], truth, atol=1e-9)


def test_a_row_of_teeth_does_not_slip_sideways():
    row = np.array([[0.004 * k, 0.003 * (k % 2), 0.09 - 0.2 * (0.004 * k) ** 2] for k in range(8)])
    marks = Marks(plain_marks(8).names, ("teeth",) * 8, ((),) * 8, row)
    places = np.stack([row + np.random.default_rng(4).normal(0.0, 3e-4, row.shape)])
    settle_bodies(places, np.ones((1, 8), dtype=bool), marks)
    assert abs(places[0, 0, 0]) < 1e-12
    np.testing.assert_allclose(places[0], row, atol=6e-4)


def test_the_middle_of_a_ball():
    np.testing.assert_allclose(fit_centre(BALL + np.array([0.03, 0.02, 0.1])), [0.03, 0.02, 0.1], atol=1e-9)
