"""Rules of the layers at values worked out by hand."""

from dataclasses import replace

import numpy as np
import pytest

from mien.live.mixing import CHANNELS, Mixer, Moment
from mien.vocab import vocabulary
from support import FACE_NAMES, face

HEAD = face("head").parameters


def channels(**values):
    found = np.zeros(len(vocabulary(CHANNELS)))
    for name, value in values.items():
        found[vocabulary(CHANNELS).index[name.replace("__", ".")]] = value
    return found


def rows(table=HEAD, **values):
    found = np.zeros(len(table))
    for name, value in values.items():
        found[table.index[name.replace("__", ".")]] = value
    return found


REST = Moment(channels(), channels(), rows(), channels(), HEAD.defaults, rows(), 0.0)


def mix(**changes):
    values = Mixer(face("head")).mix(replace(REST, **changes))
    return dict(zip(HEAD.names, values.tolist(), strict=True))


@pytest.mark.parametrize("name", FACE_NAMES)
def test_at_rest_every_face_is_neutral(name):
    table, still = face(name).parameters, channels()
    moment = Moment(still, still, rows(table), still, table.defaults, rows(table), 0.0)
    np.testing.assert_array_equal(Mixer(face(name)).mix(moment), table.defaults)


def test_layers_are_added_up():
    found = mix(
        idle=channels(head_turn=2.0), gaze=channels(head_turn=5.0), expression=rows(head__turn=-4.0, jaw__rotation=3.0)
    )
    assert found["head.turn"] == 3.0
    assert found["jaw.rotation"] == 3.0


def test_a_sum_stays_within_its_range():
    assert mix(gaze=channels(head_turn=40.0), idle=channels(head_turn=20.0))["head.turn"] == HEAD["head.turn"].high


def test_a_blink_shuts_an_eye_however_wide_it_is():
    row = HEAD["eyelid.opening.left"]
    for wide in (0.0, row.high - row.default):
        found = mix(expression=rows(eyelid__opening__left=wide), idle=channels(blink__left=1.0))
        assert found["eyelid.opening.left"] == 0.0
        half = mix(expression=rows(eyelid__opening__left=wide), idle=channels(blink__left=0.5))
        assert half["eyelid.opening.left"] == pytest.approx(0.5 * (row.default + wide))


def test_pressed_lips_take_away_what_parts_them():
    found = mix(expression=rows(mouth__upper_raise__left=0.8), speech=channels(closure=1.0))
    assert found["mouth.upper_raise.left"] == 0.0
    assert found["mouth.closure"] == 1.0


def test_what_is_held_replaces_everything_and_half_of_it_half():
    direct = HEAD.defaults + rows(jaw__rotation=8.0)
    beneath = rows(jaw__rotation=4.0)
    assert mix(direct=direct, held=rows(jaw__rotation=1.0), expression=beneath)["jaw.rotation"] == 8.0
    assert mix(direct=direct, held=rows(jaw__rotation=0.5), expression=beneath)["jaw.rotation"] == 6.0
    assert mix(direct=direct, expression=beneath)["jaw.rotation"] == 4.0


def test_speech_has_the_mouth_while_it_borrows_it_and_nothing_else():
    direct = HEAD.defaults + rows(jaw__rotation=10.0, head__turn=7.0)
    held = rows(jaw__rotation=1.0, head__turn=1.0)
    found = mix(direct=direct, held=held, speech=channels(jaw=0.5), borrowed=1.0)
    assert found["jaw.rotation"] == pytest.approx(0.45 * 10.0 + 13.0 * 0.5)
    assert found["head.turn"] == 7.0
    quiet = mix(expression=rows(jaw__rotation=10.0, eyebrow__lower__left=0.5), borrowed=1.0)
    assert quiet["jaw.rotation"] == pytest.approx(4.5)
    assert quiet["eyebrow.lower.left"] == 0.5
