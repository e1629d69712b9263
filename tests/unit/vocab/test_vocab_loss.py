"""What is lost on the way from one set of names to another."""

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from mien.core import MienError, UnknownNameError
from mien.vocab import load_remap, vocabulary
from mien.vocab.loss import loss_on, loss_to, nearest_shares
from support import face


@pytest.fixture(scope="module")
def onto_arkit():
    return {loss.name: loss for loss in loss_to("facs", "arkit", face("head"))}


def test_every_name_of_a_vocabulary_is_accounted_for() -> None:
    losses = loss_on("facs", face("head"))
    assert tuple(loss.name for loss in losses) == vocabulary("facs").names
    played = load_remap("facs", "head").from_names
    assert {loss.name for loss in losses if loss.fit != "missing"} == set(played)


def test_two_names_that_do_the_same_are_found() -> None:
    losses = {loss.name: loss for loss in loss_on("facs", face("head"))}
    assert losses["AU43.left"].nearest == {"AU45.left": 1.0}
    assert losses["AU43.left"].angle_deg == pytest.approx(0.0, abs=1e-3)
    assert losses["AU12.left"].angle_deg > 30.0


def test_arkit_loses_nothing_but_what_is_marked() -> None:
    losses = loss_on("arkit", face("head"))
    near = {loss.name for loss in losses if loss.fit == "near"}
    assert near == {"jawOpen", "mouthSmileLeft", "mouthSmileRight", "tongueOut"}
    assert min(loss.angle_deg for loss in losses) > 15.0


@pytest.mark.parametrize(
    ("unit", "shape"), [("AU2.left", "browOuterUpLeft"), ("AU18", "mouthPucker"), ("AU27", "jawOpen")]
)
def test_units_that_are_shapes_become_them(onto_arkit, unit, shape) -> None:
    assert onto_arkit[unit].fit == "exact"
    assert onto_arkit[unit].nearest == pytest.approx({shape: 1.0}, abs=1e-3)


def test_units_that_are_two_shapes_become_both(onto_arkit) -> None:
    assert onto_arkit["AU61"].nearest == pytest.approx({"eyeLookOutLeft": 1.0, "eyeLookInRight": 1.0}, abs=1e-3)


def test_one_sided_units_are_lost_where_the_shape_has_no_sides(onto_arkit) -> None:
    assert onto_arkit["AU1.left"].fit == onto_arkit["AU34.left"].fit == "near"
    assert 15.0 < onto_arkit["AU1.left"].angle_deg < 60.0


def test_the_turned_head_is_missing(onto_arkit) -> None:
    assert onto_arkit["AU51"].fit == "missing"
    assert onto_arkit["AU51"].nearest == {}


def test_shares_are_those_of_a_known_solver() -> None:
    random = np.random.default_rng(11)
    basis, wish = (
        random.normal(size=(6, 40)),
        random.normal(size=40) + random.normal(size=6) @ random.normal(size=(6, 40)),
    )
    want = lsq_linear(basis.T, wish, (0.0, 1.0)).x
    np.testing.assert_allclose(nearest_shares(basis @ basis.T, basis @ wish), want, atol=1e-6)


def test_unknown_vocabularies_are_refused() -> None:
    with pytest.raises(UnknownNameError):
        loss_on("fasc", face("head"))
    with pytest.raises(MienError):
        loss_to("facs", "klingon", face("head"))
