"""A live voice that moves the mouth of a session: what is kept, what is dropped, how late it is."""

from __future__ import annotations

import base64
from functools import cache

import numpy as np
import pytest
from live_server import STILL, Plain

from mien.core import MienError, RangeError
from mien.faces import load_face
from mien.live import Session
from mien.live.messages import Message, check_message
from mien.live.mixing import CHANNELS
from mien.live.serving.about import describe
from mien.live.serving.animator import Animator
from mien.live.serving.microphone import MOST_AHEAD_S, Microphone
from mien.speech import Speech, speak
from mien.speech.mouth import MOUTH_CHANNELS, articulate
from mien.vocab import vocabulary

LOOP_S = 1 / 60
RATE_HZ = 24000
BLOCK = RATE_HZ // 50


@cache
def said() -> Speech:
    return speak("My father bought a loaf of bread and a pot of plum jam from the farmer.")


def blocks(size: int = BLOCK) -> list[np.ndarray]:
    samples = said().sound.samples
    return [samples[first : first + size] for first in range(0, len(samples), size)]


def play(microphone: Microphone, session: Session, loops: int, size: int = BLOCK) -> np.ndarray:
    """(loops, C) of the layer of speech, when each block comes as soon as its last sample is there."""
    samples, done, rows = said().sound.samples, 0, []
    for loop in range(loops):
        while done + size <= min(len(samples), loop * LOOP_S * RATE_HZ):
            hand(session, microphone.hear(samples[done : done + size], RATE_HZ))
            done += size
        hand(session, microphone.tick(loop))
        session.step()
        rows.append(session._speech.values.copy())
    return np.array(rows)


def hand(session: Session, message: Message | None) -> None:
    if message is not None:
        assert session.handle(message)["kind"] == "ok"


def wanted(times_s: np.ndarray) -> np.ndarray:
    """(N, C) what the phones ask of the mouth."""
    table, tracks = vocabulary(CHANNELS), articulate(said().phones)
    values = np.zeros((len(times_s), len(table)))
    for name in MOUTH_CHANNELS:
        values[:, table.index[name]] = tracks[name].evaluate(np.maximum(times_s, 0.0))[0]
    return values


@pytest.mark.parametrize("size", [RATE_HZ // 100, BLOCK, RATE_HZ * 3 // 100])
def test_the_mouth_is_at_most_150_ms_behind_the_voice(size: int):
    microphone, session = Microphone(LOOP_S), Session(load_face("toon:tok"), LOOP_S)
    loops = int(said().sound.length_s / LOOP_S) + 30
    drawn, times_s = play(microphone, session, loops, size), np.arange(loops) * LOOP_S
    mouth = [vocabulary(CHANNELS).index[name] for name in ("jaw", "lower_lip", "round", "spread")]
    delays_s = np.arange(0.0, 0.3, 0.005)
    like = [
        np.mean([np.corrcoef(drawn[:, row], wanted(times_s - delay_s)[:, row])[0, 1] for row in mouth])
        for delay_s in delays_s
    ]
    assert max(like) > 0.55
    assert delays_s[int(np.argmax(like))] <= 0.15
    assert microphone.dropped_s == 0.0


def test_the_bound_that_is_told_holds_for_a_sudden_vowel():
    buzz = np.zeros(RATE_HZ, dtype=np.int16)
    buzz[RATE_HZ // 2 :: 200] = 20000
    microphone, first = Microphone(LOOP_S), None
    for number in range(RATE_HZ // BLOCK):
        microphone.tick(int((number + 1) * 0.02 / LOOP_S))
        message = microphone.hear(buzz[number * BLOCK : (number + 1) * BLOCK], RATE_HZ)
        if message is not None and first is None:
            first = (number + 1) * 0.02 - 0.5
    assert first is not None
    assert 0.0 < first <= microphone.behind_s - 2 * LOOP_S
    assert microphone.behind_s <= 0.15


def test_what_comes_out_is_a_message():
    microphone = Microphone(LOOP_S)
    message = next(filter(None, (microphone.hear(block, RATE_HZ) for block in blocks()[:40])))
    assert check_message(message.to_json()) == message
    assert message["layer"] == "speech"
    assert message["over_ms"] == pytest.approx(2000 * LOOP_S)
    assert set(message["values"]) == set(MOUTH_CHANNELS)


def test_silence_says_nothing():
    microphone = Microphone(LOOP_S)
    for loop in range(100):
        assert microphone.hear(np.zeros(BLOCK, dtype=np.int16), RATE_HZ) is None
        assert microphone.tick(loop) is None


def test_the_mouth_shuts_once_when_sound_stops_coming():
    microphone, session = Microphone(LOOP_S), Session(load_face("toon:tok"), LOOP_S)
    for loop, block in enumerate(blocks()[:40]):
        hand(session, microphone.hear(block, RATE_HZ))
        hand(session, microphone.tick(loop))
        session.step()
    assert session._speech.values.any()
    messages = [message for loop in range(40, 100) if (message := microphone.tick(loop)) is not None]
    assert len(messages) == 1
    hand(session, messages[0])
    for _ in range(7):
        session.step()
    assert not session._speech.values.any()


def test_a_block_that_moves_nothing_keeps_the_mouth_from_being_shut_as_stale():
    microphone = Microphone(LOOP_S)
    for block in blocks()[:40]:
        microphone.hear(block, RATE_HZ)
    for loop in range(1, 30):
        microphone.hear(blocks()[40 + loop], RATE_HZ)
        assert microphone.tick(loop) is None


def test_sound_that_comes_too_fast_is_dropped_and_counted():
    microphone = Microphone(LOOP_S)
    for block in blocks() * 3:
        microphone.hear(block, RATE_HZ)
    length_s = 3 * said().sound.length_s
    assert 0.9 < microphone.heard_s <= MOST_AHEAD_S + 1e-9
    assert microphone.heard_s + microphone.dropped_s == pytest.approx(length_s)
    assert "s dropped" in microphone.describe()
    microphone.tick(60)  # a second later there is room again
    before = microphone.heard_s
    microphone.hear(blocks()[20], RATE_HZ)
    assert microphone.heard_s == pytest.approx(before + 0.02)


def test_only_the_end_of_a_long_block_is_listened_to():
    microphone = Microphone(LOOP_S)
    assert microphone.hear(said().sound.samples[: RATE_HZ * 9 // 10], RATE_HZ) is not None
    assert microphone.heard_s == pytest.approx(0.2)
    assert microphone.dropped_s == pytest.approx(0.7)


def test_lips_that_were_shut_within_a_block_are_seen_to_be_shut():
    def most_shut(size: int) -> list[float]:
        microphone, found = Microphone(LOOP_S), []
        for loop, block in enumerate(blocks(size)):
            microphone.tick(4 * loop)
            message = microphone.hear(block, RATE_HZ)
            found.append(message["values"]["closure"] if message else 0.0)
        return found

    assert sum(value > 0.9 for value in most_shut(RATE_HZ // 20)) >= 3


def test_a_sender_that_goes_to_and_fro_between_rates_is_held_up():
    microphone = Microphone(LOOP_S)
    for _ in range(100):
        for rate_hz in (8000, 16000):
            microphone.hear(np.zeros(8, dtype=np.int16), rate_hz)
    assert microphone.heard_s < 0.06
    assert microphone.dropped_s > 0.1


def test_another_rate_begins_another_listener():
    microphone = Microphone(LOOP_S)
    microphone.hear(blocks()[20], RATE_HZ)
    microphone.hear(blocks()[20][::3], RATE_HZ // 3)
    assert microphone.heard_s == pytest.approx(0.04)


@pytest.mark.parametrize("samples", [np.zeros((2, 3), np.int16), np.zeros(3), np.zeros(3, np.uint16)])
def test_what_is_no_sound_is_refused(samples: np.ndarray):
    with pytest.raises(MienError, match=r"want \(N,\) int16"):
        Microphone(LOOP_S).hear(samples, RATE_HZ)


@pytest.mark.parametrize("rate_hz", [0, -1, 100, 10**9])
def test_a_rate_of_no_sound_is_refused_and_what_was_goes_on(rate_hz: int):
    microphone = Microphone(LOOP_S)
    with pytest.raises(RangeError, match="rate_hz"):
        microphone.hear(blocks()[0], rate_hz)
    assert microphone.hear(np.zeros(0, dtype=np.int16), RATE_HZ) is None


def test_a_face_on_sockets_listens():
    lines: list[str] = []
    animator = Animator(Session(load_face("toon:tok"), LOOP_S, idle=STILL, log=lines.append), Plain())
    rest, widest = animator.session.values, 0.0
    for block in blocks()[:40]:
        data = base64.b64encode(block.astype("<i2").tobytes()).decode()
        answer = animator.handle({"kind": "speech.pcm", "rate_hz": RATE_HZ, "data": data, "id": "7"})
        assert answer == {"kind": "ok", "id": "7"}
        animator._step()
        widest = max(widest, float(np.abs(animator.session.values - rest).max()))
    assert widest > 0.1
    for _ in range(60):
        animator._step()
    np.testing.assert_array_equal(animator.session.values, rest)
    assert describe(animator)["microphone"].startswith("spectrum regression, no phone recogniser: at most ")
    # What moved the mouth is in the log, so that a replay needs no sound.
    assert sum('"layer": "speech"' in line for line in lines) > 10
