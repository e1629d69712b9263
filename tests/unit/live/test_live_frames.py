"""Frames as bytes: what a page decodes is the face to half a step, and every frame stands beside its setup alone."""

import json
import struct
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from mien.core import Drawing, Light, Material, Mesh, MienError, Path, Region, Scene, build_topology, subdivide
from mien.core.scene import fill_rows
from mien.live import Frame
from mien.live.drawing_frames import DrawingFrames
from mien.live.frames import FrameEncoder
from mien.live.mesh_frames import LIVELY, MeshFrames, describe_surface
from mien.live.quantising import Steps
from mien.render.pixels import to_srgb
from mien.render.plan import plan_shading
from mien.render.shade import node_colors, polygon_normals, shade_normals
from support import face

SCENE = Scene()
OPEN = {"jaw.rotation": 9.0, "mouth.expression": 0.2}


class Reader:
    """Takes one array after the other out of bytes."""

    def __init__(self, data, offset):
        self.data, self.offset = data, offset

    def take(self, dtype, *shape):
        array = np.frombuffer(self.data, dtype, int(np.prod(shape)), self.offset).reshape(shape)
        self.offset += array.nbytes
        return array


def read_header(data):
    return struct.unpack_from("<BBHId", data)


def read_setup(data):
    (length,) = struct.unpack_from("<I", data, 16)
    facts = json.loads(data[20 : 20 + length])
    assert (20 + length) % 8 == 0
    assert all(row["offset"] % 8 == 0 for row in facts["arrays"])
    arrays = {
        row["name"]: Reader(data, row["offset"]).take(np.dtype(row["dtype"]), *row["shape"]) for row in facts["arrays"]
    }
    return facts, arrays


def read_mesh(data, setup):
    facts, arrays = setup
    step, kind, *counts = struct.unpack_from("<f5I", data, 16)
    assert kind == 0
    reader = Reader(data, 40)
    points, normals, runs, colors = counts
    places = reader.take("<i2", points, 3) * step + np.array(facts["middle"])
    changed = np.concatenate(
        [np.zeros(0, dtype=int), *(first + np.arange(n) for first, n in reader.take("<u2", runs, 2))]
    )
    own = reader.take("i1", normals, 3) / 127.0
    codes = arrays["colors"].copy()
    codes[changed] = reader.take("u1", colors, 3)
    assert reader.offset == len(data)
    return step, places, own, codes


def read_drawing(data):
    step, kind, points, contours, outlines, paths, cuts, width, height = struct.unpack_from("<f6I2f", data, 16)
    assert kind == 1
    reader = Reader(data, 52)
    ends = [reader.take("<u4", count) for count in (contours, outlines, paths)]
    places = reader.take("<i2", points, 2) * step + np.array([width, height]) / 2
    own, cut = reader.take("<u2", paths), reader.take("<u2", cuts, 2)
    colors, rules = reader.take("u1", 2 + paths, 4), reader.take("u1", outlines)
    assert reader.offset == len(data)
    lines = np.split(places, ends[0][:-1])
    areas = [
        (lines[a:b], "nonzero" if rule else "evenodd")
        for a, b, rule in zip([0, *ends[1]], ends[1], rules, strict=False)
    ]
    cutting = [cut[a:b].tolist() for a, b in zip([0, *ends[2]], ends[2], strict=False)]
    return step, areas, own, cutting, colors


def encoder_of(name, scene=SCENE, **more):
    return FrameEncoder(face(name), scene, Fraction(60), **more)


def shape_of(name, changes=None, scene=SCENE):
    pose = face(name).neutral.replace(changes or {})
    return face(name).shape(fill_rows(face(name), pose, scene)), Frame(7, pose)


@pytest.mark.parametrize("changes", [{}, OPEN, {"head.turn": 40.0, "head.forward": 30.0, "eye.turn": -20.0}])
def test_a_head_comes_through_to_half_a_step(changes):
    encoder = encoder_of("head")
    mesh, frame = shape_of("head", changes)
    data = encoder.encode(frame)
    assert read_header(data) == (2, 1, encoder.number, 7, 7 / 60)
    step, points, normals, codes = read_mesh(data, read_setup(encoder.setup))
    assert np.abs(points - mesh.points).max() <= 0.5 * step
    assert step <= 2.0**-16
    round_vertices = describe_surface(mesh.topology, SCENE, False).round_vertices
    np.testing.assert_allclose(normals, mesh.normals[round_vertices], atol=0.5 / 127 + 1e-12)
    np.testing.assert_array_equal(codes, to_srgb(mesh.colors))
    assert len(data) < 46_000


def test_the_setup_makes_the_surface_that_is_drawn_elsewhere():
    encoder = encoder_of("head")
    mesh, _ = shape_of("head", OPEN)
    fine = subdivide(mesh, 2)
    plan = plan_shading(fine.topology, False)
    facts, arrays = read_setup(encoder.setup)
    refined = np.zeros((facts["refined_points"], 3))
    refined[: len(mesh.points)] = mesh.points
    entries = arrays["matrix_weights"].astype(float)[:, None] * mesh.points[arrays["matrix_columns"]]
    refined[arrays["matrix_rows"]] = np.add.reduceat(entries, arrays["matrix_starts"][:-1].astype(int), axis=0)
    np.testing.assert_allclose(refined, fine.points, atol=1e-7)
    normals = polygon_normals(fine.points, plan, fine.topology.polygon_count)
    sums = np.add.reduceat(normals[arrays["node_polygons"]], arrays["node_starts"][:-1].astype(int), axis=0)
    sums /= np.linalg.norm(sums, axis=1)[:, None]
    others = np.setdiff1d(np.arange(len(sums)), arrays["round_nodes"])
    wanted = np.stack(shade_normals(fine, normals, plan), axis=1)[: len(sums)]
    np.testing.assert_allclose(sums[others], wanted[others], atol=1e-9)
    np.testing.assert_array_equal(arrays["vertex_points"][arrays["triangles"]], fine.topology.triangles.ravel())
    last = facts["parts"][-1]
    assert last["first"] + last["count"] == len(fine.topology.triangles)
    assert {part["name"] for part in facts["parts"] if part["two_sided"]} == {"lash.left", "lash.right"}


def cube(**material):
    corners = np.array([[x, y, z] for x in (0.0, 0.1) for y in (0.0, 0.1) for z in (0.0, 0.1)])
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return build_topology(8, [("cube", np.array(sides), Material(**material))]), corners


@pytest.mark.parametrize("by_polygon", [False, True])
def test_flat_polygons_and_colours_of_polygons_are_named(by_polygon):
    topology, points = cube(subdivide=True)
    colors = np.random.default_rng(1).random((6 if by_polygon else 8, 3))
    mesh = Mesh(topology, points, colors)
    scene = Scene(shading="polygon", subdivide=1)
    surface = describe_surface(topology, scene, by_polygon)
    fine = subdivide(mesh, 1)
    plan = plan_shading(fine.topology, True, by_polygon)
    numbers = surface.arrays["vertex_colors"][surface.arrays["triangles"]].reshape(-1, 3)[:, 0]
    if by_polygon:
        np.testing.assert_array_equal(colors[numbers], fine.colors[fine.topology.polygon_of_triangle])
    else:
        means = node_colors(fine, plan)
        np.testing.assert_array_equal(-1 - numbers, fine.topology.polygon_of_triangle)
        corners = surface.arrays["polygon_corners"].reshape(-1, 4)[-1 - numbers]
        np.testing.assert_allclose(fine.colors[corners].mean(axis=1), means[plan.triangle_front[:, 0]])


def test_colours_that_flow_into_one_another_are_those_of_the_surface():
    topology, points = cube(subdivide=True)
    topology = replace(topology, tints=np.array([0, 0, 0, 0, -1, 1]))
    mesh = Mesh(topology, points, np.random.default_rng(2).random((6, 3)))
    frames = MeshFrames(mesh, Scene(subdivide=2))
    fine = subdivide(mesh, 2)
    arrays = frames.arrays()
    np.testing.assert_array_equal(arrays["colors"], to_srgb(fine.colors))
    numbers = arrays["vertex_colors"][arrays["triangles"]].reshape(-1, 3)
    np.testing.assert_array_equal(numbers, np.repeat(fine.topology.polygon_of_triangle[:, None], 3, axis=1))
    same, other = frames.encode(mesh), frames.encode(replace(mesh, colors=np.roll(mesh.colors, 1, axis=0)))
    assert len(same) < len(other)


def test_a_setup_without_subdivision_has_nothing_to_refine():
    facts, arrays = read_setup(encoder_of("head", subdivide=0).setup)
    assert facts["points"] == facts["refined_points"]
    assert len(arrays["matrix_rows"]) == 0


def test_camera_and_lamps_are_those_of_the_scene():
    lit = replace(SCENE.seen("side"), lights=(Light((0.0, 1.0, 2.0), (1.0, 0.5, 0.25), 0.5),), gloss=0.5)
    facts, _ = read_setup(encoder_of("head", lit).setup)
    assert facts["camera"]["position"] == list(lit.position)
    assert facts["lamps"] == [{"position": [0.0, 1.0, 2.0], "color": [1.0, 0.5, 0.25], "wrap": 0.5}]
    assert not facts["lamps_follow"]
    assert facts["parts"][0]["gloss"] == pytest.approx(0.5 * 0.055)
    usual, _ = read_setup(encoder_of("head").setup)
    assert usual["lamps_follow"]
    assert len(usual["lamps"]) == 4


def test_other_colours_get_a_setup_once_they_stay():
    encoder = encoder_of("head")
    first = encoder.setup
    dark = {"skin.color.red": 0.05, "skin.color.green": 0.03, "skin.color.blue": 0.02, "hair.color.red": 0.9}
    mesh, frame = shape_of("head", dark)
    moving = encoder.encode(frame)
    assert read_header(moving)[2] == 1
    np.testing.assert_array_equal(read_mesh(moving, read_setup(first))[3], to_srgb(mesh.colors))
    settled = encoder.encode(frame)
    assert encoder.number == read_header(settled)[2] == read_header(encoder.setup)[2] == 2
    np.testing.assert_array_equal(read_setup(encoder.setup)[1]["colors"], to_srgb(mesh.colors))
    assert len(settled) < len(moving)
    assert encoder.encode(frame) == settled


def test_the_surface_is_described_once_whatever_its_colours():
    mesh, _ = shape_of("head", {})
    surface = describe_surface(mesh.topology, SCENE, False)
    assert describe_surface(mesh.topology, replace(SCENE, fov_deg=30.0), False) is surface
    dull = describe_surface(mesh.topology, replace(SCENE, gloss=0.0), False)
    assert {part["gloss"] for part in dull.parts} == {0.0} != {part["gloss"] for part in surface.parts}


def test_what_a_mouth_shades_is_no_other_palette():
    encoder = encoder_of("head")
    _, frame = shape_of("head", OPEN)
    assert len({encoder.encode(frame) for _ in range(5)}) == 1
    assert encoder.number == 1


def test_another_topology_gets_a_setup():
    topology, points = cube()
    other, _ = cube(subdivide=True)
    frames = MeshFrames(Mesh(topology, points, np.full((8, 3), 0.5)), SCENE)
    assert frames.encode(Mesh(topology, points, np.full((8, 3), 0.5))) is not None
    assert frames.encode(Mesh(other, points, np.full((8, 3), 0.5))) is None
    assert LIVELY < 1.0


@pytest.mark.parametrize("name", ["toon:olav", "toon:gus", "toon:miso"])
def test_a_drawing_comes_through_to_half_a_step(name):
    encoder = encoder_of(name)
    drawing, frame = shape_of(name)
    step, areas, own, cutting, colors = read_drawing(encoder.encode(frame))
    assert read_setup(encoder.setup)[0]["shape"] == "drawing"
    assert step <= 2.0**-5
    behind = SCENE.behind(drawing.background)
    wanted = np.array([*behind, *(path.color for path in drawing.paths)])
    np.testing.assert_array_equal(colors[:, :3], to_srgb(wanted[:, :3]))
    np.testing.assert_array_equal(colors[:, 3], np.rint(wanted[:, 3] * 255))
    for path, number, cuts in zip(drawing.paths, own, cutting, strict=True):
        same(areas[number], path, step)
        for kind, regions in ((0, path.inside), (1, path.outside)):
            sent = [areas[area] for area, how in cuts if how == kind]
            for area, region in zip(sent, regions, strict=True):
                same(area, region, step)


def same(area, outline, step):
    contours, rule = area
    assert rule == outline.rule
    for got, wanted in zip(contours, outline.contours, strict=True):
        assert np.abs(got - wanted).max(initial=0.0) <= 0.5 * step


def test_shared_outlines_go_once_and_fillings_are_told():
    square = np.array([[10.0, 10.0], [30.0, 10.0], [30.0, 30.0], [10.0, 30.0]])
    hole = Region((square,))
    all_of_it = np.array([[0.0, 0.0], [40.0, 0.0], [40.0, 40.0], [0.0, 40.0]])
    filling, wall = (
        Path("eye", (square,), (1.0, 0.0, 0.0, 0.5)),
        Path("wall", (all_of_it,), (0, 1, 0, 1), outside=(hole,)),
    )
    drawing = Drawing((40.0, 40.0), (filling, wall))
    _, areas, own, cutting, colors = read_drawing(bytes(16) + DrawingFrames(SCENE).encode(drawing))
    assert len(areas) == 2
    assert own.tolist() == [0, 1]
    assert cutting == [[[1, 2]], [[0, 1]]]
    assert colors[2].tolist() == [255, 0, 0, 128]


def test_a_drawing_of_nothing_is_a_frame():
    _, areas, own, _, colors = read_drawing(bytes(16) + DrawingFrames(SCENE).encode(Drawing((4.0, 3.0), ())))
    assert (areas, own.tolist(), len(colors)) == ([], [], 2)


def test_steps_grow_and_never_shrink():
    steps = Steps(np.zeros(3))
    small, large = np.full((1, 3), 0.2), np.full((1, 3), 0.3)
    steps.encode(small)
    assert steps.step == 2.0**-17
    assert (steps.encode(large) == round(0.3 * 2**16)).all()
    steps.encode(small)
    assert steps.step == 2.0**-16


@pytest.mark.parametrize("what", ["points", "colors", "normals"])
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_what_is_no_number_is_never_sent(what, bad):
    mesh, _ = shape_of("head")
    frames = MeshFrames(mesh, SCENE)
    broken = getattr(mesh, what).copy()
    broken[describe_surface(mesh.topology, SCENE, False).round_vertices[0], 0] = bad
    with pytest.raises(MienError, match="not a finite number"):
        frames.encode(replace(mesh, **{what: broken}))


def test_wires_are_not_shown_live():
    with pytest.raises(MienError, match="wire"):
        encoder_of("head", replace(SCENE, shading="wire"))
