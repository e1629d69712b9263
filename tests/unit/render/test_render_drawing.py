"""Pictures of 2-D faces: areas known by hand."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import Drawing, Path, Scene
from mien.render import draw_drawing
from mien.render.drawing import coverage

RED = (1.0, 0.0, 0.0, 1.0)
CLEAR = ((0.0, 0.0, 0.0, 0.0),) * 2


def box(left: float, bottom: float, right: float, top: float) -> np.ndarray:
    return np.array([[left, bottom], [right, bottom], [right, top], [left, top]])


def test_path_covers_its_exact_area() -> None:
    share = coverage([box(0.25, 1.0, 2.5, 3.0)], 4, 4)
    wanted = np.zeros((4, 4))
    wanted[1:3] = [0.75, 1.0, 0.5, 0.0]
    np.testing.assert_allclose(share, wanted)


def test_contour_inside_another_is_a_hole_whichever_way_it_runs() -> None:
    outer, inner = box(0, 0, 4, 4), box(1, 1, 3, 3)
    for hole in (inner, inner[::-1]):
        share = coverage([outer, hole], 4, 4)
        np.testing.assert_allclose(share.sum(), 12.0)
        assert share[1:3, 1:3].max() == 0.0


@settings(deadline=None, max_examples=50)
@given(st.lists(st.tuples(st.floats(-9, 20), st.floats(-9, 20)), min_size=3, max_size=9))
def test_any_contour_covers_between_nothing_and_all(points: list[tuple[float, float]]) -> None:
    share = coverage([np.array(points)], 12, 10)
    assert share.shape == (10, 12)
    assert np.isfinite(share).all()
    assert share.min() >= 0.0
    assert share.max() <= 1.0


@settings(deadline=None, max_examples=50)
@given(st.lists(st.tuples(st.floats(1, 11), st.floats(1, 9)), min_size=3, max_size=3))
def test_triangle_covers_its_area(points: list[tuple[float, float]]) -> None:
    (ax, ay), (bx, by), (cx, cy) = points
    area = abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2.0
    # Eight lines a pixel: the error of each is at most an eighth of the width that the outline crosses there.
    np.testing.assert_allclose(coverage([np.array(points)], 12, 10).sum(), area, atol=0.65)


def test_canvas_is_fitted_and_centred_with_y_upwards() -> None:
    drawing = Drawing((2.0, 1.0), (Path("floor", (box(0, 0, 2, 0.5),), RED),))
    picture = draw_drawing(drawing, Scene(size_px=(20, 20), background=CLEAR))
    rows = np.flatnonzero(picture[:, 10, 3])
    assert (rows.min(), rows.max()) == (10, 14), "the lower half of a canvas 10 pixels high, in the middle"
    assert (picture[12] == [255, 0, 0, 255]).all()


def test_a_drawing_brings_its_own_background_which_a_scene_may_replace() -> None:
    drawing = Drawing((2.0, 1.0), (), (0.0, 0.0, 1.0, 1.0))
    assert (draw_drawing(drawing, Scene(size_px=(20, 20))) == [0, 0, 255, 255]).all()
    assert not draw_drawing(drawing, Scene(size_px=(20, 20), background=CLEAR)).any()


def test_later_paths_lie_over_earlier_ones_by_their_alpha() -> None:
    half_blue = (0.0, 0.0, 1.0, 0.5)
    paths = (Path("a", (box(0, 0, 4, 4),), RED), Path("b", (box(0, 0, 2, 4),), half_blue))
    picture = draw_drawing(Drawing((4.0, 4.0), paths), Scene(size_px=(4, 4), background=CLEAR))
    assert picture[1, 0].tolist() == [188, 0, 188, 255]
    assert picture[1, 3].tolist() == [255, 0, 0, 255]


def test_paths_outside_of_the_picture_and_empty_ones_draw_nothing() -> None:
    paths = (Path("far", (box(50, 50, 60, 60),), RED), Path("none", (), RED), Path("line", (np.zeros((2, 2)),), RED))
    picture = draw_drawing(Drawing((4.0, 4.0), paths), Scene(size_px=(6, 4), background=CLEAR))
    assert not picture.any()
