"""Skull, jaw and eyes of a head as joints."""

from __future__ import annotations

import numpy as np
import pytest

import mien
from mien.core import Mesh, Rigged
from mien.core.rig import unmoved
from mien.faces.head.head import Head
from mien.faces.head.measured import archive
from mien.faces.head.neck import PIVOT
from mien.vocab import vocabulary

HEADS = {"subdivided": Head(), "classic": Head().unsubdivided}
RESTING = HEADS["classic"].rig(HEADS["classic"].neutral)
MOVED = {
    **{"head.turn": 30.0, "head.nod": -12.0, "head.tilt": 6.0, "jaw.rotation": 14.0, "jaw.side": 0.6},
    **{"jaw.forward": 0.5, "eye.turn.left": 20.0, "eye.nod.right": -15.0, "target.x": 0.2},
}


@pytest.mark.parametrize("head", HEADS.values(), ids=HEADS)
def test_rigid_parts_are_told_by_their_joints_alone(head: Head) -> None:
    rig = head.rig(head.neutral)
    rest, mesh = head.shape(head.neutral), head.shape(head.neutral.replace(MOVED))
    back = unmoved(mesh.points, rig.shares, rig.motion(rest.points, mesh.points))
    for part in ("eye.left", "eye.right", "teeth", "gums", "collar", "hair"):
        vertices = mesh.part_vertices(part)
        np.testing.assert_allclose(back[vertices], rest.points[vertices], atol=1e-12, err_msg=part)


def test_steps_are_the_angles_of_the_pose() -> None:
    head = HEADS["subdivided"]
    rig = head.rig(head.neutral)
    names = [joint.name for joint in rig.joints]
    rest = head.shape(head.neutral).points

    def turn(values: dict[str, float], joint: str) -> np.ndarray:
        turns, _ = rig.steps(rig.motion(rest, head.shape(head.neutral.replace(values)).points))
        return turns[names.index(joint)]

    def about(axis: int, angle_deg: float) -> np.ndarray:
        out = np.zeros(4)
        out[axis], out[3] = np.sin(np.radians(angle_deg / 2)), np.cos(np.radians(angle_deg / 2))
        return out

    np.testing.assert_allclose(turn({"jaw.rotation": 20.0}, "jaw"), about(0, 20.0), atol=1e-9)
    np.testing.assert_allclose(turn({"head.turn": 30.0}, "head"), about(1, 30.0), atol=1e-9)
    np.testing.assert_allclose(turn({"head.nod": 10.0}, "head"), about(0, -10.0), atol=1e-9)
    np.testing.assert_allclose(turn({"head.tilt": 10.0}, "head"), about(2, -10.0), atol=1e-9)


def test_pivots_are_those_that_the_head_was_measured_with() -> None:
    head = HEADS["subdivided"]
    pivots = {joint.name: joint.pivot for joint in head.rig(head.neutral).joints}
    (left, _, _), (right, _, _) = pivots["eye.left"], pivots["eye.right"]
    assert left == pytest.approx(-right, abs=1e-7)
    np.testing.assert_allclose(pivots["head"], PIVOT, atol=1e-7)
    np.testing.assert_allclose(pivots["jaw"], [0.0, *archive().floats("jaw_axis")], atol=1e-7)
    np.testing.assert_allclose(pivots["eye.right"], archive().floats("eye_centre")[1], atol=1e-7)


def test_eyes_turn_about_their_middle() -> None:
    head = HEADS["classic"]
    rig = head.rig(head.neutral.replace({"jaw.rotation": 9.0, "eye.turn.left": 12.0}))
    rest, mesh = head.shape(head.neutral), head.shape(head.neutral.replace({"eye.turn.left": 25.0}))
    _, still = rig.steps(rig.motion(rest.points, rest.points))
    _, places = rig.steps(rig.motion(rest.points, mesh.points))
    np.testing.assert_allclose(places, still, atol=1e-12)


SHAPED = {"face.size": 1.1, "eye.place.side": 20.0, "eye.size": 60.0, "chin.up": -30.0, "teeth.width": 1.2}


def test_joints_of_other_proportions_turn_where_they_are() -> None:
    head = HEADS["subdivided"]
    shaped = head.neutral.replace(SHAPED)
    rig = head.rig(shaped)
    rest = head.shape(shaped).points
    turned = head.shape(
        shaped.replace({"eye.turn": 20.0, "eye.nod": 9.0, "jaw.rotation": 15.0, "head.nod": 10.0})
    ).points
    _, still = rig.steps(rig.motion(rest, rest))
    _, places = rig.steps(rig.motion(rest, turned))
    rigid = [0, 1, 3, 4]
    np.testing.assert_allclose(places[rigid], still[rigid], atol=1e-6)
    np.testing.assert_allclose(places, still, atol=3e-4)  # what shapes a face scales the teeth after the jaw has turned
    assert rig.pivots[3][0] > head.rig(head.neutral).pivots[3][0] + 0.002  # the left eye is farther out


@pytest.mark.parametrize("name", [name for name in vocabulary("arkit").names if not name.startswith(("eye", "jaw"))])
def test_no_expression_moves_skull_or_jaw(name: str) -> None:
    # Lips rolled in press on the front teeth, which give way; skull and jaw do not.
    head = HEADS["classic"]
    rest = head.shape(head.neutral).points
    motion = RESTING.motion(rest, head.shape(mien.pose_from("arkit", {name: 1.0}, head)).points)
    np.testing.assert_allclose(motion.turns[1:3], [np.eye(3)] * 2, atol=1e-12)
    np.testing.assert_allclose(motion.shifts[1:3], 0.0, atol=1e-12)


def test_every_head_that_ships_has_joints() -> None:
    for name in (name for name, _ in mien.face_names() if name.startswith("head")):
        face = mien.load_face(name)
        assert isinstance(face, Rigged)
        mesh = face.shape(face.neutral)
        assert isinstance(mesh, Mesh)
        shares = face.rig(face.neutral).shares
        np.testing.assert_allclose(shares.sum(axis=1), 1.0, atol=1e-12)
        assert len(shares) == len(mesh.points)
