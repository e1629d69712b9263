"""Measured faces: Parke's numbers, several phases at once, halves, rigid turns, names."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mien.core import Mesh, MienError, Pose, RangeError, UnknownNameError, subdivide
from mien.core.interpolation import limit_of
from mien.faces import load_face, shapes
from mien.faces.keypose import KeyposeFace
from mien.faces.keypose.blending import split_number
from mien.faces.keypose.files import read_keypose
from mien.faces.keypose.records import Keypose, KeyposeTopology, Polygon, SkinPart
from mien.faces.keypose.skin import NEAR_CODES
from mien.vocab import load_remap, pose_from
from support import MASK, face

MEASURED = read_keypose(Path(MASK))
PHASES = {name: number for number, name in enumerate(MEASURED.phases, start=1)}


def points(subject, **values):
    """(44, 3) m, the measured half."""
    pose = subject.neutral.replace({name.replace("__", "."): value for name, value in values.items()})
    return subject.shape(pose).points[: MEASURED.topology.point_count]


def old(keypose=MEASURED):
    return KeyposeFace(keypose, "test").unsubdivided


def roof(**more):
    """Two quads that meet on the midline, in two phases: half of one is given."""
    topology = KeyposeTopology((SkinPart("skin", (Polygon((1, 2, 3, 4), "#808080"),)),), midline=(1, 4))
    rest = np.array([[0.0, 0.1, 0.1], [0.1, 0.1, 0.0], [0.1, -0.1, 0.0], [0.0, -0.1, 0.1]])
    places = np.stack([rest, rest + np.array([0.0, 0.0, 0.01]), rest * [1.0, 2.0, 1.0]])
    return Keypose("roof", topology, ("plain", "near", "tall"), places, **more)


@pytest.mark.parametrize(
    ("number", "previous", "share"),
    [
        (1.0, 0, 0.0),
        (1.5, 0, 0.5),
        (2.25, 1, (1.0 - math.sqrt(0.5)) / 2.0),
        (2.0 + 2.0 / 3.0, 1, 0.75),
        (3.0, 2, 0.0),
    ],
)
def test_the_fraction_of_a_number_goes_on_a_cosine(number, previous, share):
    assert split_number(number, 3) == (previous, pytest.approx(share, abs=1e-15))


def test_a_whole_number_is_a_phase_and_a_half_lies_half_way():
    for number, places in enumerate(MEASURED.places, start=1):
        np.testing.assert_allclose(points(old(), phase=number), places, atol=1e-16)
    halfway = (MEASURED.places[1] + MEASURED.places[2]) / 2.0
    np.testing.assert_allclose(points(old(), phase=2.5), halfway, atol=1e-16)
    assert old().parameters["phase"].name == "phase.number"


def test_the_surface_passes_through_the_measured_points_in_every_phase():
    subject = face(MASK)
    skin = subject.topology
    for name, number in PHASES.items():
        cage = subject.shape(subject.neutral.replace({"phase": number}))
        weighed = subject.shape(subject.neutral.replace(subject.presets[name].values))
        np.testing.assert_allclose(weighed.points, cage.points, atol=1e-15)
        met = limit_of(skin).apply(cage.points)[: MEASURED.topology.point_count]
        np.testing.assert_allclose(met, MEASURED.places[number - 1], atol=1e-7)


def test_phases_that_move_other_points_add_up():
    smile, blink = points(old(), phase__smile=0.7), points(old(), phase__blink=0.4)
    both = points(old(), phase__smile=0.7, phase__blink=0.4)
    rest = MEASURED.places[0]
    apart = np.abs(smile - rest).max(axis=1) * np.abs(blink - rest).max(axis=1) == 0.0
    np.testing.assert_allclose(both[apart], (smile + blink - rest)[apart], atol=1e-16)
    assert apart.sum() > 40


def test_phases_that_move_a_point_the_same_way_do_not_move_it_twice():
    chin = 9
    wide = points(old(), phase__open=1.0)[chin, 1]
    assert points(old(), phase__open=1.0, phase__ou=1.0, phase__aei=1.0)[chin, 1] == pytest.approx(wide, abs=1e-15)
    assert points(old(), phase=PHASES["open"], phase__open=1.0)[chin, 1] == pytest.approx(wide, abs=1e-15)
    # Of 27 mm, half of open is 13.5; 9 of ou take their part, a third, of the 13.5 that are left.
    mixed = points(old(), phase__open=0.5, phase__ou=1.0)[chin, 1] - MEASURED.places[0, chin, 1]
    assert mixed == pytest.approx(-0.018, abs=1e-12)


def test_no_mixture_leaves_the_box_of_the_measured_places():
    low, high = MEASURED.places.min(axis=0), MEASURED.places.max(axis=0)
    generator = np.random.default_rng(5)
    still = [row.name for row in old().parameters if not row.name.startswith("phase.")]
    for _ in range(30):
        table = old().parameters
        pose = Pose(table, generator.uniform(table.lows, table.highs))
        pose = pose.replace({name: table[name].default for name in still})
        mixed = old().shape(pose).points[:44]
        assert (mixed >= low - 1e-12).all()
        assert (mixed <= high + 1e-12).all()


def test_one_eye_winks_without_the_other():
    subject = old()
    rest, wink = subject.shape(subject.neutral).points, subject.shape(subject.neutral.replace({"phase.blink.left": 1}))
    moved = np.abs(wink.points - rest).max(axis=1) > 1e-9
    assert moved[16]
    assert not moved[subject.mirror_vertices[16]]
    with pytest.raises(UnknownNameError, match=r"phase\.blink"):
        subject.neutral["phase.blink"]
    both = subject.neutral.replace({"phase.blink": 1.0})
    assert (both["phase.blink.left"], both["phase.blink.right"]) == (1.0, 1.0)


def test_the_other_half_is_the_mirror_image_and_faces_outwards():
    subject = old()
    mesh = subject.shape(subject.neutral)
    mirror = subject.mirror_vertices
    np.testing.assert_array_equal(mesh.points[mirror], mesh.points * (-1.0, 1.0, 1.0))
    assert (mirror[mirror] == np.arange(len(mirror))).all()
    assert (mirror == np.arange(len(mirror))).sum() == len(MEASURED.topology.midline)
    part = mesh.topology.part("skin")
    for number in range(part.first, part.last):
        around = mesh.points[mesh.topology.polygon(number)]
        normal = np.cross(around[1:-1] - around[0], around[2:] - around[0]).sum(axis=0)
        assert normal @ (around.mean(axis=0) - subject.pivot) > 0.0, number


def test_a_crease_doubles_its_vertices_and_ends_fade():
    topology = replace(MEASURED.topology, creases=((20, 23), (12, 11, 3)))
    subject = old(replace(MEASURED, topology=topology))
    plain = old(replace(MEASURED, topology=replace(topology, creases=())))
    # 23 lies at the border, 11 and the middle 3 on the way of a crease; 20 and 12 are ends inside, where it fades.
    doubled = (11, 3, 23)
    extra = subject.topology.vertex_count - plain.topology.vertex_count
    assert extra == 5, "11 and 23 of both halves, and 3"
    mesh = subject.shape(subject.neutral)
    later = mesh.points[plain.topology.vertex_count :]
    assert {tuple(np.abs(point)) for point in later} <= {tuple(np.abs(MEASURED.places[0, n - 1])) for n in doubled}
    assert (subject.mirror_vertices[subject.mirror_vertices] == np.arange(len(mesh.points))).all()


def test_a_crease_that_branches_stays_closed_when_it_is_subdivided():
    topology = replace(MEASURED.topology, creases=((2, 12, 15), (13, 12, 11)))
    subject = KeyposeFace(replace(MEASURED, topology=topology), "test")
    mesh = subject.shape(subject.neutral.replace({"phase.brows_up": 1.0}))
    fine = subdivide(mesh, 2)
    cut, plain = borders(fine), KeyposeFace(replace(MEASURED, topology=replace(topology, creases=())), "test")
    # The borders of the cuts lie on one another in pairs; those of the mask itself are there once.
    own = borders(subdivide(plain.shape(plain.neutral), 2))
    assert len(cut) - len(set(cut)) == (len(cut) - len(own)) // 2 > 0


def borders(mesh):
    """Places of the ends of those edges of the skin that one polygon has."""
    last = mesh.topology.starts[mesh.topology.part("skin").last]
    ends = np.sort(np.stack([mesh.topology.corners, mesh.topology.corners[mesh.topology.next_corner]]), axis=0)
    edges, counts = np.unique(ends[:, :last], axis=1, return_counts=True)
    return [frozenset(map(tuple, np.round(mesh.points[edge], 8).tolist())) for edge in edges[:, counts == 1].T]


def test_the_head_turns_as_one_piece_and_eyes_about_their_middle():
    subject = old()
    turned = subject.shape(subject.neutral.replace({"head.turn": 30, "head.nod": -10, "head.tilt": 12})).points
    rest = subject.shape(subject.neutral).points
    np.testing.assert_allclose(
        np.linalg.norm(turned[:, None] - turned, axis=2), np.linalg.norm(rest[:, None] - rest, axis=2), atol=1e-12
    )
    np.testing.assert_allclose(
        np.linalg.norm(turned - subject.pivot, axis=1), np.linalg.norm(rest - subject.pivot, axis=1)
    )
    nose = 3
    assert points(subject, head__turn=20.0)[nose, 0] > 0.01, "to the own left"
    assert points(subject, head__nod=20.0)[nose, 1] > rest[nose, 1] + 0.01, "upwards"
    assert points(subject, head__tilt=20.0)[0, 0] > 0.01, "towards the own left shoulder"
    pupil = 34
    looking = points(subject, eye__turn__left=20.0)
    assert looking[pupil, 0] > rest[pupil, 0] + 0.002
    np.testing.assert_array_equal(looking[:29], rest[:29])
    center = np.array(MEASURED.eyes.center)
    assert np.linalg.norm(looking[pupil] - center) == pytest.approx(np.linalg.norm(rest[pupil] - center))


def test_shoulders_stay_where_a_neck_is_given():
    subject = old(replace(MEASURED, neck=(-0.07, 0.0)))
    rest, turned = points(subject), points(subject, head__turn=40.0, head__nod=20.0)
    chin, nose, jaw = 9, 3, 28
    np.testing.assert_array_equal(turned[chin], rest[chin])
    np.testing.assert_array_equal(turned[jaw], rest[jaw])
    assert np.linalg.norm(turned[nose] - rest[nose]) > 0.01
    brow = points(old(replace(MEASURED, pivot=subject.pivot)), head__turn=40.0, head__nod=20.0)[11]
    np.testing.assert_allclose(turned[11], brow, atol=1e-15)


def test_a_face_of_one_phase_is_a_face():
    subject = KeyposeFace(replace(MEASURED, phases=("neutral",), places=MEASURED.places[:1]), "test")
    assert not [name for name in subject.parameters.names if name.startswith("phase")]
    assert "phase" not in subject.parameters
    assert list(subject.presets) == ["neutral"]
    assert isinstance(subject.shape(subject.neutral), Mesh)
    turned = subject.shape(pose_from("facs", {"AU51": 1.0}, subject))
    assert np.abs(turned.points - subject.shape(subject.neutral).points).max() > 0.01
    assert shapes(subject, np.zeros((3, len(subject.parameters)))).shape == (3, subject.topology.vertex_count, 3)
    rig = subject.rig(subject.neutral)
    assert [joint.name for joint in rig.joints] == ["head", "eye.left", "eye.right"]


def test_a_face_need_not_be_symmetric():
    whole = replace(roof(), mirror=False, topology=replace(roof().topology, midline=()))
    subject = old(whole)
    assert subject.topology.vertex_count == 4
    assert (subject.mirror_vertices == -1).all()
    assert old(roof()).topology.vertex_count == 6


def test_own_names_of_phases_stand_for_standard_ones():
    subject = old(roof(stands_for={"near": "blink"}))
    assert "phase.blink.left" in subject.parameters.index
    assert subject.parameters["phase.near.left"].name == "phase.blink.left"
    one, other = (subject.neutral.replace({f"phase.{name}": 0.5}) for name in ("near", "blink"))
    assert one == other
    assert subject.presets["near"].values == subject.presets["blink"].values
    played = pose_from("facs", {"AU45": 1.0}, subject)
    assert played["phase.blink.right"] == 1.0


def test_other_phases_have_sides_where_the_settings_say_so():
    plain, sided = old(roof()), old(roof(sided=("near",)))
    assert "phase.near" in plain.parameters.index
    assert {"phase.near.left", "phase.near.right"} <= sided.parameters.index.keys()
    half = sided.shape(sided.neutral.replace({"phase.near.left": 1.0})).points
    np.testing.assert_allclose(half[:, 2], [0.105, 0.01, 0.01, 0.105, 0.0, 0.0], atol=1e-12)


def test_colours_belong_to_polygons_however_many_vertices_there_are():
    # As many vertices as polygons: an open roof of one quad and its image has six and two; a closed solid can have n.
    topology = KeyposeTopology((SkinPart("tetra", tuple(Polygon(row, "#ff0000") for row in TETRA)),))
    places = np.array([[[0.0, 0.0, 0.1], [0.1, 0.0, -0.1], [-0.1, 0.0, -0.1], [0.0, 0.1, 0.0]]])
    mesh = old(Keypose("t", topology, ("neutral",), places, mirror=False)).shape
    shape = mesh(old(Keypose("t", topology, ("neutral",), places, mirror=False)).neutral)
    assert shape.topology.vertex_count == shape.topology.polygon_count == 4
    assert shape.colored_by_polygon
    assert subdivide(shape, 1).colored_by_polygon


TETRA = ((1, 3, 2), (1, 2, 4), (2, 3, 4), (3, 1, 4))


def test_only_colours_that_are_nearly_the_same_flow_into_one_another():
    skin = MEASURED.topology.parts[0]
    polygons = list(skin.polygons)
    polygons[0] = replace(polygons[0], color=f"#{0xD9 - NEAR_CODES:02x}a389")
    parts = (replace(skin, polygons=tuple(polygons)), *MEASURED.topology.parts[1:])
    subject = old(replace(MEASURED, topology=replace(MEASURED.topology, parts=parts)))
    tints = subject.topology.tints
    count = len(polygons)
    lids = [number for number, polygon in enumerate(polygons) if polygon.color == "#b98468"]
    same = [number for number in range(count) if number not in lids]
    assert set(tints[same]) == set(tints[np.array(same) + count]) == {0}
    assert 0 not in tints[lids]
    assert set(tints[2 * count :]) == {-1}
    plain = (replace(skin, blend=False), *MEASURED.topology.parts[1:])
    assert old(replace(MEASURED, topology=replace(MEASURED.topology, parts=plain))).topology.tints is None


def test_emotions_are_those_that_the_phases_allow():
    subject = face(MASK)
    assert list(subject.presets)[:11] == list(MEASURED.phases)
    assert {"happy", "sad", "angry", "surprised", "wink"} <= set(subject.presets)
    assert "phase.frown" not in subject.presets["sad"].values
    assert list(old(roof()).presets) == ["plain", "neutral", "near", "tall"]


def test_what_is_given_for_a_number_beyond_the_phases_is_refused():
    with pytest.raises(RangeError, match="from 1 to 11"):
        face(MASK).neutral.replace({"phase": 11.5})


def gap_mm(subject, pose):
    """Between the middles of the lips' inner edges."""
    places = subject.shape(pose).points
    return 1000.0 * (places[6, 1] - places[7, 1])


def test_channels_of_speech_shut_and_open_the_mouth():
    subject = old()
    rest = gap_mm(subject, subject.neutral)
    opened = pose_from("channels", {"jaw": 0.8}, subject)
    assert gap_mm(subject, opened) > 8.0 + rest
    assert abs(gap_mm(subject, pose_from("channels", {"jaw": 0.8, "closure": 1.0}, subject, opened))) < 0.5
    assert pose_from("channels", {"jaw": 0.3, "tuck": 1.0}, subject)["phase.fv"] == 1.0
    rounded = subject.shape(pose_from("channels", {"round": 1.0}, subject)).points
    assert rounded[21, 0] < MEASURED.places[0, 21, 0] - 0.005
    blinked = pose_from("channels", {"blink.left": 1.0, "brow_raise": 1.0}, subject)
    assert blinked["phase.blink.left"] == 1.0
    assert blinked["phase.blink.right"] == 0.0
    assert blinked["phase.brows_up.left"] > 0.3


def test_names_without_a_phase_are_missing_and_others_stand_in():
    fits = load_remap("facs", "keypose").on(face(MASK).parameters).fits
    assert fits["AU12.left"] == "exact"
    assert "AU15.left" not in fits
    assert fits["AU61"] == "exact"
    blind = replace(MEASURED, eyes=None)
    assert "AU61" not in load_remap("facs", "keypose").on(old(blind).parameters).fits


def test_a_folder_is_an_address_with_and_without_a_slash():
    assert load_face(MASK).name == MASK
    assert load_face(MASK + "/").parameters.names == load_face(Path(MASK)).parameters.names
    with pytest.raises(MienError, match="no such folder"):
        load_face("nobody.keypose")
    with pytest.raises(UnknownNameError, match="keypose:nobody"):
        load_face("keypose:nobody")
