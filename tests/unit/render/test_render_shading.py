"""The light on vertices and polygons: answers known by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mien.core import Light, Material, Mesh, MienError, Scene, build_topology
from mien.render import draw_mesh
from mien.render.pixels import encode, to_samples
from mien.render.plan import plan_shading
from mien.render.shade import light_mesh, whole_power

DARK = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
SQUARE = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])


def square(material: Material = Material(), albedo: float = 1.0) -> Mesh:  # noqa: B008 (frozen)
    topology = build_topology(4, [("sample", np.array([[0, 1, 2, 3]]), material)])
    return Mesh(topology, SQUARE * 0.001, np.full((4, 3), albedo))


def scene(*lights: Light, ambient: tuple[tuple[float, ...], ...] = DARK, **more: object) -> Scene:
    return Scene(
        position=(0.0, 0.0, 1.0),
        at=(0.0, 0.0, 0.0),
        size_px=(9, 9),
        lights=lights,
        ambient=ambient,  # type: ignore[arg-type]
        subdivide=0,
        **more,  # type: ignore[arg-type]
    )


def light(mesh: Mesh, where: Scene) -> tuple[np.ndarray, np.ndarray]:
    shades = light_mesh(mesh, mesh.points, plan_shading(mesh.topology, where.shading != "smooth"), where)
    return shades.diffuse, shades.highlight


def lamp(degrees: float, **more: object) -> Light:
    """A white light so many degrees aside of the normal."""
    angle = np.radians(degrees)
    return Light((1e4 * float(np.sin(angle)), 0.0, 1e4 * float(np.cos(angle))), (1.0, 1.0, 1.0), **more)  # type: ignore[arg-type]


@pytest.mark.parametrize(("degrees", "power", "wanted"), [(0, 1, 1.0), (60, 1, 0.5), (60, 3, 0.125), (120, 1, 0.0)])
def test_diffuse_light_is_the_cosine_to_its_power(degrees: float, power: int, wanted: float) -> None:
    diffuse, _ = light(square(), scene(lamp(degrees), cosine_power=power))
    np.testing.assert_allclose(diffuse, wanted, atol=1e-6)


def test_wrapped_light_reaches_around_the_form() -> None:
    diffuse, _ = light(square(), scene(lamp(120, wrap=1.0)))
    np.testing.assert_allclose(diffuse, (-0.5 + 1.0) / 2.0, atol=1e-6)


def test_ambient_light_goes_from_below_to_above() -> None:
    below, above = (0.1, 0.2, 0.3), (0.5, 0.6, 0.7)
    dark = Light((0.0, 0.0, 1.0), (0.0, 0.0, 0.0))
    diffuse, _ = light(square(), scene(dark, ambient=(below, above)))
    np.testing.assert_allclose(diffuse[0], [0.3, 0.4, 0.5])
    lying = square()
    lying = lying.moved(lying.points[:, [0, 2, 1]] * [1, 1, -1])
    diffuse, _ = light(lying, scene(dark, ambient=(below, above)))
    np.testing.assert_allclose(diffuse[0], above)


def test_highlight_stands_where_the_half_vector_is_the_normal() -> None:
    shiny = square(Material(gloss=0.5, gloss_power=8))
    _, highlight = light(shiny, scene(lamp(0), gloss=0.4))
    np.testing.assert_allclose(highlight, 0.5 * 0.4, rtol=1e-4)
    _, highlight = light(shiny, scene(lamp(60)))
    np.testing.assert_allclose(highlight, 0.5 * np.cos(np.radians(30)) ** 8, rtol=1e-2)
    _, highlight = light(shiny, scene(lamp(95)))
    assert (highlight == 0).all(), "no highlight from a light behind the surface"


def test_back_of_a_two_sided_part_is_lit_from_its_own_side() -> None:
    mesh = square(Material(two_sided=True))
    diffuse, _ = light(mesh, scene(lamp(0)))
    assert (diffuse[:4] > 0.99).all()
    assert (diffuse[4:] == 0.0).all()
    turned = mesh.moved(mesh.points * [-1, 1, 1])
    picture = draw_mesh(turned, scene(lamp(0), fov_deg=0.1), samples=1)
    assert (picture[..., :3] == 255).all(), "the viewer and the light are on the same side of it"


def test_what_is_not_lit_shows_its_own_colour() -> None:
    picture = draw_mesh(square(Material(lit=False, gloss=1.0), albedo=0.2), scene(lamp(0), fov_deg=0.1))
    assert (picture[..., :3] == 124).all()


def test_parts_that_share_vertices_keep_their_own_light() -> None:
    polygons = [("lit", np.array([[0, 1, 2]]), Material()), ("dark", np.array([[0, 2, 3]]), Material(lit=False))]
    points = np.concatenate([SQUARE[:3], [[-1.0, 1.0, 5.0]]])
    mesh = Mesh(build_topology(4, polygons), points, np.ones((4, 3)))
    shades = light_mesh(mesh, points, plan_shading(mesh.topology, False), scene(lamp(60)))
    np.testing.assert_allclose(shades.diffuse[:3], 0.5, atol=1e-3)
    np.testing.assert_array_equal(shades.diffuse[3:], 1.0)


def test_smooth_normals_are_means_weighted_by_area() -> None:
    # A large square to the front and a small one to the right meet in an edge: normal (1, 0, 3) / sqrt 10 there.
    points = np.array([[-3.0, 0, 0], [0, 0, 0], [0, 1, 0], [-3, 1, 0], [0, 0, -1], [0, 1, -1]])
    topology = build_topology(6, [("sample", np.array([[0, 1, 2, 3], [1, 4, 5, 2]]), Material())])
    mesh = Mesh(topology, points, np.ones((6, 3)))
    shades = light_mesh(mesh, points, plan_shading(topology, False), scene(Light((0.0, 0.5, 1e6), (1.0, 1.0, 1.0))))
    np.testing.assert_allclose(shades.diffuse[:, 0], [1, 3 / 10**0.5, 3 / 10**0.5, 1, 0, 0], atol=1e-5)


def test_round_parts_take_the_normals_of_the_mesh() -> None:
    mesh = square(Material(round=True))
    with pytest.raises(MienError, match="brings no normals"):
        draw_mesh(mesh, scene(lamp(0)))
    with pytest.raises(MienError, match="brings no normals"):
        draw_mesh(mesh, scene(lamp(0)), rasteriser="reference")
    aside = np.tile([np.sqrt(0.75), 0.0, 0.5], (4, 1))
    diffuse, _ = light(replace(mesh, normals=aside), scene(lamp(0)))
    np.testing.assert_allclose(diffuse, 0.5, atol=1e-6)


def test_flat_polygons_have_one_shade_and_smooth_ones_a_gradient() -> None:
    points = np.array([[-1.0, -1, 0], [0, -1, 0.8], [0, 1, 0.8], [-1, 1, 0], [1, -1, 0], [1, 1, 0]]) * 0.1
    topology = build_topology(6, [("sample", np.array([[0, 1, 2, 3], [1, 4, 5, 2]]), Material())])
    mesh = Mesh(topology, points, np.full((6, 3), 0.5))
    clear = ((0.0, 0.0, 0.0, 0.0),) * 2
    where = replace(scene(lamp(40)), size_px=(64, 64), fov_deg=10.0, background=clear)
    smooth, flat = (draw_mesh(mesh, replace(where, shading=name), samples=1) for name in ("smooth", "polygon"))
    assert len(np.unique(flat[32, :, 0])) == 2
    assert len(np.unique(smooth[32, :, 0])) > 10


def test_polygons_with_colours_of_their_own_do_not_mix_them() -> None:
    points = np.array([[-1.0, -1, 0], [0, -1, 0], [0, 1, 0], [-1, 1, 0], [1, -1, 0], [1, 1, 0]])
    topology = build_topology(6, [("sample", np.array([[0, 1, 2, 3], [1, 4, 5, 2]]), Material(lit=False))])
    mesh = Mesh(topology, points, np.array([[1.0, 0, 0], [0, 1.0, 0]]))
    picture = draw_mesh(mesh, replace(scene(), fov_deg=90.0, size_px=(8, 8)), samples=1)
    assert picture[4].tolist() == [[255, 0, 0, 255]] * 4 + [[0, 255, 0, 255]] * 4


def test_srgb_codes_are_the_nearest_ones() -> None:
    codes = np.arange(256) / 255.0
    linear = np.where(codes <= 0.04045, codes / 12.92, ((codes + 0.055) / 1.055) ** 2.4)
    np.testing.assert_array_equal(encode_grey(linear), np.arange(256))
    inside = np.linspace(0.0, 1.0, 100_001)
    exact = np.where(inside <= 0.0031308, inside * 12.92, 1.055 * inside ** (1 / 2.4) - 0.055) * 255.0
    # Half a code, and a tenth of one for the steps of the samples.
    assert np.abs(encode_grey(inside) - exact).max() < 0.61


def encode_grey(linear: np.ndarray) -> np.ndarray:
    opaque = np.stack([linear, linear, linear, np.ones_like(linear)], axis=-1)
    codes = encode(to_samples(opaque))
    assert (codes[..., 3] == 255).all()
    return codes[..., 1]


def test_background_is_a_gradient_and_may_be_transparent() -> None:
    ends = ((0.0, 0.0, 0.0, 1.0), (1.0, 1.0, 1.0, 0.0))
    nothing = square().moved(SQUARE + np.array([0.0, 0.0, 9.0]))
    picture = draw_mesh(nothing, scene(background=ends))
    assert picture[0, 0, 3] < 20 < 235 < picture[-1, 0, 3]
    assert picture[0, 0, 0] > picture[-1, 0, 0]
    assert (picture == picture[:, :1]).all()


def test_half_covered_pixel_on_a_half_transparent_background_has_straight_alpha() -> None:
    half = ((0.0, 0.0, 1.0, 0.5),) * 2
    mesh = square(Material(lit=False)).moved(SQUARE - np.array([0.75, 0.0, 0.0]))
    mesh = Mesh(mesh.topology, mesh.points, np.tile([1.0, 0, 0], (4, 1)))
    where = replace(scene(background=half), fov_deg=90.0, size_px=(4, 4))
    red, _, blue, alpha = draw_mesh(mesh, where, samples=4)[1, 2].tolist()
    # Two samples red and two half-transparent blue: alpha 3/4, red 0.5 / 0.75, blue 0.25 / 0.75.
    assert (red, blue, alpha) == (213, 156, 191)


@pytest.mark.parametrize("power", range(1, 20))
def test_whole_powers(power: int) -> None:
    np.testing.assert_allclose(whole_power(np.array([0.0, 0.5, 1.0, 1.5]), power), np.array([0, 0.5, 1, 1.5]) ** power)
