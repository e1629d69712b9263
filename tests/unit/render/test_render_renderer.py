"""From face to picture: cameras, wireframes, real heads, refusals."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import pytest

from mien.core import (
    Drawing,
    Material,
    Mesh,
    MienError,
    Parameter,
    ParameterTable,
    Path,
    Pose,
    Preset,
    RangeError,
    Scene,
    UnknownNameError,
    build_topology,
    subdivide,
)
from mien.faces import load_face
from mien.render import Renderer, draw, draw_mesh
from mien.render.camera import SUBPIXELS, Camera
from mien.render.clip import clip_polygons

CUBE = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]) * 0.05
SIDES = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
CLEAR = ((0.0, 0.0, 0.0, 0.0),) * 2


def cube(material: Material = Material(subdivide=True)) -> Mesh:  # noqa: B008 (frozen)
    return Mesh(build_topology(8, [("cube", SIDES, material)]), CUBE, np.full((8, 3), 0.5))


@dataclass(frozen=True)
class CubeFace:
    """A cube as wide as its one parameter says; flat, a square."""

    flat: bool = False
    level: str = "cage"
    name: str = "cube"
    family: str = "cube"
    presets: Mapping[str, Preset] = None  # type: ignore[assignment]

    @property
    def parameters(self) -> ParameterTable:
        row = Parameter("width", default=1.0, low=0.0, high=2.0, doc="Width.", source="here")
        viewer = [
            Parameter(f"viewer.{axis}", default=0.0, low=-9, high=9, unit="m", doc="x", source="here") for axis in "xyz"
        ]
        return ParameterTable([row, *viewer])

    @property
    def unsubdivided(self) -> CubeFace:
        return replace(self, level="surface")

    def shape(self, pose: Pose) -> Mesh | Drawing:
        if self.flat:
            square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]) * pose["width"]
            return Drawing((2.0, 2.0), (Path("square", (square,), (1.0, 1.0, 1.0, 1.0)),))
        mesh = cube()
        scale = pose["width"] * (0.5 if self.level == "surface" else 1.0)
        return mesh.moved(mesh.points * [scale, 1.0, 1.0])


def test_face_is_posed_subdivided_and_drawn() -> None:
    face, scene = CubeFace(), Scene(size_px=(40, 40), background=CLEAR)
    pose = Pose.neutral(face.parameters)
    smooth = draw(face, pose, scene)
    np.testing.assert_array_equal(smooth, draw_mesh(subdivide(cube(), 2), scene))
    wide = draw(face, pose.replace({"width": 2.0}), scene)
    assert (wide[..., 3] > 0).sum() > 1.5 * (smooth[..., 3] > 0).sum()
    plain = draw(face, pose, replace(scene, subdivide=0))
    np.testing.assert_array_equal(plain, draw_mesh(cube().moved(CUBE * [0.5, 1, 1]), replace(scene, subdivide=0)))


def test_flat_face_is_drawn_too() -> None:
    face = CubeFace(flat=True)
    picture = draw(face, Pose.neutral(face.parameters), Scene(size_px=(40, 40), background=CLEAR))
    assert (picture[..., 3] == 255).sum() == 400


def test_one_renderer_draws_frame_after_frame_as_if_each_were_the_first() -> None:
    face, scene = CubeFace(), Scene(size_px=(48, 32))
    poses = [Pose.neutral(face.parameters).replace({"width": width}) for width in (1.0, 0.3, 2.0)]
    with Renderer(scene, 2) as renderer:
        for pose in [*poses, poses[0]]:
            np.testing.assert_array_equal(renderer.draw(face, pose), draw(face, pose, scene))


def test_camera_puts_its_aim_in_the_middle_and_the_own_left_to_the_right() -> None:
    camera = Camera.of(Scene(position=(0.0, 0.0, 2.0), at=(0.0, 0.0, 0.0), fov_deg=90.0, size_px=(200, 100)))
    places, inverse = camera.project(camera.view(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])))
    assert (places // SUBPIXELS).tolist() == [[100, 50], [125, 50], [100, 25]]
    np.testing.assert_allclose(inverse, 0.5)


@pytest.mark.parametrize("position", [(0.0, 2.0, 0.0), (0.0, -2.0, 0.0)])
def test_camera_may_look_straight_up_or_down(position: tuple[float, float, float]) -> None:
    scene = Scene(position=position, at=(0.0, 0.0, 0.0), size_px=(32, 32), background=CLEAR)
    assert draw_mesh(cube(), scene)[16, 16, 3] == 255


def test_clipping_cuts_a_corner_off() -> None:
    camera = Camera.of(Scene(position=(0.0, 0.0, 1.0), at=(0.0, 0.0, 0.0), fov_deg=90.0, size_px=(10, 10)))
    triangle = np.array([[[0.0, 0, 1, 0], [2, 0, 1, 2], [0, 0.5, 1, 0]]])
    polygons, counts = clip_polygons(camera, triangle)
    assert counts.tolist() == [4]
    np.testing.assert_allclose(polygons[0, :4], [[0, 0, 1, 0], [1, 0, 1, 1], [1, 0.25, 1, 1], [0, 0.5, 1, 0]])


def test_wireframe_draws_edges_of_polygons_and_hides_those_behind() -> None:
    scene = Scene(
        position=(0.0, 0.0, 1.0), at=(0.0, 0.0, 0.0), fov_deg=8.0, size_px=(128, 128), background=CLEAR, subdivide=0
    )
    picture = draw_mesh(cube(), replace(scene, shading="wire"))
    inside = picture[24:104, 24:104, 0]
    assert inside.min() > 100, "no diagonal of a fan, no edge of the back"
    # The front face reaches to 0.05 of (1 - 0.05) tan 4 deg: 48.2 pixels to each side.
    line = picture[64, 8:24, 0]
    assert line.min() < 60
    assert picture[64, 64, 0] > draw_mesh(cube(), replace(scene, shading="polygon"))[64, 64, 0], "pale paper"


def test_wireframe_of_what_crosses_the_near_plane_stays_finite() -> None:
    scene = Scene(position=(0.0, 0.0, 0.04), at=(0.0, 0.0, 0.0), fov_deg=120.0, size_px=(32, 32), shading="wire")
    inside_out = Mesh(build_topology(8, [("cube", SIDES, Material(two_sided=True))]), CUBE, np.full((8, 3), 0.5))
    assert (draw_mesh(inside_out, scene)[..., 3] == 255).all()


@pytest.mark.parametrize(
    ("options", "error"),
    [({"samples": 3}, RangeError), ({"threads": 0}, RangeError), ({"rasteriser": "compild"}, UnknownNameError)],
)
def test_refusals(options: dict[str, object], error: type[MienError]) -> None:
    with pytest.raises(error):
        draw_mesh(cube(), Scene(size_px=(4, 4)), **options)  # type: ignore[arg-type]


def test_points_that_are_no_numbers_are_refused() -> None:
    points = CUBE.copy()
    points[3, 1] = np.nan
    with pytest.raises(MienError, match="not a finite number"):
        draw_mesh(cube().moved(points), Scene(size_px=(4, 4)))


def test_mesh_without_polygons_is_the_background() -> None:
    empty = Mesh(
        build_topology(3, [("none", np.zeros((0, 3), dtype=int), Material())]), np.zeros((3, 3)), np.ones((3, 3))
    )
    for rasteriser in ("compiled", "reference"):
        assert not draw_mesh(empty, Scene(size_px=(5, 4), background=CLEAR), rasteriser=rasteriser).any()  # type: ignore[arg-type]


@pytest.mark.parametrize("view", ["front", "three-quarter", "side", "inside"])
def test_real_head_is_the_same_in_both_rasterisers(view: str) -> None:
    registry = pytest.importorskip("mien.faces.registry")
    face = registry.load_face("head")
    scene = Scene(size_px=(72, 90), subdivide=1)
    # From within the throat: polygons all around, many through the near plane.
    scene = replace(scene, position=(0.0, -0.05, 0.02), fov_deg=100.0) if view == "inside" else scene.seen(view)
    mesh = subdivide(face.shape(Pose.neutral(face.parameters)), 1)
    plain = draw_mesh(mesh, scene, samples=1, rasteriser="reference")
    np.testing.assert_array_equal(draw_mesh(mesh, scene, samples=1, threads=2), plain)
    assert len(np.unique(plain.reshape(-1, 4), axis=0)) > 300


def test_compiled_refinement_is_the_plain_one_to_the_bit():
    face = load_face("head")
    mesh = face.shape(face.neutral)
    with Renderer(Scene(size_px=(8, 8)), threads=2) as renderer:
        fine, plain = renderer.refine(mesh), subdivide(mesh, 2)
    assert fine.points.tobytes() == plain.points.tobytes()
    assert fine.colors.tobytes() == plain.colors.tobytes()
