"""Moves carried on to points that were not measured."""

from __future__ import annotations

import numpy as np

from mien.capture.guessing import edges_of, quieten, spread

CHAIN = np.array([[k, k + 1] for k in range(4)])
PLACES = np.arange(5.0)[:, None] * [0.01, 0.0, 0.0]


def test_edges_of_two_triangles_are_five():
    assert edges_of([(0, 1, 2), (2, 1, 3)]).tolist() == [[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]


def test_between_two_measured_points_moves_change_evenly():
    measured = np.full((5, 3), np.nan)
    measured[0], measured[4] = [0.0, 0.0, 0.0], [0.0, 0.004, 0.0]
    moves = spread(measured, np.full(5, 1e-4), CHAIN, PLACES)
    np.testing.assert_allclose(moves[:, 1], [0.0, 0.001, 0.002, 0.003, 0.004], atol=3e-5)
    np.testing.assert_allclose(moves[:, [0, 2]], 0.0, atol=1e-12)


def test_beyond_the_last_measured_point_all_move_with_it():
    measured = np.full((5, 3), np.nan)
    measured[0] = [0.002, 0.0, 0.0]
    np.testing.assert_allclose(spread(measured, np.full(5, 1e-4), CHAIN, PLACES)[:, 0], 0.002, rtol=0.02)


def test_a_point_beside_nothing_measured_stays():
    measured = np.full((5, 3), np.nan)
    measured[0] = [0.002, 0.0, 0.0]
    assert np.abs(spread(measured, np.full(5, 1e-4), CHAIN[:3], PLACES)[4]).max() == 0.0


def test_what_is_exactly_measured_stays_where_it_was_measured():
    measured = np.random.default_rng(1).normal(0.0, 0.003, (5, 3))
    np.testing.assert_allclose(spread(measured, np.full(5, 1e-5), CHAIN, PLACES), measured, atol=2e-5)


def test_noise_is_taken_back_and_a_smile_is_not():
    rng = np.random.default_rng(2)
    noise = rng.normal(0.0, 1e-4, (5, 3))
    quiet = quieten(noise, np.full(5, 1e-4), CHAIN)
    assert np.abs(quiet).max() < 0.3 * np.abs(noise).max()
    smile = noise + np.array([0.0, 0.005, 0.0])
    np.testing.assert_allclose(quieten(smile, np.full(5, 1e-4), CHAIN), smile, rtol=0.01)
