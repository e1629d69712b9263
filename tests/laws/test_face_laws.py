"""What holds for every pose of every installed face."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from mien.core import Drawing, Face, Mesh, Pose, subdivide
from mien.faces import shapes
from support import FACE_NAMES, face, poses

every_face = pytest.mark.parametrize("name", FACE_NAMES)
few = settings(max_examples=5)

MIRROR = np.array([-1.0, 1.0, 1.0])


def numbers(shape):
    """Everything in a shape that a pose can change, as one list of arrays."""
    if isinstance(shape, Drawing):
        return [contour for path in shape.paths for contour in path.contours] + [
            np.array([path.color for path in shape.paths])
        ]
    return [shape.points, shape.colors, *([] if shape.normals is None else [shape.normals])]


def as_bytes(shape):
    return b"".join(array.tobytes() for array in numbers(shape))


@every_face
def test_it_is_a_face(name):
    subject = face(name)
    assert isinstance(subject, Face)
    assert subject.name == name
    assert len(subject.parameters) > 0
    assert subject.neutral == Pose.neutral(subject.parameters)
    assert subject.unsubdivided.parameters.names == subject.parameters.names


@every_face
@few
@given(data=st.data())
def test_no_pose_has_a_number_that_is_not_finite(name, data):
    subject = face(name)
    pose = data.draw(poses(subject.parameters))
    for kind in (subject, subject.unsubdivided):
        assert all(np.isfinite(array).all() for array in numbers(kind.shape(pose)))


@every_face
@few
@given(data=st.data())
def test_no_pose_leaves_the_room_or_the_colours(name, data):
    shape = face(name).shape(data.draw(poses(face(name).parameters)))
    if isinstance(shape, Mesh):
        assert np.abs(shape.points).max() < 1.0, "a head is smaller than a metre"
        assert shape.colors.min() >= 0.0
        assert shape.colors.max() <= 1.0


@every_face
@few
@given(data=st.data())
def test_no_pose_changes_who_is_connected_with_whom(name, data):
    subject = face(name)
    shape = subject.shape(data.draw(poses(subject.parameters)))
    neutral = subject.shape(Pose.neutral(subject.parameters))
    if isinstance(shape, Mesh):
        assert shape.topology is neutral.topology
        assert shape.topology.corners.max() < len(shape.points)
    else:
        assert sorted(path.name for path in shape.paths) == sorted(path.name for path in neutral.paths)


@every_face
@few
@given(data=st.data())
def test_shaping_twice_gives_the_same_bytes_and_leaves_the_pose_alone(name, data):
    subject = face(name)
    pose = data.draw(poses(subject.parameters))
    before = pose.values.tobytes()
    first = as_bytes(subject.shape(pose))
    subject.shape(data.draw(poses(subject.parameters)))
    assert as_bytes(subject.shape(pose)) == first
    assert pose.values.tobytes() == before


@every_face
@few
@given(data=st.data())
def test_writing_into_a_shape_does_not_reach_the_face(name, data):
    subject = face(name)
    pose = data.draw(poses(subject.parameters))
    first = subject.shape(pose)
    before = as_bytes(first)
    for array in numbers(first):
        if array.flags.writeable:
            array[:] = 0.25
    assert as_bytes(subject.shape(pose)) == before


@every_face
@few
@given(data=st.data())
def test_many_poses_at_once_are_what_one_is(name, data):
    table = face(name).parameters
    values = np.stack([table.defaults, data.draw(poses(table)).values, data.draw(poses(table)).values])
    for subject in (face(name), face(name).unsubdivided):
        for points, row in zip(shapes(subject, values, threads=2), values, strict=True):
            # Sums may be added in another order: some units in the last place of centimetres.
            one = subject.shape(Pose(table, row))
            np.testing.assert_allclose(points.ravel(), np.concatenate([a.ravel() for a in places(one)]), atol=1e-15)


def places(shape):
    """The points of a shape, as arrays."""
    return numbers(shape)[:-1] if isinstance(shape, Drawing) else [shape.points]


@every_face
@few
@given(data=st.data())
def test_a_mirrored_pose_gives_the_mirrored_mesh(name, data):
    pose = data.draw(poses(face(name).parameters))
    for subject in (face(name), face(name).unsubdivided):
        shape, mirrored = subject.shape(pose), subject.shape(pose.mirrored())
        if isinstance(shape, Mesh):
            for part, distance in mirror_errors(subject, shape, mirrored).items():
                assert distance < 1e-9, f"{part} is {distance * 1000:.6f} mm off"


def mirror_errors(subject, shape, mirrored):
    """Greatest distance (m) of each part from its mirror image; hair and what has no twin is left out."""
    twin = getattr(subject, "mirror_vertices", None)
    if twin is None:
        distance, _ = cKDTree(mirrored.points).query(shape.points * MIRROR)
    else:
        paired = twin >= 0
        np.testing.assert_array_equal(twin[twin[paired]], np.flatnonzero(paired))
        distance = np.where(paired, np.linalg.norm(mirrored.points[twin] - shape.points * MIRROR, axis=1), 0.0)
        assert paired[shape.part_vertices(shape.topology.parts[0].name)].all()
    return {part.name: distance[shape.part_vertices(part.name)].max() for part in shape.topology.parts}


@pytest.mark.parametrize("name", [name for name in FACE_NAMES if ":" not in name])
def test_every_parameter_does_something_or_is_for_the_scene(name):
    subject = face(name)
    neutral = Pose.neutral(subject.parameters).replace(awake(subject.parameters))
    rest = as_bytes(subject.shape(neutral))
    idle = [
        row.name
        for row in subject.parameters
        if all(as_bytes(subject.shape(neutral.replace({row.name: end}))) == rest for end in (row.low, row.high))
    ]
    assert idle == []


@every_face
def test_presets_fit_the_table(name):
    subject = face(name)
    neutral = Pose.neutral(subject.parameters)
    for preset in subject.presets.values():
        pose = neutral.replace(preset.values)
        assert all(np.isfinite(array).all() for array in numbers(subject.shape(pose)))


@pytest.mark.parametrize("name", [name for name in FACE_NAMES if ":" not in name])
def test_a_subdivided_shape_keeps_its_size_and_its_parts(name):
    subject = face(name)
    shape = subject.shape(Pose.neutral(subject.parameters))
    if not isinstance(shape, Mesh):
        return
    fine = subdivide(shape, 2)
    assert [part.name for part in fine.topology.parts] == [part.name for part in shape.topology.parts]
    assert np.isfinite(fine.points).all()
    slack = 1e-9
    assert (fine.points.min(axis=0) >= shape.points.min(axis=0) - slack).all()
    assert (fine.points.max(axis=0) <= shape.points.max(axis=0) + slack).all()


def awake(table):
    """A pose in which parameters that only act together with another have something to act on."""
    wanted = {"jaw.rotation": 6.0, "mouth.corner.width": 3.0}
    return {name: value for name, value in wanted.items() if name in table}
