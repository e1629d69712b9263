"""The normal equations against differences, their blocks against the whole, and what follows from them."""

from dataclasses import replace

import numpy as np
import pytest

from mien.capture.covariances import covariances, seen_covariances
from mien.capture.lenses import ALL_TERMS, assumptions
from mien.capture.networks import connect
from mien.capture.records import Reference, Survey
from mien.capture.refining import Equations, Problem, cost_of, equate, lay_out, moved, refine, solve_step
from mien.capture.simulating import Setup, board, cube, simulate
from mien.capture.snooping import judge
from mien.capture.starting import begin
from mien.core.errors import MienError

SETUP = Setup(references=cube() + board(3, 3), points=6, views=3, moments=2, fixed=True, one_lens=False, k1=-0.1)


def problem_of(survey: Survey) -> tuple[Problem, object]:
    network = connect(survey)
    state, held = begin(network)
    means, sigmas = assumptions(network, state.lenses)
    fixed = np.zeros(len(network.bodies), dtype=bool)
    fixed[held] = True
    terms = np.tile(ALL_TERMS, (len(network.lenses), 1))
    return Problem(network, state.placed(network), terms, fixed, means, sigmas), state


@pytest.fixture(scope="module")
def refined():
    survey = simulate(SETUP, 3).survey
    loose = tuple(
        replace(each, sigma_m=0.0005) if number % 2 else each for number, each in enumerate(survey.references)
    )
    problem, state = problem_of(replace(survey, references=loose))
    return refine(problem, state)


def whole(equations: Equations) -> tuple[np.ndarray, np.ndarray]:
    """All of the normal equations in one matrix, and their right side."""
    width, free = equations.layout.columns, len(equations.points)
    matrix = np.zeros((width + 3 * free, width + 3 * free))
    matrix[:width, :width] = equations.cameras
    ties = equations.ties.reshape(3 * free, width)
    matrix[width:, :width], matrix[:width, width:] = ties, ties.T
    for number, block in enumerate(equations.points):
        at = width + 3 * number
        matrix[at : at + 3, at : at + 3] = block
    return matrix, np.concatenate([equations.camera_right, equations.point_right.reshape(-1)])


def test_the_right_side_is_the_slope_of_the_cost(refined) -> None:
    layout = lay_out(refined.problem)
    generator = np.random.default_rng(1)
    columns = generator.normal(size=layout.columns) * 1e-6
    points = generator.normal(size=(len(layout.free_points), 3)) * 1e-6
    away = moved(refined.state, layout, columns * 100.0, points * 100.0)
    equations = equate(refined.problem, away, layout)
    up = cost_of(refined.problem, moved(away, layout, columns, points), layout)
    down = cost_of(refined.problem, moved(away, layout, -columns, -points), layout)
    slope = -2.0 * (columns @ equations.camera_right + (points * equations.point_right).sum())
    assert (up - down) / 2.0 == pytest.approx(slope, rel=1e-4)


def test_a_step_by_blocks_is_the_step_of_the_whole(refined) -> None:
    layout = lay_out(refined.problem)
    away = moved(refined.state, layout, np.full(layout.columns, 1e-4), np.zeros((len(layout.free_points), 3)))
    equations = equate(refined.problem, away, layout)
    matrix, right = whole(equations)
    columns, points = solve_step(equations, 0.0)
    scale = 1.0 / np.sqrt(np.diag(matrix))
    step = scale * np.linalg.solve(matrix * np.outer(scale, scale), scale * right)
    assert np.concatenate([columns, points.reshape(-1)]) / scale == pytest.approx(step / scale, rel=1e-4, abs=1e-6)


def test_covariances_are_blocks_of_the_inverse(refined) -> None:
    matrix, _ = whole(refined.equations)
    scale = 1.0 / np.sqrt(np.diag(matrix))
    inverse = np.linalg.inv(matrix * np.outer(scale, scale)) * np.outer(scale, scale)
    found = covariances(refined.equations)
    width = refined.equations.layout.columns
    assert found.cameras / np.outer(scale, scale)[:width, :width] == pytest.approx(
        inverse[:width, :width] / np.outer(scale, scale)[:width, :width], rel=1e-5, abs=1e-5
    )
    for number, block in enumerate(found.points):
        at = width + 3 * number
        assert block == pytest.approx(inverse[at : at + 3, at : at + 3], rel=1e-5, abs=1e-12)


def test_redundancy_is_observations_less_unknowns() -> None:
    problem, state = problem_of(simulate(Setup(references=cube(), points=5, views=3), 1).survey)
    sure = replace(problem, lens_sigmas=np.full_like(problem.lens_sigmas, np.inf))
    refined = refine(sure, state)
    # 3 views of 13 points; a lens of 8, 3 places of 6, 5 points of 3.
    assert judge(refined).redundancy == pytest.approx(3 * 13 * 2 - 8 - 3 * 6 - 5 * 3, abs=1e-6)


def test_leaving_out_tells_what_it_would_have_given(refined) -> None:
    judgement = judge(refined)
    order = refined.equations.layout.order
    for number in (10, 20, 40, 77):
        without = refined.problem.active.copy()
        without[order[number]] = False
        again = refine(replace(refined.problem, active=without), refined.state, close=1e-14)
        assert refined.equations.cost - again.equations.cost == pytest.approx(judgement.statistics[number], abs=0.03)


def test_every_part_is_decided_by_itself_between_none_and_all(refined) -> None:
    shares = np.linalg.eigvalsh(seen_covariances(refined, covariances(refined.equations)))
    assert shares.min() > -1e-9
    assert shares.max() < 1.0 + 1e-9


def test_what_stays_open_is_told() -> None:
    flat = tuple(Reference(f"r{k}", 0.02 * k, 0.03 * (k % 2), 0.0) for k in range(8))
    problem, state = problem_of(simulate(Setup(references=flat, points=3, views=2), 1).survey)
    network = problem.network
    few = problem.active & (np.arange(len(network.pictures)) % 7 == 0)
    unsure = replace(problem, active=few, lens_sigmas=np.full_like(problem.lens_sigmas, np.inf))
    with pytest.raises(MienError, match="stays open"):
        covariances(equate(unsure, state, lay_out(unsure)))
