"""Colours taken from photographs."""

from __future__ import annotations

import numpy as np

from mien.capture.coloring import even_out, hex_color, middle_color, sample_colors
from mien.capture.records import Camera, Lens, Observation, Photograph, Solution, SolvedPoint, Survey
from mien.faces.keypose.records import KeyposeTopology, Polygon, SkinPart

SQUARE = ((-0.5, -0.5), (-0.5, 0.5), (0.5, 0.5), (0.5, -0.5))
TWO = KeyposeTopology((SkinPart("skin", (Polygon((1, 4, 3, 2), "#808080"), Polygon((4, 6, 5, 3), "#808080"))),), ())
"""Two squares with an edge in common."""


def seen_square(clicked: str) -> Solution:
    """A square before a camera, some of whose corners were clicked; it covers pixels 25 to 75 of 100."""
    camera = Camera(Lens(100.0, (50.0, 50.0)), np.eye(3), np.array([0.0, 0.0, -2.0]))
    places = [(*corner, 0.0) for corner in SQUARE] + [(1.4, 0.5, 0.0), (1.4, -0.5, 0.0)]
    points = {
        ("rest", str(k)): SolvedPoint(str(k), "rest", np.array(place), np.eye(3) * 1e-8, ("a.jpg",))
        for k, place in enumerate(places, start=1)
    }
    observations = tuple(Observation("a.jpg", name, 0.0, 0.0) for name in clicked)
    return Solution(Survey((Photograph("a.jpg", (100, 100), "a"),), observations, ()), {"a.jpg": camera}, points, ())


def picture() -> np.ndarray:
    """Blue, with a red square, and dots at its corners."""
    out = np.full((100, 100, 3), [10, 20, 200], dtype=np.uint8)
    out[25:75, 25:75] = [200, 30, 40]
    for v in (25, 74):
        for u in (25, 74):
            out[v - 3 : v + 4, u - 3 : u + 4] = 0
    return out


def test_a_polygon_has_the_colour_inside_of_it_not_of_the_dots_at_its_corners():
    colors, looks = sample_colors(seen_square("1234"), TWO, list("123456"), lambda _: picture())
    np.testing.assert_allclose(colors[0], [200, 30, 40])
    assert looks[0] > 0
    assert np.isnan(colors[1]).all()
    assert looks[1] == 0


def test_a_polygon_of_which_only_an_edge_is_seen_is_not_looked_at():
    _, looks = sample_colors(seen_square("12"), TWO, list("123456"), lambda _: picture())
    assert looks.tolist() == [0, 0]


def test_a_polygon_that_turns_its_back_is_not_looked_at():
    behind = KeyposeTopology(
        (SkinPart("skin", (Polygon((1, 2, 3, 4), "#808080"), Polygon((3, 5, 6, 4), "#808080"))),), ()
    )
    assert sample_colors(seen_square("123456"), behind, list("123456"), lambda _: picture())[1].tolist() == [0, 0]


def test_a_highlight_is_ignored():
    looks = np.array([[100.0, 80.0, 60.0]] * 9 + [[102.0, 80.0, 60.0]] * 2 + [[255.0, 255.0, 255.0]] * 3)
    np.testing.assert_allclose(middle_color(looks), [100.0 + 4.0 / 11.0, 80.0, 60.0])


def test_neighbours_drafted_alike_come_nearer_to_one_another():
    colors = np.array([[100.0, 100.0, 100.0], [110.0, 90.0, 100.0]])
    even = even_out(colors, TWO)
    assert abs(even[0, 0] - even[1, 0]) < 1.0
    np.testing.assert_allclose(even.mean(axis=0), colors.mean(axis=0))


def test_neighbours_drafted_otherwise_keep_their_border():
    other = KeyposeTopology(
        (SkinPart("skin", (Polygon((1, 4, 3, 2), "#808080"), Polygon((4, 6, 5, 3), "#ff0000"))),), ()
    )
    colors = np.array([[100.0, 100.0, 100.0], [200.0, 10.0, 10.0]])
    np.testing.assert_allclose(even_out(colors, other), colors)


def test_what_nobody_sees_is_coloured_like_what_was_drafted_alike_or_as_drafted():
    colors = np.array([[100.0, 90.0, 80.0], [np.nan] * 3])
    np.testing.assert_allclose(even_out(colors, TWO)[1], [100.0, 90.0, 80.0])
    np.testing.assert_allclose(even_out(np.full((2, 3), np.nan), TWO), 128.0)


def test_colours_are_written_as_codes():
    assert hex_color(np.array([255.4, 0.4, 17.0])) == "#ff0011"
