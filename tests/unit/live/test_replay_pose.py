"""A session of a face that is not neutral at rest."""

import numpy as np

import mien
from mien.live import Session, read_log, replay
from support import face

STILL = {"blinks": 0.0, "saccades": 0.0, "breathing": 0.0, "sway": 0.0}
POSE = {"mouth.expression": 0.5, "jaw.rotation": 2.0}


def test_all_that_ends_ends_in_the_pose_at_rest_and_a_log_knows_it():
    subject, lines = face("head"), []
    pose = subject.neutral.replace(POSE)
    session = Session(subject, 1 / 60, 3, pose=pose, idle=STILL, log=lines.append)
    frames = [session.step()]
    for message in (
        {"kind": "play", "motion": "smile"},
        {"kind": "move", "values": {"jaw.rotation": 9}, "over_ms": 200},
        {"kind": "move", "values": {"jaw.rotation": 5}, "layer": "expression", "over_ms": 200},
    ):
        assert session.handle(message)["kind"] == "ok"
        frames += [session.step() for _ in range(200)]
    assert frames[-1].pose["jaw.rotation"] == 9
    session.handle({"kind": "reset"})
    frames += [session.step() for _ in range(300)]
    session.close()
    moved = {row.name for row in subject.parameters if row.role == "motion"}
    last = frames[-1].pose
    assert {name: last[name] for name in moved} == {name: pose[name] for name in moved}
    again = [frame.pose.values for frame in replay(read_log(lines), subject)]
    np.testing.assert_array_equal(again, [frame.pose.values for frame in frames])


def test_a_person_is_who_they_are_while_live():
    subject = face("head")
    person = mien.make_pose(subject, seed=7)
    session = Session(subject, pose=person, idle=STILL)
    np.testing.assert_array_equal(session.step().pose.values, person.values)
