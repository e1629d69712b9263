"""Compiled posing is what its source says in Python; batches in chunks; what is refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mien.compiling import Kernel
from mien.core import MienError, Parameter, ParameterTable, Pose, RangeError, exact
from mien.faces import load_face, shapes
from mien.faces.head import angles, posing
from mien.faces.head.moves import Move, moves_of
from support import in_python

HEAD = load_face("head")
TABLE = HEAD.parameters


def wild(seed):
    """Values in which everything moves."""
    share = np.random.default_rng(seed).random(len(TABLE))
    return TABLE.lows * (1.0 - share) + TABLE.highs * share


@given(st.floats(-20.0, 20.0))
def test_sine_cosine_and_soft_step_are_those_of_arrays(x):
    sine, cosine = exact.sin_cos(np.array([x]))
    assert in_python(angles.sin_cos)(x) == (sine[0], cosine[0])
    assert in_python(angles.soft_step)(x) == exact.smoothstep(np.array([x]))[0]


@pytest.mark.parametrize("face", [HEAD, HEAD.unsubdivided, load_face("head:parke1974")], ids=lambda face: face.name)
def test_compiled_posing_is_what_its_source_says(face, monkeypatch):
    pose = Pose(face.parameters, wild(3))
    compiled = face.shape(pose)
    for name, value in vars(posing).items():
        if isinstance(value, Kernel) and value.signature:
            monkeypatch.setattr(posing, name, in_python(value))
    plain = face.shape(pose)
    for one, other in ((compiled.points, plain.points), (compiled.colors, plain.colors)):
        np.testing.assert_array_equal(one, other)
    np.testing.assert_array_equal(compiled.normals, plain.normals)


def test_more_poses_than_a_chunk_and_none_at_all():
    values = np.stack([wild(seed) for seed in range(70)])
    many = shapes(HEAD, values)
    assert many.shape == (70, HEAD.topology.vertex_count, 3)
    for row in (0, 31, 32, 69):
        np.testing.assert_allclose(many[row], HEAD.shape(Pose(TABLE, values[row])).points, rtol=0.0, atol=1e-15)
    np.testing.assert_allclose(shapes(HEAD, values, threads=3), many, rtol=0.0, atol=1e-15)
    assert shapes(HEAD, values[:0]).shape == (0, HEAD.topology.vertex_count, 3)


def test_poses_of_another_table_are_refused():
    with pytest.raises(MienError, match=rf"\(N, {len(TABLE)}\)"):
        shapes(HEAD, np.zeros((4, 7)))
    with pytest.raises(RangeError, match="0 threads"):
        shapes(HEAD, np.zeros((4, len(TABLE))), threads=0)
    table = ParameterTable((Parameter("nose.length", 0.0, 1.0),))
    with pytest.raises(MienError, match="another kind"):
        HEAD.shape(Pose.neutral(table))


def test_moves_are_added_as_far_as_their_parameter_is_from_rest():
    table = ParameterTable((Parameter("a", 0.0, 1.0, 0.5), Parameter("b", -1.0, 1.0)))
    right, up = np.array([[1.0, 0.0, 0.0]]), np.array([[0.0, 1.0, 0.0]])
    moves = moves_of([Move("a", right, 2.0, rest=0.5, span=-0.5), Move("b", up, one_way=True)], table)
    weights, skins = np.empty((2, 2)), np.empty((2, 3))
    posing.weigh_moves(np.array([[0.0, -1.0], [0.75, 0.25]]), moves.columns, moves.rules, weights)
    assert weights.tolist() == [[2.0, 0.0], [-1.0, 0.25]]
    posing.add_moves(weights, moves.deltas, np.array([0.0, 0.0, 7.0]), skins)
    assert skins.tolist() == [[2.0, 0.0, 7.0], [-1.0, 0.25, 7.0]]
