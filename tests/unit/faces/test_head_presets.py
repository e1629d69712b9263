"""The named expressions of the head."""

from itertools import combinations

import numpy as np
import pytest

from mien.core import Pose
from support import face

BASIC = ("happy", "sad", "angry", "surprised", "afraid", "disgusted")
EXPRESSIONS = {name: preset for name, preset in face("head").presets.items() if preset.kind == "expression"}


def posed(name: str) -> Pose:
    return face("head").neutral.replace(EXPRESSIONS[name].values)


def test_there_are_six_basic_and_sixteen_everyday_expressions() -> None:
    assert next(iter(EXPRESSIONS)) == "neutral"
    assert set(BASIC) < set(EXPRESSIONS)
    assert len(set(EXPRESSIONS) - set(BASIC) - {"neutral"}) == 16


def test_no_two_look_the_same() -> None:
    shapes = {name: face("head").shape(posed(name)).points for name in EXPRESSIONS}
    for one, other in combinations(EXPRESSIONS, 2):
        assert np.abs(shapes[one] - shapes[other]).max() > 0.002, (one, other)


@pytest.mark.parametrize("name", EXPRESSIONS)
def test_each_says_where_it_comes_from(name: str) -> None:
    assert len(EXPRESSIONS[name].source) > 10
    assert EXPRESSIONS[name].doc.endswith(".")


@pytest.mark.parametrize("name", EXPRESSIONS)
def test_values_differ_from_rest(name: str) -> None:
    neutral, pose = face("head").neutral, posed(name)
    for key in EXPRESSIONS[name].values:
        for row in neutral.table.resolve(key):
            assert pose[row] != neutral[row], row


@pytest.mark.parametrize(("name", "wide"), [("afraid", True), ("surprised", True), ("sad", False), ("sleepy", False)])
def test_pupils_are_part_of_an_expression(name: str, wide: bool) -> None:
    assert (posed(name)["pupil.size.left"] > face("head").neutral["pupil.size.left"]) == wide
