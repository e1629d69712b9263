"""The benchmark of the pair: its cases, and an error that is one of shape alone."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[3] / "benchmarks"))

import capture_pair


def test_every_distance_click_and_turn_is_measured_once() -> None:
    cases = list(capture_pair.cases())
    assert len(cases) == len(set(cases))
    assert {case[0] for case in cases} == set(capture_pair.DISTANCES_M)
    assert {case[1] for case in cases} == set(capture_pair.CLICKS_PX)
    assert {case[2] for case in cases} == set(capture_pair.TURNS_DEG)


def test_a_turned_and_shifted_face_has_no_error_and_a_larger_one_has() -> None:
    face = np.random.default_rng(0).normal(size=(20, 3))
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    np.testing.assert_allclose(capture_pair.laid_on(list(face @ turn + 1.0), list(face)), 0.0, atol=1e-12)
    larger = capture_pair.laid_on(list(1.1 * face), list(face))
    np.testing.assert_allclose(larger, 0.1 * (face - face.mean(axis=0)), atol=1e-12)


def test_perspective_pays_at_one_metre() -> None:
    flat, solved, found = capture_pair.measure(1.0, 1.0, 0.0, 60, 1)
    assert solved < 0.5 * flat
    assert 0.9 < found < 1.1
