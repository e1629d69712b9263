"""A mesh in painter's order: what is seen, who comes before whom, and that the result looks like the rasterised one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import mien
from mien.core import Drawing, Material, Mesh, MienError, Scene, build_topology, fill_rows, subdivide
from mien.render import draw_drawing, draw_mesh
from mien.render.camera import NEAR_M
from mien.render.overlaps import Overlaps, find_overlaps
from mien.render.painting import paint_mesh, sort_pieces
from mien.render.pieces import Pieces, cut_pieces, cut_pierced

SCENE = Scene(position=(0.0, 0.0, 1.0), at=(0.0, 0.0, 0.0), fov_deg=20.0, size_px=(64, 64), shading="polygon")
RED, GREEN, BLUE = (0.9, 0.0, 0.0), (0.0, 0.9, 0.0), (0.0, 0.0, 0.9)
UNLIT = Material(lit=False)


def square(z: float, side: float = 0.1, x: float = 0.0, lean: float = 0.0) -> np.ndarray:
    """(4, 3) a square that faces +z, its left edge ``lean`` nearer and its right one farther."""
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * side
    return np.column_stack([corners[:, 0] + x, corners[:, 1], z - lean * corners[:, 0] / side])


def mesh_of(*squares: np.ndarray, colors=(RED, GREEN, BLUE), material: Material = UNLIT) -> Mesh:
    """Squares of one colour each, a part each."""
    parts = [(f"part{k}", np.arange(4 * k, 4 * k + 4)[None, :], material) for k in range(len(squares))]
    topology = build_topology(4 * len(squares), parts)
    return Mesh(topology, np.concatenate(squares), np.array(colors[: len(squares)]))


def names(drawing: Drawing) -> list[str]:
    return [path.name for path in drawing.paths]


def test_the_farther_of_two_is_painted_first_whatever_their_numbers() -> None:
    assert names(paint_mesh(mesh_of(square(0.1, 0.05), square(-0.1)), SCENE)) == ["part1", "part0"]
    assert names(paint_mesh(mesh_of(square(-0.1), square(0.1, 0.05)), SCENE)) == ["part0", "part1"]


def test_what_is_hidden_is_left_out() -> None:
    assert names(paint_mesh(mesh_of(square(0.1), square(-0.1, 0.05)), SCENE)) == ["part0"]


def test_a_large_leaning_polygon_is_behind_what_stands_before_its_far_end() -> None:
    # Its middle is nearer than the small square, so that depth of middles would paint it last.
    leaning, small = square(0.0, 0.1, lean=0.3), square(-0.18, 0.02, x=0.08)
    assert leaning[:, 2].mean() > small[:, 2].mean()
    assert names(paint_mesh(mesh_of(leaning, small), SCENE)) == ["part0", "part1"]


def test_polygons_that_pierce_one_another_are_cut() -> None:
    crossing = mesh_of(square(0.0, lean=0.05), square(0.0, lean=-0.05))
    drawing = paint_mesh(crossing, SCENE)
    assert len(drawing.paths) == 2  # one of them whole, of the other the half before it
    difference = np.abs(draw_drawing(drawing, SCENE).astype(int) - draw_mesh(crossing, SCENE)).max(axis=2)
    assert (difference > 40).mean() < 0.02


def test_a_ring_of_three_ends_with_the_fewest_samples_wrong() -> None:
    pieces = Pieces.join([np.ones((3, 3))] * 3, [0, 1, 2])
    ring = Overlaps((0, 1, 2), {(0, 1): 50, (1, 2): 60, (2, 0): 2})
    assert sort_pieces(pieces, ring) == [2, 1, 0]


def test_the_back_is_left_out_unless_both_sides_are_drawn() -> None:
    turned = square(0.0)[::-1].copy()
    assert paint_mesh(mesh_of(turned), SCENE).paths == ()
    both = paint_mesh(mesh_of(turned, material=Material(lit=False, two_sided=True)), SCENE)
    assert names(both) == ["part0"]


def test_a_square_lands_where_the_camera_puts_it() -> None:
    (path,) = paint_mesh(mesh_of(square(0.0)), SCENE).paths
    half = 0.1 / np.tan(np.radians(10.0)) * 32.0
    np.testing.assert_allclose(
        path.contours[0], 32.0 + half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]), atol=1e-3
    )
    assert path.color == (*RED, 1.0)


def test_what_reaches_behind_the_viewer_is_cut_off_before_him() -> None:
    floor = np.array([[-0.1, -0.1, 2.0], [0.1, -0.1, 2.0], [0.1, -0.1, -1.0], [-0.1, -0.1, -1.0]])
    drawing = paint_mesh(mesh_of(floor), SCENE)
    places = np.concatenate([path.contours[0] for path in drawing.paths])
    assert places.min() >= -1e-6
    assert places.max() <= 64.0 + 1e-6
    seen = draw_drawing(drawing, SCENE).astype(int) - draw_mesh(mesh_of(floor), SCENE)
    assert (np.abs(seen).max(axis=2) > 40).mean() < 0.02


def test_depths_of_samples_never_come_from_before_the_near_plane() -> None:
    floor = np.array([[-0.1, -0.1, 2.0], [0.1, -0.1, 2.0], [0.1, -0.1, -1.0], [-0.1, -0.1, -1.0]])
    pieces = cut_pieces(mesh_of(floor), SCENE)
    assert pieces.corners[:, 2].min() > 0.0
    assert pieces.corners[:, 2].max() <= 1.0 / NEAR_M + 1e-6


def test_overlaps_count_the_samples_that_are_hidden() -> None:
    before, behind = (
        np.array([[x, 0, w], [x + 8, 0, w], [x + 8, 8, w], [x, 8, w]]) for x, w in ((0.0, 2.0), (4.0, 1.0))
    )
    overlaps = find_overlaps(Pieces.join([before, behind], [0, 1]), (1536, 1536))
    assert overlaps.seen == (0, 1)
    assert overlaps.hidden == {(0, 1): 4 * 8}


def test_a_cut_leaves_the_same_area_on_both_sides_of_the_plane() -> None:
    flat = np.array([[0.0, 0, 1], [4, 0, 1], [4, 2, 1], [0, 2, 1]])
    upright = np.array([[1.0, 0, 0], [1, 2, 0], [1, 2, 2], [1, 0, 2]])
    pieces = cut_pierced(Pieces.join([flat, upright], [7, 8]), [(0, 1)])
    assert pieces.polygon.tolist() == [7, 7, 8]
    widths = sorted(np.ptp(pieces.outline(k)[:, 0]) for k in (0, 1))
    assert widths == [1.0, 3.0]


def test_a_point_that_is_no_number_is_refused() -> None:
    with pytest.raises(MienError, match="not a finite number"):
        paint_mesh(mesh_of(square(np.nan)), SCENE)


@pytest.mark.parametrize(
    ("view", "values"),
    [("front", {"jaw.rotation": 12.0}), ("three-quarter", {}), ("side", {"mouth.expression": 0.0})],
)
def test_the_painted_head_looks_like_the_rasterised_one(view: str, values: dict[str, float]) -> None:
    face = mien.load_face("head")
    scene = replace(
        Scene(size_px=(400, 400), shading="polygon", subdivide=0).seen(view), background=((0.2,) * 3 + (1.0,),) * 2
    )
    pose = fill_rows(face, face.neutral.replace(values), scene)
    mesh = subdivide(face.unsubdivided.shape(pose), 0)
    painted = draw_drawing(paint_mesh(mesh, scene), scene).astype(int)
    difference = np.abs(painted - draw_mesh(mesh, scene)).max(axis=2)
    # Edges are mixed otherwise and seams shine through, both thin; a polygon in the wrong place would be a patch.
    patches = difference > 40
    for axis in (0, 1):
        patches &= np.roll(patches, 1, axis) & np.roll(patches, -1, axis)
    assert patches.mean() < 0.0005
    assert np.median(difference) <= 1
