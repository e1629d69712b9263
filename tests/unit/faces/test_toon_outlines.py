import numpy as np
import pytest

from mien.core import MienError
from mien.faces.toon.outlines import (
    flatten,
    half_widths,
    look_up,
    parse_path,
    piece_steps,
    polygon_outline,
    ribbon,
    same_pieces,
)


def corners(text):
    outline = parse_path(text)
    return [contour.tolist() for contour in flatten(outline, [1] * len(outline))]


def test_lines_absolute_and_relative():
    assert corners("M1 2 L4 2 4 6 H1 Z") == [[[1, 2], [4, 2], [4, 6], [1, 6]]]
    assert corners("m1 2 3 0 v4 h-3 z") == [[[1, 2], [4, 2], [4, 6], [1, 6]]]
    assert corners("M1,2L4,2,4,6H1Z") == corners("M 1 2 L 4 2 L 4 6 L 1 6 Z")
    assert corners("M1-2-3 4") == [[[1, -2], [-3, 4]]]
    assert corners("M.5.25 1e1 2") == [[[0.5, 0.25], [10, 2]]]


def test_what_follows_a_closed_contour_starts_where_that_did():
    assert corners("M1 1 L3 1 L3 3 Z l-1 -1") == [[[1, 1], [3, 1], [3, 3]], [[1, 1], [0, 0]]]
    assert corners("m1 1 2 0 z m5 5 1 0") == [[[1, 1], [3, 1]], [[6, 6], [7, 6]]]


def test_a_cubic_curve_is_at_its_middle_where_it_should_be():
    outline = parse_path("M0 0 C0 4 8 4 8 0")
    (curve,) = flatten(outline, [1, 2])
    assert curve.tolist() == [[0, 0], [4, 3], [8, 0]]


def test_a_quadratic_curve_is_the_cubic_one():
    (curve,) = flatten(parse_path("M0 0 Q4 6 8 0"), [1, 2])
    np.testing.assert_allclose(curve, [[0, 0], [4, 3], [8, 0]])


def test_smooth_commands_reflect_the_last_handle():
    (smooth,) = flatten(parse_path("M0 0 C0 2 2 4 4 4 S8 2 8 0"), [1, 4, 4])
    (plain,) = flatten(parse_path("M0 0 C0 2 2 4 4 4 C6 4 8 2 8 0"), [1, 4, 4])
    np.testing.assert_allclose(smooth, plain)
    (smooth,) = flatten(parse_path("M0 0 Q2 4 4 0 T8 0"), [1, 4, 4])
    (plain,) = flatten(parse_path("M0 0 Q2 4 4 0 Q6 -4 8 0"), [1, 4, 4])
    np.testing.assert_allclose(smooth, plain)
    (alone,) = flatten(parse_path("M0 0 L4 4 S8 2 8 0"), [1, 1, 4])
    (plain,) = flatten(parse_path("M0 0 L4 4 C4 4 8 2 8 0"), [1, 1, 4])
    np.testing.assert_allclose(alone, plain)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("", "empty"),
        ("L3 4", "want M first"),
        ("M3", "wants 2 numbers"),
        ("M3 4 L5 x", "wants 2 numbers"),
        ("M0 0 A5 5 0 0 1 3 3", "cubic curves"),
        ("M0 0 X", "is not one of"),
        ("M0 0 Z 5 5", "want a command"),
        ("M0 0 L1e30 4", "wants 2 numbers"),
        ("5 5", "want a command"),
    ],
)
def test_path_data_that_cannot_be_understood_is_told(text, word):
    with pytest.raises(MienError, match=word):
        parse_path(text)


def test_states_with_the_same_commands_have_the_same_vertices():
    small, large = parse_path("M0 0 C0 1 1 1 1 0 L2 2 Z"), parse_path("M0 0 C0 90 90 90 90 0 L200 2 Z")
    assert same_pieces(small, large)
    assert not same_pieces(small, parse_path("M0 0 L1 1 L2 2 Z"))
    steps = piece_steps([small, large])
    assert [len(c) for c in flatten(small, steps)] == [len(c) for c in flatten(large, steps)]
    assert steps == piece_steps([large, small])


def test_a_circle_of_curves_is_round():
    k = 0.5523 * 50
    circle = f"M50 0 C50 {k} {k} 50 0 50 C-{k} 50 -50 {k} -50 0 C-50 -{k} -{k} -50 0 -50 C{k} -50 50 -{k} 50 0 Z"
    outline = parse_path(circle)
    (points,) = flatten(outline, piece_steps([outline]))
    middles = 0.5 * (points + np.roll(points, -1, axis=0))
    assert np.abs(np.hypot(*middles.T) - 50.0).max() < 0.1


def test_straight_lines_are_cut_where_they_may_bend():
    outline = polygon_outline([[0, 0], [100, 0], [100, 10]])
    assert piece_steps([outline]) == (1, 9, 1)
    assert piece_steps([outline], bend=False) == (1, 1, 1)


def test_knots_are_met_and_outer_ones_hold():
    knots = ((0.0, 1.0), (0.5, 4.0), (1.0, 2.0))
    assert look_up(knots, np.array([-1.0, 0.0, 0.5, 1.0, 9.0])).tolist() == [1.0, 1.0, 4.0, 2.0, 2.0]
    assert look_up(((0.0, 3.0),), np.array([-2.0, 7.0])).tolist() == [3.0, 3.0]


def test_a_stroke_is_as_wide_as_told_and_its_ends_are_round():
    line = np.array([[0.0, 0.0], [5.0, 0.0], [10.0, 0.0]])
    (stroke,) = ribbon(line, half_widths(line, ((0.0, 4.0),)))
    low, high = stroke.min(axis=0), stroke.max(axis=0)
    np.testing.assert_allclose([low, high], [[-2.0, -2.0], [12.0, 2.0]])
    ends = stroke[(stroke[:, 0] < 0.0) | (stroke[:, 0] > 10.0)]
    middle = np.where(ends[:, :1] < 0.0, [[0.0, 0.0]], [[10.0, 0.0]])
    np.testing.assert_allclose(np.hypot(*(ends - middle).T), 2.0)


def test_a_closed_stroke_is_a_ring():
    angle = np.linspace(0.0, 2.0 * np.pi, 60, endpoint=False)
    line = 10.0 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    outer, inner = ribbon(line, np.full(60, 1.0), closed=True)
    radii = sorted([np.hypot(*outer.T).mean(), np.hypot(*inner.T).mean()])
    np.testing.assert_allclose(radii, [9.0, 11.0], atol=0.01)


def test_a_stroke_along_points_that_coincide_is_finite():
    (stroke,) = ribbon(np.zeros((4, 2)), half_widths(np.zeros((4, 2)), ((0.0, 2.0),)))
    assert np.isfinite(stroke).all()
