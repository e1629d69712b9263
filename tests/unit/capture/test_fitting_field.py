"""The likeliest head through points: known people are found again, wherever they stand."""

from __future__ import annotations

import numpy as np
import pytest

from mien.capture.fitting_field import Evidence, Placing, estimate, superpose, turn_by
from mien.capture.fitting_people import population
from mien.capture.fitting_places import find_place, known_places, weights_of
from mien.core import UnknownNameError

NAMES = [name for name in known_places() if name.startswith("ibug_")]
TURN = turn_by(np.array([0.2, -0.9, 0.4]))
SHIFT = np.array([0.5, -1.2, 3.0])
ROWS = len(population().rows.points)


def evidence(moves: np.ndarray, sigma_m: float, names: list[str] = NAMES) -> Evidence:
    """Points of a head that stands elsewhere."""
    weights = weights_of([find_place(name) for name in names], ROWS)
    places = weights @ (population().rows.points + moves)
    blocks = np.broadcast_to(sigma_m**2 * np.eye(3), (len(names), 3, 3))
    return Evidence(Placing(TURN, SHIFT).to_world(places), blocks, weights)


def test_names_stand_for_landmarks_the_68_points_and_vertices_of_the_cage():
    assert len(NAMES) == 68
    points = population().rows.points

    def place(name: str) -> np.ndarray:
        return weights_of([find_place(name)], ROWS)[0] @ points

    np.testing.assert_array_equal(place("m0_5"), place("m0_5.left"))
    np.testing.assert_allclose(place("m0_5.right"), place("m0_5.left") * [-1, 1, 1], atol=1e-6)
    # A corner of the mouth by three names.
    assert np.linalg.norm(place("m0_5") - place("cheilion_L")) < 0.004
    np.testing.assert_allclose(place("ibug_54"), place("cheilion_L"), atol=1e-9)
    np.testing.assert_allclose(place("eye_centre_R"), points[-1])
    assert place("pronasale")[2] == pytest.approx(0.1204, abs=0.0005)
    assert {"mi_0", "ej_3", "u0", "v7"}.isdisjoint(known_places())
    with pytest.raises(UnknownNameError, match="did you mean 'cheilion_L'"):
        find_place("chelion_L")


def test_weights_of_a_place_sum_to_one():
    np.testing.assert_allclose(weights_of(known_places().values(), ROWS).sum(axis=1), 1.0, atol=1e-9)


def test_people_are_as_symmetric_as_their_mirror_images():
    rows = population().rows
    count = ROWS - 2
    np.testing.assert_allclose(rows.points[-1], rows.points[-2] * [-1, 1, 1], atol=1e-7)
    np.testing.assert_allclose(rows.mean[count + 1], rows.mean[count] * [-1, 1, 1], atol=1e-9)


def test_the_mean_person_is_found_wherever_it_stands():
    found = estimate(evidence(population().rows.mean, 1e-4), scaled=False)
    np.testing.assert_allclose(found.placing.rotation, TURN, atol=1e-7)
    np.testing.assert_allclose(found.placing.place, SHIFT, atol=1e-7)
    np.testing.assert_allclose(found.moves, population().rows.mean, atol=1e-7)
    assert found.growth == pytest.approx(population().growth, abs=1e-6)
    assert found.chi2 < 1e-6


def test_a_scale_that_is_not_trusted_is_found():
    seen = evidence(population().rows.mean, 1e-4)
    found = estimate(Evidence(1.25 * seen.places, seen.covariances, seen.weights), scaled=True)
    assert found.placing.scale == pytest.approx(1.25, abs=1e-6)
    np.testing.assert_allclose(found.placing.place, 1.25 * SHIFT, atol=1e-6)


def test_what_is_special_about_a_person_is_found_where_nothing_was_measured():
    rows = population().rows
    special = rows.mean + 1.5 * rows.modes[0] - rows.modes[2]
    found = estimate(evidence(special, 2e-4), scaled=False)
    seen = rows.points[:, 1] > -0.1
    before = np.linalg.norm((rows.mean - special)[seen], axis=1)
    after = np.linalg.norm((found.moves - special)[seen], axis=1)
    assert np.sqrt((after**2).mean()) < 0.25 * np.sqrt((before**2).mean())


def test_precise_points_are_met_and_vague_ones_change_little():
    rows = population().rows
    special = rows.mean + rows.modes[0]
    exact = evidence(special, 1e-5)
    near, far = (estimate(evidence(special, sigma), scaled=False) for sigma in (1e-5, 0.5))
    fitted = exact.weights @ (rows.points + near.moves)
    assert np.linalg.norm(near.measured - fitted, axis=1).max() < 0.001
    np.testing.assert_allclose(far.moves, rows.mean, atol=2e-4)


def test_the_statistic_of_a_point_is_that_of_leaving_it_out():
    names = NAMES[27:48]
    rng = np.random.default_rng(5)
    seen = evidence(population().rows.mean + population().rows.modes[1], 0.001, names)
    seen = Evidence(seen.places + rng.normal(0.0, 0.001, seen.places.shape), seen.covariances, seen.weights)
    whole = estimate(seen, scaled=False)
    others = estimate(seen.only(np.arange(len(names)) != 4), scaled=False)
    # Leaving a point out lowers the sum by as much as it contradicts the others.
    assert whole.chi2 - others.chi2 == pytest.approx(whole.statistics[4], rel=1e-3)


def test_superposition_knows_no_mirror():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]])
    placing = superpose(points, 2.0 * points @ TURN.T + SHIFT, scaled=True)
    assert placing.scale == pytest.approx(2.0)
    np.testing.assert_allclose(placing.rotation, TURN, atol=1e-12)
    np.testing.assert_allclose(placing.to_head(placing.to_world(points)), points, atol=1e-12)
    assert np.linalg.det(superpose(points, points * [-1, 1, 1], scaled=False).rotation) == pytest.approx(1.0)
