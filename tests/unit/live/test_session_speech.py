"""What a session says: order, events, what it borrows, what was made beforehand, what a log has of it."""

import json
from dataclasses import replace

import numpy as np
import pytest

from mien.core import Cue, Sound
from mien.live import Session, check_message, read_log, replay
from mien.live.saying import Turn, make_utterance
from mien.live.session import MOST_SAID, MOST_SAID_S
from mien.speech import Speech
from sessions import FACES, PHONES, SAY, STILL, WIDE, digest, ok, run, still
from support import face


@pytest.mark.parametrize("name", FACES)
def test_speech_gives_back_what_it_borrowed(name):
    session, row = still(name), WIDE[name]
    ok(session, kind="move", values={row: 0.9})
    ok(session, kind="play", motion="smile", hold=True)
    before = run(session, 130)[-1].pose
    loops = ok(session, **SAY)["loops"]
    said = run(session, loops)
    assert len({frame.pose[row] for frame in said}) > 20
    after = run(session, 30)[-1].pose
    np.testing.assert_array_equal(after.values, before.values)


def test_speech_tells_when_it_starts_and_ends_and_the_next_text_follows():
    session = still()
    replies = [ok(session, **SAY, more=True), ok(session, **{**SAY, "id": "8"})]
    assert [reply["speech"] for reply in replies] == [0, 1]
    first, second = (reply["loops"] for reply in replies)
    assert session.unsaid_s == pytest.approx((first + second) / 60)
    frames = run(session, first + second + 9)
    assert session.unsaid_s == 0.0
    events = [
        (frame.loop, event["event"], event["id"], event["speech"], event.get("more"))
        for frame in frames
        for event in frame.events
    ]
    assert events == [
        (0, "speech.started", "7", 0, None),
        (0, "speech.word", "7", 0, None),
        (first - 1, "speech.ended", "7", 0, True),
        (first, "speech.started", "8", 1, None),
        (first, "speech.word", "8", 1, None),
        (first + second - 1, "speech.ended", "8", 1, False),
    ]


def prepared(session, **more):
    message = check_message(SAY)
    made = make_utterance(message["text"], message["phones"], message["words"], rate=session.rate, seed=session.seed)
    return message, replace(made, **more)


def test_an_utterance_made_beforehand_is_said_as_one_made_on_the_spot():
    by_hand, on_the_spot = still(seed=3), still(seed=3)
    for session in (by_hand, on_the_spot):
        ok(session, kind="say", text="First", phones=PHONES)
    assert by_hand.handle(*prepared(by_hand)) == ok(on_the_spot, **SAY)
    assert digest(run(by_hand, 150)) == digest(run(on_the_spot, 150))


def test_acts_of_an_utterance_come_at_their_loop_and_again_in_a_replay():
    log, smile = [], check_message({"kind": "play", "motion": "smile"})
    session = still(log=log.append)
    rest = run(session, 1)[0].pose
    session.handle(*prepared(session, acts={50: (smile,)}))
    frames = run(session, 150)
    session.close()
    assert [json.loads(line).get("loop") for line in log] == [None, 1, 51, None]
    assert frames[-1].pose["mouth.expression.left"] != rest["mouth.expression.left"]
    assert digest(list(replay(read_log(log), face("head")))[1:]) == digest(frames)


def test_acts_that_cannot_be_are_told_and_those_of_what_was_dropped_are_not_done():
    dance = check_message({"kind": "play", "motion": "dance"})
    session = still()
    session.handle(*prepared(session, acts={2: (dance,)}))
    session.handle(*prepared(session, acts={0: (dance,)}))
    failed = [event for frame in run(session, 9) for event in frame.events if event["event"] == "speech.failed"]
    assert [(event["speech"], event["id"]) for event in failed] == [(0, "7")]
    assert "unknown motion 'dance'" in failed[0]["message"]
    ok(session, kind="interrupt")
    assert "speech.failed" not in [event["event"] for frame in run(session, 99) for event in frame.events]


def test_what_chance_does_with_a_text_does_not_depend_on_those_before():
    channels = []
    for before in (0, 2):
        session = still(seed=5)
        for _ in range(before):
            ok(session, kind="say", text="Before", phones=PHONES)
        ok(session, **SAY)
        channels.append(session._said[-1].utterance.channels.tobytes())
    assert channels[0] == channels[1]


@pytest.mark.parametrize("loop_s", [1 / 60, 1 / 25, 0.1])
@pytest.mark.parametrize("name", FACES)
def test_an_interruption_shuts_the_mouth_within_100_ms(name, loop_s):
    session = Session(face(name), loop_s=loop_s, idle=STILL)
    row = WIDE[name]
    rest = session.face.neutral[row]
    long = [[0.0, 2.0, "AA1"], [2.0, 2.5, "SIL"]]
    ok(session, kind="play", motion="laugh")
    ok(session, kind="say", text="aaah", phones=long, id="a")
    ok(session, kind="say", text="and more", phones=long, id="b")
    assert run(session, int(0.7 / loop_s))[-1].pose[row] > 0.2
    ok(session, kind="interrupt")
    frames = run(session, int(0.1 / loop_s + 1e-6))
    assert frames[-1].pose[row] == rest
    assert [(event["id"], event["broken_off"]) for event in frames[0].events] == [("a", True), ("b", True)]
    moved = [frame.pose[row] for frame in run(session, int(3.0 / loop_s))]
    assert set(moved) == {rest}


MOVED = {
    "direct": {"kind": "move", "values": {"MB": 0.9}, "over_ms": 3000},
    "expression": {"kind": "move", "values": {"MB": 0.9}, "layer": "expression"},
    "a live voice": {"kind": "move", "values": {"jaw": 0.9}, "layer": "speech"},
    "a motion": {"kind": "play", "motion": "yawn", "hold": True},
}


@pytest.mark.parametrize("saying", [False, True])
@pytest.mark.parametrize("moved", MOVED)
@pytest.mark.parametrize("name", FACES)
def test_an_interruption_shuts_a_mouth_whoever_holds_it(name, moved, saying):
    session, table = still(name), face(name).parameters
    ok(session, kind="move", values={"ELU": 0.3})
    ok(session, **MOVED[moved])
    if saying:
        ok(session, **SAY)
    assert run(session, 40)[-1].pose[WIDE[name]] != table[WIDE[name]].default
    ok(session, kind="interrupt")
    run(session, 6)
    mouth = session._mixer.mouth
    np.testing.assert_array_equal(session.values[mouth], table.defaults[mouth])
    np.testing.assert_array_equal(run(session, 300)[-1].pose.values[mouth], table.defaults[mouth])
    assert ok(session, kind="state", names=["ELU"])["values"]["ELU"] == pytest.approx(0.3)
    ok(session, kind="move", values={"MB": 0.5})
    assert run(session, 1)[-1].pose[WIDE[name]] != table[WIDE[name]].default


def test_what_has_ended_is_not_broken_off_as_well():
    session = still()
    frames = run(session, ok(session, **SAY)["loops"])
    assert frames[-1].events[-1]["event"] == "speech.ended"
    ok(session, kind="interrupt")
    assert session.step().events == ()
    assert session.unsaid_s == 0.0


def test_a_voice_is_asked_once_and_its_phones_are_logged():
    heard = []

    def voice(text):
        heard.append(text)
        cues = tuple(Cue(*cue) for cue in PHONES)
        return Speech(text, Sound(np.zeros(100, dtype=np.int16), 8000), (), cues, (), "none")

    log = []
    session = still(log=log.append, voice=voice)
    ok(session, kind="say", text="Hello")
    frames = run(session, 30)
    session.close()
    assert heard == ["Hello"]
    assert json.loads(log[1])["message"]["phones"] == PHONES
    assert digest(replay(read_log(log), face("head"))) == digest(frames)


def test_without_a_voice_a_text_needs_phones():
    assert "no voice" in still().handle({"kind": "say", "text": "Hello"})["message"]
    reply = still().handle({"kind": "say", "text": "Hello", "phones": [[0, 1, "QQ"]], "id": "x"})
    assert reply["id"] == "x"
    assert "QQ" in reply["message"]


def test_texts_that_wait_are_bounded_in_number_and_length():
    session = still("toon:gus")
    message, short = prepared(session)
    kinds = [session.handle(message, short)["kind"] for _ in range(MOST_SAID + 5)]
    assert kinds.count("ok") == min(MOST_SAID, int(MOST_SAID_S * 60 / short.loops))
    ok(session, kind="interrupt")
    tiny = replace(short, channels=short.channels[:, :2])
    kinds = [session.handle(message, tiny)["kind"] for _ in range(MOST_SAID + 5)]
    assert kinds.count("ok") == MOST_SAID


def test_the_next_text_waits_for_the_end_of_the_sound_and_no_longer():
    long = [*PHONES[:-1], [0.7, 1.5, "SIL"]]
    hello = make_utterance("Hello", long, SAY["words"], rate=still().rate, seed=0)
    assert hello.loops == 1 + 1.5 * 60
    _, soon_over = prepared(still())
    for utterance in (hello, soon_over):
        assert not utterance.channels[:, -1].any()
    assert soon_over.channels[:, -2].any()
    silent = make_utterance("", ((0.0, 0.1, "SIL"),), (), rate=still().rate, seed=0)
    assert silent.loops == 7
    assert [event["event"] for event in Turn(silent, 0).events(6)] == ["speech.ended"]
