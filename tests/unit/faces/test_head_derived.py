"""Expressions made by table: mixtures and bells."""

import numpy as np
import pytest

from mien.core import UnknownNameError
from mien.faces.head import derived
from mien.faces.head.measured import archive

POINTS = np.array([[0.0, 0.0, 0.1], [0.02, 0.0, 0.1], [-0.02, 0.0, 0.1], [0.02, 0.01, 0.1], [0.2, 0.0, 0.1]])


def tables(monkeypatch, mixtures=(), bells=()):
    rows = {"mixtures": mixtures, "bells": bells}
    monkeypatch.setattr(derived, "shipped_rows", rows.__getitem__)


def test_a_bell_moves_its_middle_fully_its_reach_by_1_e_and_nothing_far_away_or_beyond_the_midline(monkeypatch):
    bell = {"morph": "bulge", "sides": "both", "vertex": "a", "out": "3", "up": "0", "forward": "1"}
    tables(monkeypatch, bells=[{**bell, **{f"reach_{axis}": "10" for axis in "xyz"}}])
    made = derived.derived_morphs({}, POINTS, {"a": 1})
    left, right = made["bulge_L"], made["bulge_R"]
    np.testing.assert_allclose(left[1], [0.003, 0.0, 0.001])
    np.testing.assert_allclose(left[3], left[1] * (np.exp(-1.0) - 0.01) / 0.99)
    assert not left[[0, 2, 4]].any()
    np.testing.assert_allclose(right[2], [-0.003, 0.0, 0.001])


def test_a_mixture_adds_shares_and_divides_what_was_measured_whole_between_the_halves(monkeypatch):
    rows = [{"morph": "mix", "sides": "both", "part": "whole", "share": "0.5"}]
    tables(monkeypatch, mixtures=rows)
    whole = np.ones((5, 3))
    made = derived.derived_morphs({"whole": whole}, POINTS, {})
    np.testing.assert_allclose(made["mix_L"] + made["mix_R"], 0.5 * whole)
    assert made["mix_L"][:3, 0].tolist() == [0.25, 0.5, 0.0]
    tables(monkeypatch, mixtures=[{**rows[0], "sides": ""}])
    np.testing.assert_allclose(derived.derived_morphs({"whole": whole}, POINTS, {})["mix"], 0.5 * whole)


def test_an_expression_that_nobody_measured_is_refused(monkeypatch):
    tables(monkeypatch, mixtures=[{"morph": "mix", "sides": "both", "part": "whol", "share": "0.5"}])
    with pytest.raises(UnknownNameError, match="whole"):
        derived.derived_morphs({"whole": np.ones((5, 3))}, POINTS, {})


@pytest.mark.parametrize("row", derived.shipped_rows("bells"), ids=lambda row: f"{row['morph']} {row['vertex']}")
def test_bells_stand_on_named_vertices(row):
    assert row["vertex"] in archive().vertex
