"""Pictures of 2-D faces: areas known by hand, the fast filler beside the plain one."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import Drawing, Path, Region, Scene
from mien.core.drawing import Rule
from mien.render import draw_drawing
from mien.render.drawing import coverage
from mien.render.renderer import RASTERISERS

RED, BLACK, WHITE = (1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0, 1.0), (1.0, 1.0, 1.0, 1.0)
CLEAR = ((0.0, 0.0, 0.0, 0.0),) * 2
RULES: tuple[Rule, ...] = ("evenodd", "nonzero")

POINTS = st.tuples(st.floats(-9, 20), st.floats(-9, 20))
CONTOURS = st.lists(st.lists(POINTS, min_size=3, max_size=7), min_size=1, max_size=3)


def box(left: float, bottom: float, right: float, top: float) -> np.ndarray:
    return np.array([[left, bottom], [right, bottom], [right, top], [left, top]])


def star(radius: float = 30.0, middle: float = 32.0) -> np.ndarray:
    """(5, 2) a pentagram in one stroke."""
    angle = np.pi * (0.5 + 0.8 * np.arange(5))
    return middle + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def pentagon_area(radius: float) -> float:
    """Of a regular pentagon."""
    return 2.5 * radius * radius * np.sin(0.4 * np.pi)


def filled(contours: list[np.ndarray], width: int, height: int, rule: Rule = "evenodd") -> np.ndarray:
    """(H, W) share of pixels that the fast filler covers, y up, to 1/255."""
    drawing = Drawing((float(width), float(height)), (Path("a", tuple(contours), RED, rule),))
    return draw_drawing(drawing, Scene(size_px=(width, height), background=CLEAR))[:, :, 3] / 255.0


def plain(contours: list[np.ndarray], width: int, height: int, rule: Rule = "evenodd") -> np.ndarray:
    """The same by the plain one, in lines so many that they make no steps."""
    return coverage([np.array([0, height]) + contour * (1, -1) for contour in contours], width, height, rule, 256)


WAYS = pytest.mark.parametrize("area", [filled, plain])


@WAYS
def test_path_covers_its_exact_area(area) -> None:
    wanted = np.zeros((4, 4))
    wanted[1:3] = [0.75, 1.0, 0.5, 0.0]
    np.testing.assert_allclose(area([box(0.25, 1.0, 2.5, 3.0)], 4, 4), wanted, atol=0.5 / 255)


@WAYS
@pytest.mark.parametrize("rule", RULES)
def test_half_a_pixel_is_half_covered_whichever_half(area, rule: Rule) -> None:
    for half in (box(1, 1, 1.5, 2), box(1, 1, 2, 1.5), box(1, 1, 2, 2)[:3], box(1, 1, 2, 2)[1:], box(1, 1, 2, 2)[::-2]):
        share = area([half], 3, 3, rule)
        assert share.sum() == share[1, 1] == pytest.approx(0.5 if len(half) > 2 else 0.0, abs=0.5 / 255 + 1e-9)


@WAYS
def test_contour_inside_another_is_a_hole_by_the_even_odd_rule_whichever_way_it_runs(area) -> None:
    outer, inner = box(0, 0, 4, 4), box(1, 1, 3, 3)
    for hole in (inner, inner[::-1]):
        share = area([outer, hole], 4, 4)
        assert share.sum() == 12.0
        assert share[1:3, 1:3].max() == 0.0


@WAYS
def test_contour_inside_another_is_a_hole_by_the_nonzero_rule_if_it_runs_against_it(area) -> None:
    outer, inner = box(0, 0, 4, 4), box(1, 1, 3, 3)
    assert area([outer, inner], 4, 4, "nonzero").sum() == 16.0
    assert area([outer, inner[::-1]], 4, 4, "nonzero").sum() == 12.0


@WAYS
def test_the_middle_of_a_star_is_a_hole_by_one_rule_and_not_by_the_other(area) -> None:
    # The inner pentagon is smaller by the square of the golden ratio; the five points are root 5 times as large as it.
    inner = pentagon_area(30.0 / ((1.0 + np.sqrt(5.0)) / 2.0) ** 2)
    points = inner * np.sqrt(5.0)
    even, whole = (area([star()], 64, 64, rule) for rule in RULES)
    assert even.sum() == pytest.approx(points, rel=1e-3)
    assert whole.sum() == pytest.approx(points + inner, rel=1e-3)
    assert even[32, 32] == pytest.approx(0.0)
    assert whole[32, 32] == pytest.approx(1.0)


@WAYS
def test_edges_that_cross_in_a_pixel_are_parted_there(area) -> None:
    bow_tie = np.array([[1.0, 1.0], [2.0, 2.0], [2.0, 1.0], [1.0, 2.0]])
    for rule in RULES:
        share = area([bow_tie], 3, 3, rule)
        assert share[1, 1] == share.sum() == pytest.approx(0.5, abs=0.5 / 255 + 1e-3)


@WAYS
def test_the_same_outline_twice_is_nothing_by_one_rule_and_itself_by_the_other(area) -> None:
    round_ = star()[[0, 3, 1, 4, 2]]
    assert area([round_, round_], 64, 64, "evenodd").max() == 0.0
    np.testing.assert_array_equal(area([round_, round_], 64, 64, "nonzero"), area([round_], 64, 64))


@settings(deadline=None, max_examples=100)
@given(CONTOURS, st.sampled_from(RULES))
def test_any_outline_covers_what_many_lines_through_it_find(
    points: list[list[tuple[float, float]]], rule: Rule
) -> None:
    contours = [np.array(contour) for contour in points]
    # 256 lines a pixel: each corner and crossing in it may be missed by one.
    np.testing.assert_allclose(filled(contours, 12, 10, rule), plain(contours, 12, 10, rule), atol=0.03)


@settings(deadline=None, max_examples=50)
@given(st.lists(st.tuples(st.floats(1, 11), st.floats(1, 9)), min_size=3, max_size=3))
def test_triangle_covers_its_area(points: list[tuple[float, float]]) -> None:
    (ax, ay), (bx, by), (cx, cy) = points
    area = abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2.0
    share = filled([np.array(points)], 12, 10)
    assert share.sum() == pytest.approx(area, abs=0.5 / 255 * np.count_nonzero((share > 0) & (share < 1)) + 0.01)


@pytest.mark.parametrize("far", [1e4, 1e9, 1e30, 1e300])
def test_outlines_may_reach_as_far_as_numbers_do(far: float) -> None:
    assert filled([box(-far, 1.0, far, 2.5)], 4, 4).sum(axis=1) == pytest.approx([0.0, 2.0, 4.0, 0.0], abs=0.01)
    assert filled([box(1.5, -far, 3.0, far)], 4, 4)[2] == pytest.approx([0.0, 0.5, 1.0, 0.0], abs=0.01)
    lower_left = np.array([[-far, -far], [far, -far], [-far, far]])
    if far < 1e9:
        assert filled([lower_left + 2.0], 4, 4).sum() == pytest.approx(8.0, abs=0.02)
    assert (filled([box(-far, -far, far, far)], 4, 4) == 1.0).all()


def test_outlines_without_area_draw_nothing() -> None:
    point, line = np.full((4, 2), 1.5), np.array([[0.5, 0.5], [3.5, 3.0]])
    there_and_back = np.array([[0.5, 0.5], [3.5, 3.0], [2.0, 1.75], [3.5, 3.0]])
    for nothing in ([], [np.zeros((0, 2))], [point], [point[:1]], [line], [there_and_back]):
        for rule in RULES:
            assert not filled(nothing, 4, 4, rule).any()


def test_a_scribble_of_thousands_of_points_is_filled() -> None:
    scribble = np.random.default_rng(3).uniform(0.0, 16.0, (3000, 2))
    even, whole = (filled([scribble], 16, 16, rule) for rule in RULES)
    assert even[4:12, 4:12].mean() == pytest.approx(0.5, abs=0.05)
    assert whole[4:12, 4:12].min() > 0.9


def test_canvas_is_fitted_and_stands_on_the_lower_edge_with_y_upwards() -> None:
    drawing = Drawing((2.0, 1.0), (Path("floor", (box(0, 0, 2, 0.5),), RED),))
    for rasteriser in RASTERISERS:
        picture = draw_drawing(drawing, Scene(size_px=(20, 20), background=CLEAR), rasteriser=rasteriser)
        rows = np.flatnonzero(picture[:, 10, 3])
        assert (rows.min(), rows.max()) == (15, 19), "the lower half of a canvas 10 pixels high, at the bottom"
        assert (picture[17] == [255, 0, 0, 255]).all()


def test_a_drawing_brings_its_own_background_which_a_scene_may_replace() -> None:
    drawing = Drawing((2.0, 1.0), (), (0.0, 0.0, 1.0, 1.0))
    for rasteriser in RASTERISERS:
        own = draw_drawing(drawing, Scene(size_px=(20, 20)), rasteriser=rasteriser)
        assert (own == [0, 0, 255, 255]).all()
        assert not draw_drawing(drawing, Scene(size_px=(20, 20), background=CLEAR), rasteriser=rasteriser).any()


def test_later_paths_lie_over_earlier_ones_by_their_alpha() -> None:
    half_blue = (0.0, 0.0, 1.0, 0.5)
    paths = (Path("a", (box(0, 0, 4, 4),), RED), Path("b", (box(0, 0, 2, 4),), half_blue))
    for rasteriser in RASTERISERS:
        picture = draw_drawing(
            Drawing((4.0, 4.0), paths), Scene(size_px=(4, 4), background=CLEAR), rasteriser=rasteriser
        )
        assert picture[1, 0].tolist() == [188, 0, 188, 255]
        assert picture[1, 3].tolist() == [255, 0, 0, 255]


def test_paths_outside_of_the_picture_and_empty_ones_draw_nothing() -> None:
    paths = (Path("far", (box(50, 50, 60, 60),), RED), Path("none", (), RED), Path("line", (np.zeros((2, 2)),), RED))
    picture = draw_drawing(Drawing((4.0, 4.0), paths), Scene(size_px=(6, 4), background=CLEAR))
    assert not picture.any()


def test_a_path_is_drawn_inside_of_all_of_some_regions_and_outside_of_all_of_others() -> None:
    left, low, dot = Region((box(0, 0, 2.5, 4),)), Region((box(0, 0, 4, 3),)), Region((box(1, 1, 2, 2),))
    paths = (Path("a", (box(0, 0, 4, 4),), RED, inside=(left, low), outside=(dot,)),)
    wanted = np.array([[0, 0, 0, 0], [1, 1, 0.5, 0], [1, 0, 0.5, 0], [1, 1, 0.5, 0]])
    for rasteriser in RASTERISERS:
        scene = Scene(size_px=(4, 4), background=CLEAR)
        share = draw_drawing(Drawing((4.0, 4.0), paths), scene, rasteriser=rasteriser)[:, :, 3] / 255.0
        np.testing.assert_allclose(share, wanted, atol=0.5 / 255)


def test_a_region_has_a_rule_of_its_own_and_may_be_empty() -> None:
    overlap = (box(0, 0, 3, 3), box(1, 1, 4, 4))
    scene, square = Scene(size_px=(4, 4), background=CLEAR), (box(0, 0, 4, 4),)

    def covered(**cut: tuple[Region, ...]) -> float:
        drawing = Drawing((4.0, 4.0), (Path("a", square, RED, **cut),))
        return float(draw_drawing(drawing, scene)[:, :, 3].sum() / 255.0)

    assert covered(inside=(Region(overlap, "evenodd"),)) == 10.0
    assert covered(inside=(Region(overlap, "nonzero"),)) == 14.0
    assert covered(outside=(Region(overlap, "nonzero"),)) == 2.0
    assert covered(inside=(Region(()),)) == 0.0
    assert covered(outside=(Region(()),)) == 16.0


@pytest.mark.parametrize("threads", [1, 3])
def test_what_fills_a_hole_and_what_has_it_leave_no_seam(threads: int) -> None:
    hole = star(21.0)[[0, 3, 1, 4, 2]]
    opening = Region((hole,))
    drawing = Drawing(
        (64.0, 64.0),
        (
            Path("hole", opening.contours, WHITE),
            Path("face", (star(31.0)[[0, 3, 1, 4, 2]],), WHITE, outside=(opening,)),
        ),
        BLACK,
    )
    together = Drawing((64.0, 64.0), (Path("face", drawing.paths[1].contours, WHITE),), BLACK)
    scene = Scene(size_px=(64, 64))
    picture = draw_drawing(drawing, scene, threads=threads).astype(int)
    assert np.abs(picture - draw_drawing(together, scene)).max() <= 1


def test_a_hole_beyond_the_face_keeps_its_own_edge() -> None:
    hole = (box(1.0, 1.0, 3.5, 3.5),)
    paths = (Path("hole", hole, RED), Path("face", (box(0, 0, 2, 4),), RED, outside=(Region(hole),)))
    picture = draw_drawing(Drawing((4.0, 4.0), paths), Scene(size_px=(4, 4), background=CLEAR))
    np.testing.assert_allclose(picture[1, :, 3], [255, 255, 255, 128], atol=1)


@WAYS
def test_hatching_finer_than_pixels_is_grey(area) -> None:
    teeth = area([box(x, 1.0, x + 0.01, 15.0) for x in 1.0 + 0.02 * np.arange(700)], 16, 16)
    assert teeth[2:14, 2:14] == pytest.approx(0.5, abs=0.02)
    assert teeth[0].max() == teeth[-1].max() == 0.0
