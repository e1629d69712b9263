"""Folds: they appear with their movement on its side, nowhere else, and not at rest."""

import numpy as np
import pytest

from mien.faces import load_face
from mien.faces.head import folds
from mien.faces.head.measured import archive
from mien.faces.head.shipped import shipped_rows
from support import in_python

HEAD = load_face("head")
TABLE = HEAD.parameters


def light(values):
    """(S,) share of its light that each vertex of the skin keeps."""
    skin = HEAD._layout.span["skin"]
    rest, posed = (HEAD.shape(HEAD.neutral.replace(v)).colors[skin] for v in ({}, values))
    return (posed / rest).min(axis=1)


@pytest.mark.parametrize(
    ("values", "vertex"),
    [
        ({"mouth.expression.left": 0.0}, "m3_4"),
        ({"nose.wrinkle.left": 1.0}, "n22"),
        ({"cheek.raise.left": 1.0}, "e3_6"),
        ({"eyelid.squint.left": 1.0}, "e2_9"),
        ({"eyebrow.inner_raise.left": 1.0, "eyebrow.outer_raise.left": 1.0}, "s2_1"),
        ({"eyebrow.lower.left": 1.0}, "s1_1"),
        ({"chin.raise": 1.0}, "m3_9"),
        ({"cheek.nasolabial.left": 1.0}, "m3_4"),
    ],
)
def test_a_movement_darkens_its_fold_on_its_side(values, vertex):
    left = archive().vertex[vertex]
    right = archive().mirror[left]
    kept = light(values)
    assert kept[left] < 0.85
    if left != right:
        # A parameter of one half or of both: the other side folds only with the latter.
        assert kept[right] == 1.0


def test_a_full_fold_takes_its_share_of_light_and_two_drivers_no_more_than_all_of_it():
    colors = np.ones((2, 3))
    amounts = np.full(2, 9.0)
    drivers, rules = np.array([[0, 0], [1, 0], [1, 1]]), np.array([[0.0, 0.8], [1.0, -0.8], [0.0, -1.0]])
    places, dark = np.array([[0, 0], [1, 1]]), np.array([0.5, 0.5])
    in_python(folds.fold_skin)(np.array([1.0, 0.0]), drivers, rules, places, dark, amounts, colors)
    assert amounts.tolist() == [1.6, 0.0]
    np.testing.assert_allclose(colors[0], 1.0 - 0.5 * np.array(folds.TINT))
    assert (colors[1] == 1.0).all()


def test_folds_and_their_drivers_name_the_same_and_what_there_is():
    assert {row["fold"] for row in shipped_rows("folds")} == {row["fold"] for row in shipped_rows("fold_drivers")}
    assert all(row["vertex"] in archive().vertex for row in shipped_rows("folds"))
    assert all(row["parameter"] in TABLE for row in shipped_rows("fold_drivers"))
    assert (light({}) == 1.0).all()
