"""Measured faces as .glb, .obj and .svg: colours of polygons, phases as targets, the head and the eyes as joints."""

from dataclasses import replace

import numpy as np
import pytest

import mien
from mien.core import Scene, subdivide
from mien.faces.keypose import KeyposeFace
from mien.formats.obj import Model
from mien.vocab import pose_from
from mien.vocab.rules import companions
from support import MASK, face

pytest.importorskip("pygltflib", reason="pygltflib is not installed (extras: test)")
from puppet_reader import PuppetFile

BASES = {"neutral": {}, "posed": {"head.turn": 25.0, "phase.smile": 0.5, "eye.turn": 10.0}}


def places(shown, part):
    """Corners of the triangles of a part, sorted: joints cut parts, and their triangles come in another order."""
    found = np.concatenate([each.points[each.triangles] for each in shown if each.part == part])
    return found[np.lexsort(found.mean(axis=1).round(6).T)]


def differ_m(shown, mesh):
    owner = mesh.topology.part_of_polygon[mesh.topology.polygon_of_triangle]
    worst = 0.0
    for number, part in enumerate(mesh.topology.parts):
        want = mesh.points[mesh.topology.triangles[owner == number]]
        want = want[np.lexsort(want.mean(axis=1).round(6).T)]
        worst = max(worst, float(np.abs(want - places(shown, part.name)).max()))
    return worst


@pytest.mark.parametrize("base", BASES)
def test_a_puppet_has_the_face_its_phases_and_its_colours(base):
    subject = face(MASK)
    pose = subject.neutral.replace(BASES[base])
    file = PuppetFile.parse(mien.make_puppet(subject, pose, Scene(subdivide=1)).to_glb())
    mesh = subdivide(subject.shape(pose), 1)
    assert differ_m(file.show(), mesh) < 1e-6
    assert [node.name for node in file.gltf.nodes][:3] == ["head", "eyeLeft", "eyeRight"]
    for name in ("jawOpen", "mouthSmileLeft", "eyeBlinkRight", "mouthPucker"):
        beside = companions("arkit", name)
        weights = np.array([float(each == name or each in beside) for each in file.target_names])
        moved = subdivide(subject.shape(pose_from("arkit", {**beside, name: 1.0}, subject, pose)), 1)
        assert np.abs(moved.points - mesh.points).max() > 0.002, name
        assert differ_m(file.show(None, weights), moved) < 1e-5, name
    seen = {tuple(np.round(color, 4)) for each in file.show() for color in each.colors[:, :3]}
    assert len(seen) > len({tuple(color) for color in subject.shape(pose).colors})  # what flows makes more


def test_shoulders_are_the_body_of_a_puppet():
    subject = KeyposeFace(replace(face(MASK).keypose, neck=(-0.07, 0.0)), "test")
    rig = subject.rig(subject.neutral)
    assert [joint.name for joint in rig.joints] == ["body", "head", "eye.left", "eye.right"]
    np.testing.assert_allclose(rig.shares.sum(axis=1), 1.0)
    chin, brow = 9, 11
    assert rig.shares[chin, 0] == 1.0
    assert rig.shares[brow, 1] == 1.0
    pose = subject.neutral.replace({"head.turn": 20.0})
    file = PuppetFile.parse(mien.make_puppet(subject, pose, Scene(subdivide=0)).to_glb())
    assert differ_m(file.show(), subject.unsubdivided.shape(pose)) < 1e-5


def test_an_obj_has_every_polygon_as_it_is_in_its_colour():
    mesh = face(MASK).unsubdivided.shape(face(MASK).neutral)
    lines = Model(mesh).to_obj().splitlines()
    polygons = [line.split()[1:] for line in lines if line.startswith("f ")]
    assert len(polygons) == mesh.topology.polygon_count
    assert sorted(map(len, polygons)) == sorted(np.diff(mesh.topology.starts).tolist())
    vertices = [line.split()[1:] for line in lines if line.startswith("v ")]
    lips = mesh.topology.part("lips")
    first = polygons[lips.first]
    assert {tuple(vertices[int(corner.split("//")[0]) - 1][3:]) for corner in first} == {("0.7098", "0.3765", "0.3529")}


def test_paths_have_the_colours_of_polygons():
    drawing = mien.draw_paths(face(MASK), {"phase": 2.0}).to_svg()
    assert drawing.count("<path") > 100
