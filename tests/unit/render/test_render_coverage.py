"""Which pixels a triangle covers: answers known by hand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import Material, Mesh, Scene, build_topology
from mien.render import draw_mesh, spans
from mien.render.plan import plan_shading
from mien.render.reference import coverage

BOTH = pytest.mark.parametrize("rasteriser", ["compiled", "reference"])
CLEAR = ((0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0))
GLOW = Material(lit=False)


def flat_mesh(points: list[list[float]], polygons: list[list[int]], material: Material = GLOW) -> Mesh:
    topology = build_topology(len(points), [("sample", np.array(polygons), material)])
    return Mesh(topology, np.array(points, dtype=float), np.ones((len(points), 3)))


def unit_scene(size: int, **more: object) -> Scene:
    """A camera at distance 1 that sees exactly -1..1 in both directions of the plane z = 0."""
    return Scene(
        position=(0.0, 0.0, 1.0),
        at=(0.0, 0.0, 0.0),
        fov_deg=90.0,
        size_px=(size, size),
        background=CLEAR,
        subdivide=0,
        **more,  # type: ignore[arg-type]
    )


@BOTH
def test_triangle_covers_exactly_half_of_the_picture(rasteriser: str) -> None:
    mesh = flat_mesh([[-1, -1, 0], [1, -1, 0], [-1, 1, 0]], [[0, 1, 2]])
    picture = draw_mesh(mesh, unit_scene(16), samples=1, rasteriser=rasteriser)  # type: ignore[arg-type]
    rows, columns = np.indices((16, 16))
    # The long side runs through the centres of the diagonal from the upper left; it is a right side, which owns none.
    np.testing.assert_array_equal(picture[..., 3] == 255, columns < rows)


@BOTH
def test_triangle_owns_its_left_side(rasteriser: str) -> None:
    mesh = flat_mesh([[1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2]])
    picture = draw_mesh(mesh, unit_scene(16), samples=1, rasteriser=rasteriser)  # type: ignore[arg-type]
    rows, columns = np.indices((16, 16))
    np.testing.assert_array_equal(picture[..., 3] == 255, columns >= rows)


@BOTH
def test_edges_of_a_polygon_take_a_quarter_a_sample(rasteriser: str) -> None:
    # The right edge runs through the middle of pixel column 4: samples at 4.25 are inside, those at 4.75 are not.
    mesh = flat_mesh([[-1, -1, 0], [0.125, -1, 0], [0.125, 1, 0], [-1, 1, 0]], [[0, 1, 2, 3]])
    picture = draw_mesh(mesh, unit_scene(8), samples=4, rasteriser=rasteriser)  # type: ignore[arg-type]
    assert picture[3, :, 3].tolist() == [255, 255, 255, 255, 128, 0, 0, 0]
    assert (picture[..., :3][picture[..., 3] > 0] == 255).all(), "straight alpha: the colour itself stays white"


@BOTH
def test_square_through_the_near_plane_covers_what_lies_before_the_viewer(rasteriser: str) -> None:
    # A floor one metre under the viewer, from far before him to far behind him: it fills the lower half.
    floor = flat_mesh([[-900, -1, 900], [900, -1, 900], [900, -1, -900], [-900, -1, -900]], [[0, 1, 2, 3]])
    picture = draw_mesh(floor, unit_scene(32), samples=1, rasteriser=rasteriser)  # type: ignore[arg-type]
    covered = picture[..., 3] == 255
    assert covered[17:].all()
    assert not covered[:16].any()


@BOTH
def test_nearer_polygon_hides_the_farther_whatever_their_order(rasteriser: str) -> None:
    topology = build_topology(8, [("sample", np.array([[0, 1, 2, 3], [4, 5, 6, 7]]), GLOW)])
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float)
    near, far = square * 0.5 + [0, 0, 0.25], square * 2 - [0, 0, 0.5]
    red, blue = np.tile([1.0, 0, 0], (4, 1)), np.tile([0, 0, 1.0], (4, 1))
    for points, colors in (((near, far), (red, blue)), ((far, near), (blue, red))):
        mesh = Mesh(topology, np.concatenate(points), np.concatenate(colors))
        picture = draw_mesh(mesh, unit_scene(24), samples=1, rasteriser=rasteriser)  # type: ignore[arg-type]
        assert picture[12, 12].tolist() == [255, 0, 0, 255]
        assert picture[1, 1].tolist() == [0, 0, 255, 255]


@BOTH
def test_polygon_seen_from_behind_is_drawn_only_when_two_sided(rasteriser: str) -> None:
    turned = [[-1.0, -1, 0], [-1, 1, 0], [1, 1, 0], [1, -1, 0]]
    for two_sided in (False, True):
        mesh = flat_mesh(turned, [[0, 1, 2, 3]], Material(lit=False, two_sided=two_sided))
        picture = draw_mesh(mesh, unit_scene(8), samples=1, rasteriser=rasteriser)  # type: ignore[arg-type]
        assert (picture[..., 3] == (255 if two_sided else 0)).all()


@BOTH
def test_colour_is_interpolated_in_perspective(rasteriser: str) -> None:
    # A floor whose redness is its distance: between 1 m and 9 m away, 3 m is a third of the way up the picture.
    points = [[-9, -1, 0], [9, -1, 0], [9, -1, -8], [-9, -1, -8]]
    mesh = flat_mesh(points, [[0, 1, 2, 3]])
    mesh = Mesh(mesh.topology, mesh.points, np.array([[0.0] * 3, [0.0] * 3, [0.8] * 3, [0.8] * 3]))
    picture = draw_mesh(mesh, unit_scene(900), samples=1, rasteriser=rasteriser)  # type: ignore[arg-type]
    row = 450 + 150  # y / z = -1/3 there: 3 m away, a quarter of the way from 1 m to 9 m
    assert abs(int(picture[row, 450, 0]) - 124) <= 1, "linear 0.2 is sRGB 124"


coordinates = st.integers(-4 * 256, 20 * 256)
places = st.tuples(coordinates, coordinates)


@settings(deadline=None, max_examples=150)
@given(a=places, b=places, c=places, d=places)
def test_neighbours_share_out_every_pixel_of_their_common_edge(
    a: tuple[int, int], b: tuple[int, int], c: tuple[int, int], d: tuple[int, int]
) -> None:
    def side(p: tuple[int, int]) -> int:
        return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])

    if side(c) * side(d) >= 0:
        return
    count = np.zeros((16, 16), dtype=int)
    for triangle in ((a, b, c), (b, a, d)):
        rows, columns, covered = coverage(np.array(triangle), 16, 16)
        count[rows, columns] += covered
    assert count.max() <= 1
    # A centre on the common edge, between its ends, belongs to one of the two.
    for y in range(16):
        for x in range(16):
            p = (x * 256 + 128, y * 256 + 128)
            between = min(a[0], b[0]) <= p[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= p[1] <= max(a[1], b[1])
            if side(p) == 0 and between and p not in (a, b):
                assert count[y, x] == 1


def test_fan_of_slivers_leaves_no_crack() -> None:
    angles = np.linspace(0.0, 2.0 * np.pi, 101)[:-1]
    rim = np.stack([3 * np.cos(angles), 3 * np.sin(angles), np.zeros(100)], axis=1)
    polygons = [[100, k, (k + 1) % 100] for k in range(100)]
    mesh = flat_mesh([*rim.tolist(), [0.3, 0.2, 0.0]], polygons)
    assert (draw_mesh(mesh, unit_scene(64))[..., 3] == 255).all()


@cache
def first_sample() -> Callable[[float, float, float, float], int]:
    """The kernel as Numba compiles it, so that it can be called from here."""
    compiled: Callable[[float, float, float, float], int] = numba.njit(error_model="numpy")(spans.first_sample.function)
    return compiled


raster = st.integers(-2048, 2**23 + 2048)


@settings(deadline=None, max_examples=400)
@given(ax=raster, ay=raster, bx=raster, by=raster, data=st.data())
def test_ends_of_compiled_spans_are_exact_in_the_largest_pictures(
    ax: int, ay: int, bx: int, by: int, data: st.DataObject
) -> None:
    ay, by = min(ay, by), max(ay, by)
    first, last = -((128 - ay) // 256), (by - 129) // 256
    if first > last:
        return
    height = data.draw(st.integers(first, last)) * 256 + 128
    offset = data.draw(st.sampled_from([32, 96, 128, 160, 224]))
    down = by - ay
    wanted = -(-((ax - offset) * down + (height - ay) * (bx - ax)) // (256 * down))
    slope = float(bx - ax) / (256.0 * down)
    assert first_sample()(float(ax), slope, float(height - ay), float(offset)) == wanted


def test_ends_of_compiled_spans_on_a_sample_belong_to_the_pixel() -> None:
    for column in (0, 1, 16383, 32767):
        x = column * 256 + 128
        assert first_sample()(float(x), 0.0, 128.0, 128.0) == column
        assert first_sample()(float(x + 1), 0.0, 128.0, 128.0) == column + 1


def test_colours_that_flow_into_one_another_have_no_border():
    quads = np.array([[0, 1, 4, 3], [1, 2, 5, 4]])
    topology = build_topology(6, [("strip", quads, Material(subdivide=True))])

    def beyond(tints, flat=False):
        return (plan_shading(replace(topology, tints=tints), flat, True).neighbours >= 0).sum()

    assert beyond(None) == beyond(np.array([0, 1])) == beyond(np.array([-1, -1])) == 4  # the halves of either quad
    assert beyond(np.array([0, 0])) == 6
    assert beyond(np.array([0, 0]), flat=True) == 4
