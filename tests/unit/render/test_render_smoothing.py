"""Where a picture gets four samples a pixel, and what light on every pixel adds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mien.core import Light, Material, Mesh, Scene, build_topology
from mien.render import draw_mesh, reference
from mien.render.camera import Camera
from mien.render.pixels import background, to_samples
from mien.render.triangles import make_triangles

CLEAR = ((0.0, 0.0, 0.0, 0.0),) * 2
GLOW = Material(lit=False)
SQUARE = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])


def unit_scene(size: int = 64) -> Scene:
    """A camera at distance 1 that sees exactly -1..1 in both directions of the plane z = 0."""
    return Scene(
        position=(0.0, 0.0, 1.0), at=(0.0, 0.0, 0.0), fov_deg=90.0, size_px=(size, size), background=CLEAR, subdivide=0
    )


def squares(*corners: np.ndarray, material: Material = GLOW) -> Mesh:
    """Squares in one part, each of another grey."""
    count = len(corners)
    topology = build_topology(4 * count, [("squares", np.arange(4 * count).reshape(count, 4), material)])
    greys = np.repeat(np.linspace(0.1, 0.9, count), 4)
    return Mesh(topology, np.concatenate(corners), np.stack([greys] * 3, axis=1))


def marks(mesh: Mesh, scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    camera = Camera.of(scene)
    triangles = make_triangles(mesh, scene, camera)
    depth, _ = reference.draw(triangles, camera, to_samples(background(scene)), reference.CENTRE)
    return (
        reference.mark_edges(triangles, camera, depth),
        reference.mark_kinks(depth, np.float32(camera.scale)),
    )


def test_inner_edges_of_a_surface_are_no_borders() -> None:
    edges, kinks = marks(squares(SQUARE * 0.5), unit_scene())
    rows, columns = np.nonzero(edges)
    assert set(rows) | set(columns) <= set(range(15, 50))
    assert not edges[17:47, 17:47].any(), "the diagonal that cuts the square into triangles is nobody's border"
    assert edges[15:17, 16:48].any(axis=0).all()
    assert not kinks.any()


def test_borders_that_are_hidden_are_left_alone() -> None:
    far = SQUARE * 0.5 - [0, 0, 1.0]
    alone = marks(squares(far), unit_scene())[0]
    behind = marks(squares(far, SQUARE * 0.9), unit_scene())[0]
    assert alone[24:40, 24:40].any()
    assert not behind[8:56, 8:56].any()


def test_surfaces_that_pierce_one_another_meet_in_a_smooth_line() -> None:
    # Two squares that cross along a line which is no edge of either, 30 degrees off the rows.
    turn = np.array([[np.cos(0.52), -np.sin(0.52), 0], [np.sin(0.52), np.cos(0.52), 0], [0, 0, 1.0]])
    tilted = [(SQUARE * 0.5) @ np.array([[1, 0, 0], [0, 0.7, s * 0.7], [0, 0, 1.0]]) @ turn.T for s in (1, -1)]
    mesh = squares(*tilted)
    edges, kinks = marks(mesh, unit_scene())
    middle = slice(28, 36)
    assert not edges[middle, middle].any()
    assert kinks[middle, middle].any(axis=0).all(), "in every column the line is found"
    assert kinks[middle, middle].mean() < 0.4
    one, four = (draw_mesh(mesh, unit_scene(), samples=n)[middle, middle, 0] for n in (1, 4))
    assert len(np.unique(one)) == 2
    assert len(np.unique(four)) == 5, "all mixtures of four samples appear along such a line"


def test_step_of_depth_within_one_part_is_smooth() -> None:
    near, far = SQUARE * [0.3, 0.31, 1] + [0.013, 0.007, 0.4], SQUARE * 2 - [0, 0, 0.5]
    four = draw_mesh(squares(near, far), unit_scene(), samples=4)[..., 0]
    assert len(np.unique(four)) > 2


def test_light_on_every_pixel_shows_a_highlight_that_no_corner_has() -> None:
    # A square with the normals of a ball: the highlight lies in its middle, away from all corners.
    material = Material(gloss=0.9, gloss_power=60, round=True)
    topology = build_topology(4, [("ball", np.array([[0, 1, 2, 3]]), material)])
    points = SQUARE * 0.5
    outwards = points + np.array([0, 0, 0.5])
    normals = outwards / np.sqrt((outwards**2).sum(axis=1))[:, None]
    mesh = Mesh(topology, points, np.full((4, 3), 0.2), normals)
    lit = replace(unit_scene(), lights=(Light((0.0, 0.0, 3.0), (1.0, 1.0, 1.0)),))
    smooth, pixels = (draw_mesh(mesh, replace(lit, shading=name))[..., 0] for name in ("smooth", "smooth+"))  # type: ignore[arg-type]
    assert pixels[32, 32] > 240
    assert int(smooth[32, 32]) < 150
    assert abs(int(pixels[17, 17]) - int(smooth[17, 17])) < 12, "at the corners both say the same"


def test_light_on_every_pixel_equals_the_smooth_one_where_a_square_is_flat() -> None:
    mesh = squares(SQUARE * 0.7, material=Material(gloss=0.0))
    lit = replace(unit_scene(), lights=(Light((40.0, 30.0, 60.0), (0.8, 0.7, 0.6)),))
    pictures = [draw_mesh(mesh, replace(lit, shading=name)).astype(int) for name in ("smooth", "smooth+")]  # type: ignore[arg-type]
    assert np.abs(pictures[0] - pictures[1]).max() <= 1


@pytest.mark.parametrize("shading", ["smooth", "smooth+"])
def test_pictures_of_one_pixel_and_of_one_row(shading: str) -> None:
    mesh = squares(SQUARE * 300)
    for size in ((1, 1), (70, 1), (1, 70), (2, 2)):
        scene = replace(unit_scene(), size_px=size, shading=shading)  # type: ignore[arg-type]
        assert (draw_mesh(mesh, scene)[..., 3] == 255).all()
