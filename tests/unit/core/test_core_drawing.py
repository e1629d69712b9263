"""Paths refuse outlines that cannot be drawn."""

import numpy as np
import pytest

from mien.core import Drawing, MienError, Path

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
