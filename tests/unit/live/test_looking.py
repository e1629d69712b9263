"""Targets with names: looked at as their points are, followed while they move, and no longer than that."""

import math

import numpy as np
import pytest

from mien.live.looking import MOST_TARGETS, PURSUIT_DEG
from mien.vocab import vocabulary
from sessions import ok, run, still

INDEX = vocabulary("channels").index


def angles(session, axis):
    """Degrees of eyes and head."""
    return tuple(float(session._gaze.values[INDEX[f"{part}_{axis}"]]) for part in ("eye", "head"))


def point(turn_deg, nod_deg=0.0, far_m=1.0):
    turn, nod = math.radians(turn_deg), math.radians(nod_deg)
    return [far_m * math.sin(turn) * math.cos(nod), far_m * math.sin(nod), far_m * math.cos(turn) * math.cos(nod)]


def test_a_target_is_looked_at_as_its_point_is():
    named, plain = still(), still()
    ok(named, kind="target", name="cup", at=[0.2, 0.1, 0.5])
    ok(named, kind="look", at="cup", head=0.5)
    ok(plain, kind="look", at=[0.2, 0.1, 0.5], head=0.5)
    for one, other in zip(run(named, 50), run(plain, 50), strict=True):
        np.testing.assert_array_equal(one.pose.values, other.pose.values)


@pytest.mark.parametrize("every", [1, 2, 4])
def test_eyes_and_head_together_stay_on_a_target_that_moves(every):
    session = still()
    ok(session, kind="target", name="cup", at=point(-12, 3))
    ok(session, kind="look", at="cup")
    run(session, 60)
    heads = [angles(session, "turn")[1]]
    for step in range(120):
        turn = -12 + 0.25 * step
        if step % every == 0:
            ok(session, kind="target", name="cup", at=point(turn, 3))
            aim = turn
        session.step()
        assert sum(angles(session, "turn")) == pytest.approx(aim, abs=1e-6)
        assert sum(angles(session, "nod")) == pytest.approx(3, abs=1e-6)
        heads.append(angles(session, "turn")[1])
    assert (np.diff(heads)[every:] > 0).all()
    run(session, 60)
    still_there = still()
    ok(still_there, kind="look", at=point(aim, 3))
    run(still_there, 60)
    np.testing.assert_allclose(session.values, still_there.values, atol=1e-6)


def test_a_target_that_jumps_is_caught_up_with_by_a_leap():
    session = still()
    ok(session, kind="target", name="cup", at=point(0.001))
    ok(session, kind="look", at="cup")
    run(session, 60)
    ok(session, kind="target", name="cup", at=point(0.001 + 10 * PURSUIT_DEG))
    run(session, 1)
    assert 0 < sum(angles(session, "turn")) < 20  # 21 ms + 2.2 ms a degree are 87 ms: six loops
    run(session, 5)
    assert sum(angles(session, "turn")) == pytest.approx(0.001 + 10 * PURSUIT_DEG, abs=1e-6)


@pytest.mark.parametrize(
    "then",
    [
        {"kind": "look", "at": "viewer"},
        {"kind": "look", "at": [0, 0, 1]},
        {"kind": "stop", "layer": "gaze"},
        {"kind": "reset"},
        {"kind": "move", "values": {"eye_turn": 3}, "layer": "gaze"},
    ],
)
def test_what_is_not_looked_at_any_more_is_not_followed(then):
    session, other = still(), still()
    for each in (session, other):
        ok(each, kind="target", name="cup", at=point(20))
        ok(each, kind="look", at="cup")
        run(each, 10)
        ok(each, **then)
    ok(session, kind="target", name="cup", at=point(-20))
    np.testing.assert_array_equal(run(session, 60)[-1].pose.values, run(other, 60)[-1].pose.values)


def test_names_are_known_or_refused():
    session = still()
    before = session.values
    assert "did you mean 'left'" in session.handle({"kind": "look", "at": "lfet"})["message"]
    ok(session, kind="target", name="cup", at=[0, 0, 1])
    assert "did you mean 'cup'" in session.handle({"kind": "look", "at": "cub"})["message"]
    assert "is a direction" in session.handle({"kind": "target", "name": "left", "at": [0, 0, 1]})["message"]
    for number in range(MOST_TARGETS - 1):
        ok(session, kind="target", name=str(number), at=[0, 0, 1])
    assert "already" in session.handle({"kind": "target", "name": "one more", "at": [0, 0, 1]})["message"]
    ok(session, kind="target", name="cup", at=[0, 0, 2])
    np.testing.assert_array_equal(run(session, 3)[-1].pose.values, before)
