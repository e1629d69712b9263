"""Timelines as weights of morph targets and turns of joints."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from small_puppet import SmallPuppet, teach

from mien.core import Scene
from mien.formats.glb_motion import Fit, join_turns, record, resting_pose
from mien.formats.glb_targets import Anatomy
from mien.timeline import Layer, Timeline, Track


def test_weights_of_targets_that_do_not_touch_are_found_one_by_one() -> None:
    fit = Fit(np.array([[2.0, 0, 0, 0], [0, 0, 3.0, 0], [0, 0, 0, 0]]))
    weights = fit.weights(np.array([[1.0, 7, 1.5, 7], [-1, 0, 9, 0]]))
    # One goes below 0 and one beyond 1; a target that moves nothing is not used.
    np.testing.assert_allclose(weights, [[0.5, 0.5, 0], [0, 1, 0]], atol=1e-3)


def test_weights_of_targets_that_overlap_add_up_to_the_form() -> None:
    fields = np.array([[1.0, 1, 0], [0, 1, 1], [1, 0, 1]])
    wanted = np.array([[0.3, 0.9, 0.0], [1.0, 0.2, 0.6]])
    np.testing.assert_allclose(Fit(fields).weights(wanted @ fields), wanted, atol=2e-3)


def test_what_no_target_can_do_is_met_as_nearly_as_can_be() -> None:
    # The nearest point of the line (t, t) to (1, 0).
    np.testing.assert_allclose(Fit(np.array([[1.0, 1.0]])).weights(np.array([[1.0, 0.0]])), [[0.5]], atol=1e-3)


def test_turns_never_take_the_long_way() -> None:
    q = np.array([0.0, 0, 0.6, 0.8])
    turns = np.array([[q], [-q], [q], [q], [-q]])
    np.testing.assert_array_equal(join_turns(turns), np.array([[q]] * 5))


@pytest.fixture
def timeline(monkeypatch: pytest.MonkeyPatch) -> Timeline:
    """A second in which the jaw opens by 60 degrees, the head turns by 90, the smile stays."""
    teach(monkeypatch)
    tracks = {
        "jaw.rotation": Track.from_keys([0.0, 1.0], [0.0, 60.0]),
        "head.turn": Track.from_keys([0.0, 1.0], [0.0, 90.0]),
        "smile": Track.from_keys([0.0], [0.5]),
        "nose.size": Track.from_keys([0.0], [1.5]),
    }
    return Timeline((Layer("direct", "replace", tracks),), 1.0)


def test_what_targets_can_do_is_left_to_them(timeline: Timeline) -> None:
    assert resting_pose(SmallPuppet(), timeline, Scene(), Fraction(10)).changed() == {"nose.size": 1.5}


def test_what_changes_out_of_reach_rests_at_its_default(timeline: Timeline) -> None:
    track = Track.from_keys([0.0, 1.0], [1.0, 2.0])
    growing = timeline.with_layer(Layer("grow", "replace", {"nose.size": track}))
    assert resting_pose(SmallPuppet(), growing, Scene(), Fraction(10)).changed() == {}


def test_frames_have_times_weights_and_turns(timeline: Timeline) -> None:
    face, rate = SmallPuppet(), Fraction(24000, 1001)
    anatomy = Anatomy(face, resting_pose(face, timeline, Scene(), rate), 0)
    recording = record(anatomy, timeline, Scene(), rate)
    np.testing.assert_allclose(recording.times_s, np.arange(24) * 1001 / 24000, atol=1e-12)
    used = [name for name, weight in zip(anatomy.names, recording.weights.max(axis=0), strict=True) if weight > 1e-3]
    assert used == ["mouthSmileLeft"]  # the jaw is rigid: its joint does all
    np.testing.assert_allclose(recording.weights.max(axis=1), 0.5, atol=2e-3)
    half = np.radians(np.arange(24) * 1001 / 24000 / 2)
    nothing = np.zeros(24)
    for joint, axis, degrees in ((1, 1, 90.0), (2, 0, 60.0)):
        want = np.stack([nothing, nothing, nothing, np.cos(degrees * half)], axis=1)
        want[:, axis] = np.sin(degrees * half)
        np.testing.assert_allclose(recording.turns[:, joint], want, atol=1e-9)
    np.testing.assert_allclose(recording.places[:, 2], [[0, 0, 2.0]] * 24, atol=1e-9)
