"""What a head is made of whose skin should move somewhere."""

from __future__ import annotations

import numpy as np
import pytest

from mien.capture.fitting_shape import Wanted, find_residual, find_values, sphere
from mien.faces.head.head import Head
from mien.faces.head.measured import archive

COUNT = len(archive().mirror)
HEAD = Head(hair="bald")
NOTHING = np.zeros((COUNT + 2, 3))


def test_lips_that_are_measured_apart_still_meet():
    moves = NOTHING.copy()
    upper, lower = archive().ring("m0", 10)[[1, 8]]
    moves[upper], moves[lower] = [0.0, 0.001, 0.0], [0.0, -0.001, 0.0005]
    cage = Wanted.of(moves, 1.0).cage
    np.testing.assert_allclose(cage[upper], cage[lower], atol=1e-12)
    # The upper lip closes 0.35 of the gap.
    np.testing.assert_allclose(cage[upper], [0.0, 0.001 - 0.35 * 0.002, 0.35 * 0.0005], atol=1e-12)


def test_the_surface_moves_as_the_cage_does():
    moves = np.tile([0.001, -0.002, 0.003], (COUNT + 2, 1))
    np.testing.assert_allclose(Wanted.of(moves, 1.0).surface, moves[:-2], atol=1e-12)


def test_nothing_wanted_is_no_values():
    assert find_values(Wanted.of(NOTHING, 1.0), lids=True) == {}


def test_a_parameter_that_moved_the_skin_is_found_and_not_beyond_its_range():
    pose = HEAD.neutral.replace({"face.size": 1.05})
    moves = NOTHING.copy()
    moves[:COUNT] = (HEAD.shape(pose).points - HEAD.shape(HEAD.neutral).points)[:COUNT]
    found = find_values(Wanted.of(moves, 1.0), lids=False)
    head = Head(hair="bald", values=found)
    left = (head.shape(head.neutral).points - HEAD.shape(pose).points)[:COUNT]
    seen = archive().floats("surface")[:, 1] > -0.11
    assert np.sqrt((left[seen] ** 2).sum(axis=1).mean()) < 0.3 * np.sqrt((moves[:COUNT][seen] ** 2).sum(axis=1).mean())
    far = find_values(Wanted.of(20.0 * moves, 1.0), lids=False)
    assert all(HEAD.parameters[name].low <= value <= HEAD.parameters[name].high for name, value in far.items())


@pytest.mark.parametrize(
    "values", [{}, {"face.size": 1.04, "eye.size": 80.0, "chin.forward": 20.0}], ids=["", "values"]
)
def test_the_residual_makes_up_for_what_values_do(values):
    moves = np.tile([0.0, 0.001, 0.002], (COUNT + 2, 1))
    residual = find_residual(Wanted.of(moves, 1.03), values)
    head = Head(hair="bald", values=values, residual=residual)
    for each, plain in ((head, HEAD), (head.unsubdivided, HEAD.unsubdivided)):
        moved = (each.shape(each.neutral).points - plain.shape(plain.neutral).points)[:COUNT]
        assert np.sqrt(((moved - moves[:COUNT]) ** 2).sum(axis=1).mean()) < 0.0003
    eye = head._layout.span["eye.left"]
    centre, radius = sphere(head.shape(head.neutral).points[eye])
    np.testing.assert_allclose(centre, archive().floats("eye_centre")[0] + [0.0, 0.001, 0.002], atol=1e-4)
    assert radius == pytest.approx(1.03 * float(archive().floats("eye_radius")), rel=0.01)
