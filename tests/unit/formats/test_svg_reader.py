"""What SVG files show, at values worked out by hand."""

import math

import pytest

from mien.core import LoadError
from mien.formats.svg_reader import read_svg
from mien.formats.svg_reader_outlines import Contour, arc, flatten, path_data, thin
from mien.formats.svg_reader_paints import parse_color
from mien.formats.svg_reader_paths import parse_length, parse_path, parse_transform

SVG = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 100 100"'
SVG += "{}>{}</svg>"


@pytest.fixture
def read(tmp_path):
    def read_text(inside, attributes=""):
        path = tmp_path / "drawing.svg"
        path.write_text(SVG.format(attributes, inside), encoding="utf-8")
        return read_svg(path)

    return read_text


def ends(outline):
    return [[contour.start, *(segment[-1] for segment in contour.segments)] for contour in outline]


def near(points):
    return [pytest.approx(point, abs=1e-9) for point in points]


@pytest.mark.parametrize(
    ("data", "wanted"),
    [
        ("M1 2L3 4", [[(1, 2), (3, 4)]]),
        ("m1,2 3,4 5,6", [[(1, 2), (4, 6), (9, 12)]]),
        ("M1 2 3 4H7V9h-1v-1", [[(1, 2), (3, 4), (7, 4), (7, 9), (6, 9), (6, 8)]]),
        ("M0 0L1 0L1 1zm5 5l1 0", [[(0, 0), (1, 0), (1, 1)], [(5, 5), (6, 5)]]),
        ("M0 0L2 0L2 2zL9 9", [[(0, 0), (2, 0), (2, 2)], [(0, 0), (9, 9)]]),
        ("M.5.5-1-1e1", [[(0.5, 0.5), (-1, -10)]]),
        ("M0 0a1 1 0 012 0", [[(0, 0), (1, -1), (2, 0)]]),
        ("M0 0A1 1 0 1,0 2,0", [[(0, 0), (1, 1), (2, 0)]]),
        ("  ", []),
        ("M3 3", []),
    ],
)
def test_path_data_goes_through_its_points(data, wanted):
    assert ends(parse_path(data, 1000)) == [near(points) for points in wanted]


def test_smooth_commands_mirror_the_handle_before_them():
    (contour,) = parse_path("M0 0C0 1 1 1 1 0S2 -1 2 0", 100)
    assert contour.segments[1][0] == (1.0, -1.0)
    (contour,) = parse_path("M0 0Q1 3 2 0T4 0", 100)
    assert contour.segments[1][0] == pytest.approx((2 + 2 / 3, -2.0))
    (contour,) = parse_path("M0 0L1 0S2 -1 2 0", 100)
    assert contour.segments[1][0] == (1.0, 0.0)


@pytest.mark.parametrize(
    ("data", "word"),
    [
        ("L1 1", "want M first"),
        ("M1", "2 numbers for M"),
        ("M1 2X", "2 numbers for M"),
        ("M0 0A1 1 0 2 0 1 1", "7 numbers"),
        ("X", "a command"),
    ],
)
def test_path_data_that_cannot_be_understood_is_refused_with_the_place(read, data, word):
    with pytest.raises(LoadError, match=rf"drawing\.svg:1: d of <path>: .*{word}"):
        read(f'<path d="{data}"/>')


def test_an_arc_stays_on_its_ellipse_and_one_that_is_too_small_grows():
    points = arc((3.0, 0.0), 3.0, 2.0, 0.0, True, True, (0.0, -2.0))
    assert len(points) == 9
    line = flatten(Contour((3.0, 0.0), tuple(tuple(points[k : k + 3]) for k in (0, 3, 6)), False), 0.001)
    assert all(abs(math.hypot(x / 3.0, y / 2.0) - 1.0) < 3e-4 for x, y in line)
    assert max(y for _, y in line) == pytest.approx(2.0, abs=1e-3)
    assert arc((0.0, 0.0), 1.0, 1.0, 0.0, False, True, (10.0, 0.0))[2] == pytest.approx((5.0, -5.0))


def test_transforms_apply_the_last_first():
    x, y = 1.0, 0.0
    a, b, c, d, e, f = parse_transform("translate(10) rotate(90), scale(2 3)")
    assert (a * x + c * y + e, b * x + d * y + f) == pytest.approx((10.0, 2.0))
    assert parse_transform("rotate(180 5 5)") == pytest.approx((-1, 0, 0, -1, 10, 10))
    assert parse_transform("skewX(45)")[2] == pytest.approx(1.0)


@pytest.mark.parametrize(("text", "pixels"), [("2", 2), ("1in", 96), ("25.4mm", 96), ("3pt", 4), ("50%", 100)])
def test_lengths_have_units(text, pixels):
    assert parse_length(text, 200.0) == pytest.approx(pixels)


@pytest.mark.parametrize(
    ("text", "color"),
    [
        ("#f00", (1, 0, 0, 1)),
        ("rgb(0 128 255 / 50%)", (0, 128 / 255, 1, 0.5)),
        ("rgba(0, 0, 0, .25)", (0, 0, 0, 0.25)),
        ("hsl(120, 100%, 50%)", (0, 1, 0, 1)),
        ("RebeccaPurple", (0.4, 0.2, 0.6, 1)),
        ("currentColor", (0, 0, 1, 1)),
        ("none", None),
    ],
)
def test_colors(text, color):
    found = parse_color(text, "blue")
    assert found == (None if color is None else pytest.approx(color))


def test_the_weightier_rule_wins_and_style_wins_over_rules(read):
    style = "<style>/* a } */ path{fill:red} .a{fill:lime} #p.a{fill:blue}</style>"
    square = 'd="M0 0h9v9z"'
    drawing = read(
        f'{style}<path {square} fill="white"/><path class="a b" {square}/><path id="p" class="a" {square}/>'
        f'<path id="p" class="a" style="fill: #ffffff" {square}/>'
    )
    assert [shape.color[:3] for shape in drawing.shapes] == [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]


def test_what_groups_hand_on(read):
    drawing = read(
        '<g fill="none" stroke="currentColor" color="#00ff00" opacity=".5" transform="scale(2)">'
        '<line x1="0" y1="0" x2="5" y2="0" stroke-width="3" stroke-opacity=".5"/>'
        '<circle cx="5" cy="5" r="2" fill="inherit" stroke="none"/>'
        '<rect width="3" height="4" fill="#000" stroke="none"/></g>'
    )
    line, square = drawing.shapes
    assert line.color == (0.0, 1.0, 0.0, 0.25)
    assert (line.width, ends(line.outline)) == (6.0, [[(0, 0), (10, 0)]])
    assert ends(square.outline) == [[(0, 0), (6, 0), (6, 8), (0, 8)]]


def test_names_of_shapes_and_of_the_layers_around_them(read):
    namespace = ' xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
    (shape,) = read('<g id="g1" inkscape:label="eye left"><path id="p7" d="M0 0h9v9z"/></g>', namespace).shapes
    assert (shape.names, shape.groups) == (("p7",), ("eye left", "g1"))


def test_things_are_used_where_they_are_put(read):
    drawing = read(
        '<defs><circle id="c" r="1"/><symbol id="s" viewBox="0 0 2 2"><rect width="2" height="2"/></symbol></defs>'
        '<use href="#c" x="10" y="20"/><use xlink:href="#s" x="50" width="20" height="10"/>'
    )
    dot, square = (ends(shape.outline)[0] for shape in drawing.shapes)
    assert dot[0] == (11.0, 20.0)
    assert square[0] == (55.0, 0.0)
    assert square[2] == (65.0, 10.0)


def test_a_nested_svg_has_its_own_view(read):
    (shape,) = read(
        '<svg x="10" y="10" width="50%" height="50" viewBox="0 0 10 10"><rect width="10" height="10"/></svg>'
    ).shapes
    assert ends(shape.outline)[0][2] == (60.0, 60.0)


def test_what_is_not_displayed_is_not_there(read):
    drawing = read(
        '<g style="display:none"><path d="M0 0h9v9z"/></g><path visibility="hidden" d="M0 0h9v9z"/>'
        '<path fill="none" d="M0 0h9v9z"/><path opacity="0" d="M0 0h9v9z"/><rect width="0" height="5"/>'
        '<rect width="5" height="5"/>'
    )
    assert len(drawing.shapes) == 1


def test_a_gradient_is_the_mean_of_its_colours_with_a_remark(read):
    drawing = read(
        '<linearGradient id="a"><stop offset="50%" stop-color="white"/><stop offset="1" stop-color="black"/>'
        '</linearGradient><radialGradient id="b" xlink:href="#a"/><path fill="url(#b)" d="M0 0h9v9z"/>'
    )
    assert drawing.shapes[0].color == pytest.approx((0.75, 0.75, 0.75, 1.0))
    assert any("<radialGradient> 'b' becomes the mean" in remark for remark in drawing.remarks)


def test_clips_of_groups_and_shapes_add_up(read):
    clips = '<clipPath id="a"><circle r="5"/></clipPath><clipPath id="b"><rect width="4" height="4"/></clipPath>'
    drawing = read(
        f'<defs>{clips}</defs><g clip-path="url(#a)" transform="translate(10)">'
        '<rect width="9" height="9" clip-path="url(#b)" stroke="#000"/></g>'
        '<rect width="9" height="9" clip-path="url(#c)"/>'
    )
    fill, stroke, free = drawing.shapes
    assert [ends(clip)[0][0] for clip in fill.clips] == [(15.0, 0.0), (10.0, 0.0)]
    assert stroke.clips == fill.clips
    assert free.clips == ()
    assert [text.partition(": ")[2] for text in drawing.remarks] == ["clip-path of <rect> is not followed"]


def test_a_dot_is_a_stroke_without_length_and_with_round_ends(read):
    drawing = read('<path d="M5 5h0" stroke="#000" stroke-width="4" stroke-linecap="round"/>')
    (dot,) = drawing.shapes
    assert dot.width == 0.0
    assert ends(dot.outline)[0][0] == (7.0, 5.0)


def test_a_canvas_without_a_size_is_refused(tmp_path):
    path = tmp_path / "a.svg"
    path.write_text('<svg xmlns="http://www.w3.org/2000/svg"><rect width="5" height="5"/></svg>')
    with pytest.raises(LoadError, match=r"a\.svg:1: the size of the drawing is not known"):
        read_svg(path)


def test_a_canvas_begins_where_its_view_does(tmp_path):
    path = tmp_path / "a.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-10 -20 50 60"><rect width="5" height="5"/></svg>'
    )
    drawing = read_svg(path)
    assert drawing.size == (50.0, 60.0)
    assert ends(drawing.shapes[0].outline)[0][0] == (10.0, 20.0)


def test_short_lines_are_thinned_within_the_tolerance():
    points = [(number / 10.0, 0.01 * (number % 2)) for number in range(100)]
    (contour,) = thin((Contour((0.0, 0.0), tuple((point,) for point in points[1:]), False),), 0.1)
    assert contour.segments == (((9.9, 0.01),),)
    corner = (Contour((0.0, 0.0), (((5.0, 3.0),), ((10.0, 0.0),)), False),)
    assert thin(corner, 0.1) == corner


def test_path_data_is_written_with_absolute_commands():
    text = path_data(parse_path("m1 1h2q1 1 2 0z", 100), lambda value: f"{value:.1f}")
    assert text == "M 1.0 1.0 L 3.0 1.0 C 3.7 1.7 4.3 1.7 5.0 1.0 Z"
