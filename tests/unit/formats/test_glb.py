"""Faces as .glb: read back and posed by another reader, they are what they were."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from small_face import SmallFace, opening_jaw
from small_puppet import SmallPuppet, teach

import mien
from mien.core import Drawing, Face, Mesh, MienError, Pose, Scene, Sound, fill_rows, subdivide
from mien.formats import write_performance
from mien.formats.glb import Puppet
from mien.formats.glb_targets import Anatomy
from mien.formats.obj import corner_normals
from mien.formats.performances import PUPPET_SCENE
from mien.formats.wav import read_wav
from mien.timeline import Layer, Timeline, Track
from mien.vocab import pose_from, vocabulary
from mien.vocab.rules import companions

pytest.importorskip("pygltflib", reason="pygltflib is not installed (extras: test)")
from puppet_reader import PuppetFile, Shown

BASES: dict[str, tuple[int, dict[str, float]]] = {
    "neutral": (1, {}),
    "posed": (0, {"head.turn": 25.0, "jaw.rotation": 9.0, "mouth.frown.left": 0.5, "eye.turn.left": 10.0}),
}
ONLY_NEUTRAL = pytest.mark.parametrize("read", ["neutral"], indirect=True, scope="module")
"""The neck of a turned head lies between two joints, whose normals are blended."""


@pytest.fixture(scope="module", params=BASES)
def read(request: pytest.FixtureRequest) -> tuple[PuppetFile, Pose, int]:
    """A head read back; its pose, and how often it is subdivided."""
    face = mien.load_face("head")
    levels, values = BASES[request.param]
    pose = fill_rows(face, face.neutral.replace(values), PUPPET_SCENE)
    return PuppetFile.parse(mien.make_puppet(face, pose, Scene(subdivide=levels)).to_glb()), pose, levels


def head_mesh(pose: Pose, levels: int) -> Mesh:
    face = mien.load_face("head")
    mesh = (face if levels else face.unsubdivided).shape(pose)
    assert isinstance(mesh, Mesh)
    return subdivide(mesh, levels)


def differ_m(shown: list[Shown], mesh: Mesh) -> float:
    """Greatest distance of a corner of a triangle from where the mesh has it, along one axis."""
    topology = mesh.topology
    owner = topology.part_of_polygon[topology.polygon_of_triangle]
    worst = 0.0
    for number, part in enumerate(topology.parts):
        want = mesh.points[topology.triangles[owner == number]]
        got = np.concatenate([each.points[each.triangles] for each in shown if each.part == part.name])
        # Where joints cut a part, its triangles come in another order: each joint's in the order that they had.
        for corners in (want, got) if len(want) and not np.allclose(want, got, atol=1e-5) else ():
            corners[:] = corners[np.lexsort(corners.mean(axis=1).round(6).T)]
        worst = max(worst, float(np.abs(got - want).max()))
    return worst


def test_the_base_comes_back(read: tuple[PuppetFile, Pose, int]) -> None:
    file, pose, levels = read
    assert differ_m(file.show(), head_mesh(pose, levels)) < 1e-6


def test_every_single_target_comes_back(read: tuple[PuppetFile, Pose, int]) -> None:
    file, pose, levels = read
    face = mien.load_face("head")
    names = file.target_names
    for name in names:
        beside = companions("arkit", name)
        weights = np.array([float(each == name or each in beside) for each in names])
        mesh = head_mesh(pose_from("arkit", {**beside, name: 1.0}, face, pose), levels)
        stands = file.stands(next(iter(beside), name))
        assert differ_m(file.show(stands, weights), mesh) < 1e-5, name  # a hundredth of a millimetre


def test_names_are_those_of_arkit(read: tuple[PuppetFile, Pose, int]) -> None:
    file, _, _ = read
    assert file.target_names == list(vocabulary("arkit").names)
    assert len(file.target_names) == 52
    assert {"eyeBlinkLeft", "jawOpen", "mouthSmileRight", "tongueOut"} <= set(file.target_names)
    face = file.gltf.meshes[-1]
    assert all(len(primitive.targets) == 52 for primitive in face.primitives)


def test_eyes_jaw_and_head_are_nodes(read: tuple[PuppetFile, Pose, int]) -> None:
    file, _, _ = read
    nodes = file.gltf.nodes
    names = [node.name for node in nodes]
    assert names == ["body", "head", "jaw", "eyeLeft", "eyeRight", "face"]
    assert [names[child] for child in nodes[1].children] == ["jaw", "eyeLeft", "eyeRight"]
    hung = {node.name: {p.extras["part"] for p in file.gltf.meshes[node.mesh].primitives} for node in nodes}
    assert hung["jaw"] == {"teeth", "gums"}
    assert hung["eyeLeft"] == {"eye.left"}
    assert {"skin", "tongue", "lash.left", "brow.right"} <= hung["face"]
    assert "jawOpen" in nodes[2].extras["targets"]
    assert set(nodes[3].extras["targets"]) == {f"eyeLook{way}Left" for way in ("Down", "In", "Out", "Up")}


@ONLY_NEUTRAL
def test_normals_are_unit_and_point_out(read: tuple[PuppetFile, Pose, int]) -> None:
    file, _, _ = read
    for shown in file.show():
        np.testing.assert_allclose(np.linalg.norm(shown.normals, axis=1), 1.0, atol=1e-3)
        a, b, c = shown.points[shown.triangles].transpose(1, 0, 2)
        out = np.einsum("na,na->n", np.cross(b - a, c - a), shown.normals[shown.triangles].sum(axis=1))
        assert (out > -1e-12).mean() > 0.97, shown.part


@ONLY_NEUTRAL
def test_normals_of_targets_are_those_of_the_moved_mesh(read: tuple[PuppetFile, Pose, int]) -> None:
    file, pose, levels = read
    weights = np.array([float(name == "cheekPuff") for name in file.target_names])
    skin = next(shown for shown in file.show(weights=weights) if shown.part == "skin")
    moved = head_mesh(pose_from("arkit", {"cheekPuff": 1.0}, mien.load_face("head"), pose), levels)
    normals, normal_of = corner_normals(moved)
    topology = moved.topology
    inside = topology.part_of_polygon[topology.polygon_of_triangle] == 0
    want = normals[normal_of[topology.triangle_corners[inside]]]
    np.testing.assert_allclose(skin.normals[skin.triangles], want, atol=0.011)


def test_colours_are_linear_light() -> None:
    face = mien.load_face("head")
    scene = Scene(subdivide=0)
    shown = PuppetFile.parse(mien.make_puppet(face, scene=scene).to_glb()).show()
    mesh = face.unsubdivided.shape(fill_rows(face, face.neutral, scene))
    hair = next(each for each in shown if each.part == "hair")
    want = mesh.colors[mesh.part_vertices("hair")]
    np.testing.assert_allclose(hair.colors.mean(axis=0), want.mean(axis=0), rtol=0.05)


def test_creases_come_with_their_targets(read: tuple[PuppetFile, Pose, int]) -> None:
    file, pose, levels = read
    weights = np.array([float(name == "mouthSmileLeft") for name in file.target_names])
    skin = next(shown for shown in file.show(weights=weights) if shown.part == "skin")
    smiling = head_mesh(pose_from("arkit", {"mouthSmileLeft": 1.0}, mien.load_face("head"), pose), levels)
    topology = smiling.topology
    want = smiling.colors[topology.triangles[topology.part_of_polygon[topology.polygon_of_triangle] == 0]]
    np.testing.assert_allclose(skin.colors[skin.triangles], want, atol=0.0041)
    before = next(shown for shown in file.show() if shown.part == "skin").colors
    assert np.abs(skin.colors - before).max() > 0.02


def test_the_same_puppet_has_the_same_bytes(tmp_path: Path) -> None:
    scene = Scene(subdivide=0)
    for name in ("a.glb", "b.glb"):
        mien.make_puppet("head", {"mouth.pucker": 0.5}, scene).write(tmp_path / name)
    assert (tmp_path / "a.glb").read_bytes() == (tmp_path / "b.glb").read_bytes()


def test_few_vertices_of_a_target_cost_little(read: tuple[PuppetFile, Pose, int]) -> None:
    file, _, _ = read
    moves = [file.gltf.accessors[t["POSITION"]] for p in file.gltf.meshes[-1].primitives for t in p.targets]
    assert sum(a.sparse.count for a in moves if a.sparse) < 0.5 * sum(a.count for a in moves)


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> SmallPuppet:
    teach(monkeypatch)
    return SmallPuppet()


def test_a_small_file_by_hand(small: SmallPuppet) -> None:
    file = PuppetFile.parse(Puppet(Anatomy(small, small.neutral, 0), {"Face": "small"}).to_glb())
    gltf = file.gltf
    assert gltf.asset.extras == {"Face": "small"}
    assert gltf.asset.generator.startswith("mien ")
    assert [node.name for node in gltf.nodes] == ["body", "head", "jawLower", "face"]
    assert [node.translation for node in gltf.nodes] == [[0, 0, 0], [0, 0, 0], [0, 0, 2], None]
    assert gltf.nodes[2].extras == {
        "targets": {"jawOpen": {"translation": [0, 0, 2], "rotation": [0.5, 0, 0, 0.866025404]}}
    }
    assert gltf.scenes[0].nodes == [0, 3]
    assert [material.name for material in gltf.materials] == ["collar", "teeth", "skin"]
    (skin,) = gltf.meshes[-1].primitives
    wide = file.accessor(skin.targets[file.target_names.index("browInnerUp")]["POSITION"])
    np.testing.assert_allclose(wide, [[0, 0, 0], [0, 0, 0], [0, 0, 0], [-0.2, 0, 0.3]], atol=1e-7)
    np.testing.assert_allclose(file.accessor(skin.attributes.WEIGHTS_0)[3], [0.75, 0.25, 0, 0])
    np.testing.assert_array_equal(file.accessor(skin.attributes.JOINTS_0)[3], [1, 0, 0, 0])
    np.testing.assert_array_equal(file.accessor(skin.attributes.COLOR_0)[0], [0.5, 0.25, 0.125])
    bounds = gltf.accessors[skin.attributes.POSITION]
    assert (bounds.min, bounds.max) == ([0, 0, 0], [1, 1, 0])


class Jointless(SmallFace):
    @property
    def neutral(self) -> Pose:
        return Pose.neutral(self.parameters)


class Undrawn(SmallPuppet):
    def shape(self, pose: Pose) -> Drawing:  # type: ignore[override]
        return Drawing((1.0, 1.0), ())


class Broken(SmallPuppet):
    def shape(self, pose: Pose) -> Mesh:
        mesh = super().shape(pose)
        mesh.colors[0] = np.nan
        return mesh


@pytest.mark.parametrize(
    ("face", "message"),
    [
        (Undrawn(), r"small: is a flat drawing and has no mesh — write it as \.svg"),
        (Jointless(), r"small: has no joints \(eyes, jaw\), which \.glb wants — write its mesh as \.obj"),
        (SmallPuppet(), "'arkit' cannot play faces of the family 'smallpuppet'"),
    ],
    ids=["drawing", "no joints", "no table"],
)
def test_faces_that_are_no_puppets(face: Face, message: str, tmp_path: Path) -> None:
    with pytest.raises(MienError, match=message):
        mien.make_puppet(face)
    performance = opening_jaw()
    with pytest.raises(MienError, match=message):
        write_performance(type(performance)(performance.timeline, face, performance.sound), tmp_path / "a.glb")  # type: ignore[arg-type]
    assert list(tmp_path.iterdir()) == []


def test_numbers_that_are_not_finite_are_refused(small: SmallPuppet, tmp_path: Path) -> None:
    with pytest.raises(MienError, match="not a finite number"):
        mien.make_puppet(Broken()).write(tmp_path / "a.glb")
    assert list(tmp_path.iterdir()) == []


@pytest.fixture
def performance(small: SmallPuppet) -> Any:
    """A jaw that opens by 60 degrees in a second while the smile comes to a half, with sound."""
    tracks = {
        "jaw.rotation": Track.from_keys([0.0, 1.0], [0.0, 60.0]),
        "smile": Track.from_keys([0.0, 1.0], [0.0, 0.5]),
    }
    timeline = Timeline((Layer("direct", "replace", tracks),), 1.0, title="Ah")
    return type(opening_jaw())(timeline, small, Sound(np.arange(24000, dtype=np.int16), 24000))


def test_a_performance_is_an_animation_with_a_named_sound(performance: Any, tmp_path: Path) -> None:
    write_performance(performance, tmp_path / "a.glb", fps=10)
    file = PuppetFile.parse((tmp_path / "a.glb").read_bytes())
    (animation,) = file.gltf.animations
    assert animation.extras == {"sound": "a.wav"}
    np.testing.assert_array_equal(read_wav(tmp_path / "a.wav").samples, performance.sound.samples)
    np.testing.assert_array_equal(file.accessor(animation.samplers[0].input)[:, 0], np.arange(10, dtype="<f4") / 10)
    times = file.gltf.accessors[animation.samplers[0].input]
    assert (times.min, times.max) == ([0], [pytest.approx(0.9)])
    paths = {(file.gltf.nodes[c.target.node].name, c.target.path) for c in animation.channels}
    assert paths == {("face", "weights"), ("jawLower", "rotation")}  # nothing else moves
    assert file.gltf.asset.extras["Title"] == "Ah"
    for frame in (0, 5, 9):
        pose = performance.face.neutral.replace({"jaw.rotation": 6.0 * frame, "smile": 0.05 * frame})
        assert differ_m(file.show(*file.frame(frame)), performance.face.shape(pose)) < 1e-4  # the fit's own price


def test_a_performance_without_sound_names_none(performance: Any, tmp_path: Path) -> None:
    silent = type(performance)(performance.timeline, performance.face)
    write_performance(silent, tmp_path / "a.glb")
    assert [path.name for path in tmp_path.iterdir()] == ["a.glb"]
    assert PuppetFile.parse((tmp_path / "a.glb").read_bytes()).gltf.animations[0].extras in ({}, None)


def test_a_performance_has_the_same_bytes_twice(performance: Any, tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        write_performance(performance, tmp_path / name / "x.glb")
    assert (tmp_path / "a/x.glb").read_bytes() == (tmp_path / "b/x.glb").read_bytes()


@pytest.mark.parametrize("when", ["fitting", "sound"])
def test_an_interruption_leaves_what_was_there(
    performance: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, when: str
) -> None:
    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    (tmp_path / "a.glb").write_text("old")
    where = {"fitting": "mien.formats.glb_motion.Fit.weights", "sound": "mien.formats.glb.write_wav"}[when]
    monkeypatch.setattr(where, interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_performance(performance, tmp_path / "a.glb")
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("a.glb", "old")]


def test_a_place_for_the_sound_is_looked_for_first(performance: Any, tmp_path: Path) -> None:
    os.mkdir(tmp_path / "a.wav")
    with pytest.raises(MienError, match=r"a\.wav: there is a folder of that name"):
        write_performance(performance, tmp_path / "a.glb")
    assert [path.name for path in tmp_path.iterdir()] == ["a.wav"]
