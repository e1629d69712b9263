"""Gestures in marks: poses that stay, moves that end where they began, a next one that takes over."""

import numpy as np
import pytest

from mien.core import Cue, Sound, UnknownNameError
from mien.faces import load_face
from mien.perform import check_marks, parse_marks, perform
from mien.perform.gestures import REACH_S, gesture, gestures
from mien.perform.marks import Expression
from mien.speech import Speech

OLAV = load_face("toon:olav")
WAVE_S = gestures(OLAV)["wave"].keys[-1][0]


def at(tracks, row, times):
    return tracks[row].evaluate(np.asarray(times, dtype=float))[0]


def ask(*asked, length_s=10.0):
    return gesture(OLAV, [(time_s, Expression(name)) for time_s, name in asked], length_s)


def test_a_pose_stays_and_the_hand_comes_down_at_the_end():
    tracks = ask((1.0, "point"))
    raise_at = at(tracks, "hand.raise", [0.0, 1.0, 1.0 + REACH_S, 5.0, 10.0 - REACH_S, 10.0])
    np.testing.assert_allclose(raise_at, [0, 0, 1, 1, 1, 0], atol=1e-12)
    np.testing.assert_allclose(at(tracks, "hand.middle", [5.0]), [1.0])
    assert "hand.index" not in tracks


def test_a_move_goes_through_its_keys_and_ends_in_the_pose_before():
    for before, held in ((None, 0.0), ("fist", 1.0)):
        tracks = ask(*([(0.0, before)] if before else []), (2.0, "wave"))
        keys = gestures(OLAV)["wave"].keys
        turned = at(tracks, "hand.turn", [2.0 + time_s for time_s, _ in keys])
        np.testing.assert_allclose(turned, [values["hand.turn"] - 0.5 for _, values in keys], atol=1e-9)
        after = 2.0 + WAVE_S + REACH_S
        np.testing.assert_allclose(at(tracks, "hand.raise", [2.0 + 1.0, after, 8.0]), [1.0, held, held], atol=1e-9)
        if before:
            np.testing.assert_allclose(at(tracks, "hand.index", [1.0, 3.0, after]), [1.0, 0.0, 1.0], atol=1e-9)


def test_the_next_gesture_sets_out_from_where_the_hand_is():
    tracks = ask((1.0, "point"), (1.0 + REACH_S / 2, "down"))
    times = np.linspace(0.9, 2.2, 400)
    values = at(tracks, "hand.raise", times)
    assert values.max() == pytest.approx(0.5, abs=0.01)
    assert np.abs(np.diff(values)).max() < 0.02
    assert values[-1] == 0.0


def test_what_is_asked_for_at_one_moment_or_too_late_makes_no_jump():
    for tracks in (ask((1.0, "point"), (1.0, "wave")), ask((9.9, "wave"))):
        values = at(tracks, "hand.raise", np.linspace(0.0, 10.0, 4000))
        assert np.abs(np.diff(values)).max() < 0.02
    assert ask((10.0, "wave")) == {}


def test_half_of_a_gesture_is_half_as_far():
    tracks = gesture(OLAV, [(0.0, Expression("open", 0.5))], 5.0)
    np.testing.assert_allclose(at(tracks, "hand.raise", [2.0]), [0.5])


def test_marks_move_the_hand_of_a_face_that_has_one_beside_its_expressions():
    text = "[happy] Hello [wave] there."
    words = (Cue(1.0, 1.4, "Hello"), Cue(1.4, 2.0, "there"))
    phones = (Cue(0.0, 1.0, "SIL"), Cue(1.0, 2.0, "AA1"), Cue(2.0, 6.0, "SIL"))
    speech = Speech("Hello there.", Sound.silence(6.0), words, phones, (), "none", text)
    layers = {layer.name: layer for layer in perform(speech, OLAV).timeline.layers}
    assert set(layers["hand"].tracks) == {"hand.raise", "hand.turn"}
    assert at(layers["hand"].tracks, "hand.raise", [1.2, 2.0])[1] == 1.0
    assert layers["expression"].tracks
    assert not any(name.startswith("hand") for name in layers["expression"].tracks)
    plain = perform(Speech("Hello there.", Sound.silence(6.0), words, phones, (), "none"), OLAV)
    assert "hand" not in [layer.name for layer in plain.timeline.layers]


@pytest.mark.parametrize("name", ["head", "toon:miso"])
def test_a_face_without_a_hand_says_so(name):
    with pytest.raises(UnknownNameError, match=r"mark in line 1, column 1: 'wave'"):
        check_marks(parse_marks("[wave] Hello."), load_face(name))
