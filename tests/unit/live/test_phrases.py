"""Blinks and glances while something is said: at the ends of phrases, in the place of idle life, switched with it."""

from dataclasses import replace

import numpy as np
import pytest

from mien.core import Cue
from mien.gaze.blinks import CLOSE_S, NEAR_S, OPEN_S, SHUT_S
from mien.live import IDLE_PARTS, Session
from mien.live.phrases import life_beside
from mien.live.saying import make_utterance
from mien.perform.performance import PHRASE_LOOK_S
from mien.vocab import vocabulary
from sessions import SAY, STILL, ok, run
from support import face

INDEX = vocabulary("channels").index
PHONES = [
    (0.0, 2.4, "AA1"),
    (2.4, 2.7, "SIL"),
    (2.7, 5.6, "OW1"),
    (5.6, 6.0, "SIL"),
    (6.0, 9.0, "AA1"),
    (9.0, 9.5, "SIL"),
]
ENDS_S = (2.4, 5.6, 9.0)
TIMES = np.arange(571) / 60
LID = "eyelid.opening.left"


def lives(seed):
    found = {
        (IDLE_PARTS[part], channel): values
        for part, channel, values in life_beside([Cue(*phone) for phone in PHONES], TIMES, seed)
    }
    return found["blinks", INDEX["blink.left"]], found["saccades", INDEX["eye_turn"]]


@pytest.mark.parametrize("seed", range(30))
def test_blinks_near_the_end_of_a_phrase_are_made_there(seed):
    lids, _ = lives(seed)
    starts = TIMES[1:][(lids[1:] > 0) & (lids[:-1] == 0)]
    whole = CLOSE_S + SHUT_S + OPEN_S
    for number, start in enumerate(starts):
        pause = min(abs(start - end_s) for end_s in ENDS_S)
        after_another = number > 0 and start - starts[number - 1] < 3 * whole
        assert pause < 0.034 or pause > NEAR_S - 0.034 or after_another
    assert lids[-1] == 0.0


@pytest.mark.parametrize("seed", range(10))
def test_the_eyes_are_on_the_listener_before_a_phrase_ends(seed):
    _, turn = lives(seed)
    assert turn.any()
    for end_s in ENDS_S[:-1]:
        last = round(60 * end_s)
        assert not turn[last - round(60 * (PHRASE_LOOK_S - 0.05)) : last].any()
    assert turn[-1] == 0.0


def saying(life, idle, loops=60):
    """A session that says something long, with a life of its own."""
    session = Session(face("head"), seed=3, idle={**STILL, **idle})
    message = {**SAY, "phones": [[0.0, 30.0, "AA1"], [30.0, 30.5, "SIL"]], "words": []}
    utterance = make_utterance("Hello", message["phones"], (), rate=session.rate, seed=3)
    given = tuple((part, channel, np.full(utterance.loops, value)) for part, channel, value in life)
    assert session.handle(message, replace(utterance, life=given))["kind"] == "ok"
    return session, [frame.pose[LID] for frame in run(session, loops)]


OPEN, SHUT = (0, INDEX["blink.left"], 0.0), (0, INDEX["blink.left"], 1.0)


def test_idle_life_rests_in_what_the_utterance_does_and_goes_on_in_the_rest():
    _, without = saying((), {"blinks": 1}, 1200)
    _, led = saying((OPEN,), {"blinks": 1}, 1200)
    rest = face("head").parameters[LID].default
    assert min(without) < 0.1 * rest
    assert min(led[10:]) == max(led[10:]) == rest


def test_what_is_switched_off_is_off_while_something_is_said():
    _, lids = saying((SHUT,), {"blinks": 0})
    assert set(lids) == {face("head").parameters[LID].default}
    _, lids = saying((SHUT,), {"blinks": 1})
    assert lids[-1] == 0.0


def test_a_blink_that_is_broken_off_opens_as_idle_life_takes_over():
    session, lids = saying((SHUT,), {"blinks": 1})
    ok(session, kind="interrupt")
    after = [lids[-1], *(frame.pose[LID] for frame in run(session, 20))]
    assert after[0] == 0.0
    assert 0 < max(np.diff(after)) < 0.15 * face("head").parameters[LID].default
    assert after[-1] == face("head").parameters[LID].default
