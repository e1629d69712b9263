"""Paths refuse outlines that cannot be drawn."""

import numpy as np
import pytest

from mien.core import Drawing, MienError, Path, Region, UnknownNameError

BLACK = (0.0, 0.0, 0.0, 1.0)


def test_a_drawing_keeps_its_paths_in_order():
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    paths = tuple(Path(name, (square,), BLACK) for name in ("face", "eye"))
    assert [path.name for path in Drawing((10.0, 10.0), paths).paths] == ["face", "eye"]


@pytest.mark.parametrize("shape", [(4, 3), (4,), (2, 2, 2)])
def test_a_contour_is_made_of_points_in_a_plane(shape):
    with pytest.raises(MienError, match="path 'mouth': a contour must be finite points"):
        Path("mouth", (np.zeros(shape),), BLACK)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_contour_is_finite(bad):
    contour = np.zeros((4, 2))
    contour[2, 1] = bad
    with pytest.raises(MienError, match="path 'mouth'"):
        Path("mouth", (np.zeros((3, 2)), contour), BLACK)


def test_a_region_is_checked_as_a_path_is():
    with pytest.raises(MienError, match="region: a contour must be finite points"):
        Region((np.zeros((4, 3)),))


def test_an_unknown_rule_is_refused_with_its_place():
    with pytest.raises(UnknownNameError, match="rule of path 'eye' 'even-odd' — did you mean 'evenodd'"):
        Path("eye", (), BLACK, rule="even-odd")
    with pytest.raises(UnknownNameError, match="rule of region 'odd'"):
        Region((), "odd")


@pytest.mark.parametrize(
    "color", [(0.0, 0.0, 0.0), (np.nan, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0, 1.5), (0.0,) * 3 + (-0.1,)]
)
def test_a_color_has_four_numbers(color):
    with pytest.raises(MienError, match="path 'lip': a colour is red, green, blue and an alpha"):
        Path("lip", (), color)


@pytest.mark.parametrize("size", [(0.0, 1.0), (1.0, -1.0), (np.inf, 1.0), (1.0,)])
def test_a_canvas_has_an_area(size):
    with pytest.raises(MienError, match="a canvas has a width and a height above 0"):
        Drawing(size, ())


def test_a_background_of_a_drawing_is_opaque():
    assert Drawing((1.0, 1.0), (), BLACK).background == BLACK
    with pytest.raises(MienError, match="must be opaque"):
        Drawing((1.0, 1.0), (), (0.0, 0.0, 0.0, 0.5))
