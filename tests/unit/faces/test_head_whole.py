"""The head as a whole: neck, parts, people, files, presets."""

import json
import math

import numpy as np
import pytest

from mien.core import LoadError, MienError, Pose, RangeError, UnknownNameError
from mien.faces import face_names, load_face
from mien.faces.head import neck
from mien.faces.head.creases import creased_skin
from mien.faces.head.measured import archive
from support import in_python

HEAD = load_face("head")
REST = Pose.neutral(HEAD.parameters)
PARTS = {"skin", "teeth", "gums", "tongue", "collar", "hair"} | {
    f"{part}.{side}" for part in ("eye", "spot", "caruncle", "lash", "brow") for side in ("left", "right")
}


def test_every_part_is_there():
    assert {part.name for part in HEAD.topology.parts} == PARTS
    assert len(archive().ints("teeth_lower")) == 32 * 33


def test_polygons_match_the_measured_topology():
    skin = HEAD.topology.part("skin")
    assert skin.last - skin.first == 1009


def test_head_turn_brings_the_nose_to_the_own_left_and_leaves_the_collar():
    turned = HEAD.shape(REST.replace({"head.turn": 30})).points
    still = HEAD.shape(REST).points
    nose = archive().vertex["n50"]
    assert turned[nose, 0] > 0.04
    collar = HEAD._layout.span["collar"]
    np.testing.assert_array_equal(turned[collar], still[collar])


@pytest.mark.parametrize(("name", "axis", "sign"), [("head.nod", 1, 1), ("head.tilt", 0, 1)])
def test_nod_looks_up_and_tilt_leans_to_the_own_left(name, axis, sign):
    moved = HEAD.shape(REST.replace({name: 15})).points - HEAD.shape(REST).points
    place = archive().vertex["n50" if name == "head.nod" else "s5_0"]
    assert sign * moved[place, axis] > 0.01


def turn(points, share, angles, forward=0.0):
    in_python(neck.turn_head)(points, share, in_python(neck.turn_axes)(angles), angles, neck.PIVOT, forward)
    return points


def test_turning_back_undoes_turning():
    points = np.array([[0.1, 0.2, 0.3], [-1.0, 0.0, 2.0]])
    angles = (0.5, -0.2, 0.3)
    turned = turn(points.copy(), np.ones(2), angles, 0.02)
    back = [in_python(neck.turn_back)(point, angles, neck.PIVOT, 0.02) for point in turned]
    np.testing.assert_allclose(back, points, atol=1e-12)


def test_a_quarter_turn_of_the_head_is_a_quarter_turn():
    directions = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    in_python(neck.turn_directions)(directions, in_python(neck.turn_axes)((math.pi / 2, 0.0, 0.0)))
    np.testing.assert_allclose(directions, [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]], atol=1e-12)


def test_the_neck_fades_into_the_rigid_head():
    points = np.array([[0.05, -0.1, 0.08]] * 3)
    angles = (0.4, 0.2, -0.1)
    rigid, nearly, still = turn(points.copy(), np.array([1.0, 1.0 - 1e-9, 0.0]), angles)
    np.testing.assert_allclose(rigid, nearly, atol=1e-8)
    np.testing.assert_array_equal(still, points[0])


def test_eyes_keep_to_their_target_while_the_head_turns():
    target = np.array([0.2, 0.1, 1.0])
    values = dict(zip(("target.x", "target.y", "target.z"), target, strict=True))
    face = load_face("head:parke1974")
    mesh = face.shape(Pose.neutral(face.parameters).replace({**values, "head.turn": 20.0, "head.nod": 5.0}))
    span = face._layout.span["eye.left"]
    ball = mesh.points[span]
    pupil, centre = ball[:24].mean(axis=0), ball.mean(axis=0)
    forward = mesh.normals[span][:24].mean(axis=0)
    way = target - pupil
    cosine = forward @ way / np.linalg.norm(forward) / np.linalg.norm(way)
    assert cosine > 0.9999, (forward, way, centre)


def test_colors_come_from_the_rows():
    red = HEAD.shape(REST.replace({"garment.color.red": 1.0, "garment.color.green": 0.0, "garment.color.blue": 0.0}))
    collar = red.colors[HEAD._layout.span["collar"]]
    assert (collar[:, 0] > 0.7).all()
    assert (collar[:, 1:] == 0.0).all()


@pytest.mark.parametrize("name", [name for name, _ in face_names() if name.startswith("head")])
def test_every_shipped_person_loads(name):
    face = load_face(name)
    assert face.name == name
    assert np.isfinite(face.shape(Pose.neutral(face.parameters)).points).all()


def test_unknown_faces_name_near_matches():
    with pytest.raises(UnknownNameError, match="head:ada"):
        load_face("head:adda")
    with pytest.raises(UnknownNameError, match="head"):
        load_face("haed")
    with pytest.raises(MienError, match=r"face\.json"):
        load_face("some/thing.json")


def write(path, **record):
    path.write_text(json.dumps({"format": "mien-face", "version": 1, **record}))
    return path


def test_a_face_file_makes_a_person(tmp_path):
    path = write(tmp_path / "x.face.json", hair="bob", palette="olive", values={"iris.size": 0.5, "eyebrow.arch": 0.4})
    face = load_face(path)
    assert Pose.neutral(face.parameters)["iris.size.left"] == 0.5
    assert Pose.neutral(face.parameters)["eyebrow.arch.right"] == 0.4


@pytest.mark.parametrize(
    ("record", "words"),
    [
        ({"hair": "bobb"}, "bob"),
        ({"palette": "green"}, "palette"),
        ({"jaw": "iron"}, "jaw"),
        ({"values": {"iris.siz": 0.5}}, "iris.size"),
        ({"values": {"iris.size": 5}}, "0 to 1"),
        ({"values": {"iris.size": "big"}}, "number"),
        ({"values": [1]}, "values"),
        ({"hare": "bob"}, "hair"),
        ({"hair": 3}, "text"),
        ({"name": 5}, "text"),
        ({"version": 9}, "version"),
        ({"format": "other"}, "mien-face"),
        ({"residual": "none.npz"}, "none.npz"),
    ],
)
def test_a_bad_face_file_is_explained(tmp_path, record, words):
    path = write(tmp_path / "x.face.json", **record)
    with pytest.raises((LoadError, UnknownNameError, RangeError), match=words) as caught:
        load_face(path)
    assert "x.face.json" in str(caught.value) or "none.npz" in str(caught.value)


def test_broken_json_names_the_line(tmp_path):
    path = tmp_path / "x.face.json"
    path.write_text('{"format": "mien-face",\n oops}')
    with pytest.raises(LoadError, match=r"x\.face\.json:2"):
        load_face(path)


def test_a_residual_file_is_checked(tmp_path):
    np.savez(tmp_path / "r.npz", cage=np.zeros((3, 3)))
    path = write(tmp_path / "x.face.json", residual="r.npz")
    with pytest.raises(LoadError, match="shape"):
        load_face(path)


def test_a_missing_face_file_is_named(tmp_path):
    with pytest.raises(LoadError, match="no such file"):
        load_face(tmp_path / "nobody.face.json")


def test_creases_lie_where_parke_names_them_and_no_polygon_spans_one():
    creased, count = creased_skin(archive()), len(archive().mirror)
    quads, source = creased.quads, creased.source
    np.testing.assert_array_equal(source[quads], archive().quads)
    doubled = set(source[count:].tolist())
    for name in ("e1_9", "p3", "m1_0", "m1_9", "mb_5"):
        assert archive().vertex[name] in doubled
        assert int(archive().mirror[archive().vertex[name]]) in doubled


def test_classic_smooth_pictures_show_the_creases_and_subdivided_skin_has_none():
    classic, smooth = HEAD.unsubdivided, HEAD
    assert classic.topology.vertex_count - smooth.topology.vertex_count < 200
    skin = classic._layout.span["skin"]
    points = classic.shape(classic.neutral).points[skin]
    _, copies = np.unique(points, axis=0, return_counts=True)
    # Under each eye 5 vertices, beside each side of the nose 4, around the lips 18, at each corner 1 more.
    assert (copies > 1).sum() == 2 * (5 + 4 + 1) + 18
    points = smooth.shape(smooth.neutral).points[smooth._layout.span["skin"]]
    assert len(np.unique(points, axis=0)) == len(points)
