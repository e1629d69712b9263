"""A log keeps what was heard, and a replay is heard when it was."""

import json
from pathlib import Path

import numpy as np
import pytest

from mien.core import Cue, LoadError, Sound
from mien.live import Frame, Session, check_message, load_log, perform_log, read_log
from mien.live.saying import make_utterance
from mien.live.serving.animator import Animator
from mien.live.serving.speaker import Part
from mien.live.sounds import Sounds, join_sounds
from mien.speech import Speech
from sessions import PHONES, SAY, STILL, ok, run
from support import face

RATE_HZ = 8000
LONG_S = 0.9


def tone(level: int, length_s: float = LONG_S) -> Sound:
    return Sound(np.full(round(length_s * RATE_HZ), level, dtype=np.int16), RATE_HZ)


def talk(lines: list[str], *, until_interrupted: int = 200) -> int:
    """A session that says three texts with sound, from loop 30 on; loops of the first."""
    session = Session(face("toon:olav"), idle=STILL, log=lines.append)
    run(session, 30)
    for level in (-5, 700, 9):
        reply = ok(session, **SAY)
        session.keep_sound(reply["speech"], tone(level))
    run(session, until_interrupted)
    ok(session, kind="interrupt")
    run(session, 60)
    session.close()
    return int(reply["loops"])


def test_each_sound_begins_with_its_text_and_ends_with_it() -> None:
    lines: list[str] = []
    loops = talk(lines)
    sound = perform_log(read_log(lines), face("toon:olav")).sound
    assert sound is not None
    assert sound.rate_hz == RATE_HZ
    assert len(sound.samples) == round(290 / 60 * RATE_HZ)
    wanted = np.zeros(len(sound.samples), dtype=np.int16)
    for number, level in enumerate((-5, 700, 9)):
        first = round((30 + number * loops) / 60 * RATE_HZ)
        wanted[first : first + round(LONG_S * RATE_HZ)] = level
    assert round((30 + 2 * loops) / 60 * RATE_HZ) < len(sound.samples)
    np.testing.assert_array_equal(sound.samples, wanted)


def test_what_was_interrupted_is_heard_until_then() -> None:
    lines: list[str] = []
    talk(lines, until_interrupted=18)
    sound = perform_log(read_log(lines), face("toon:olav")).sound
    assert sound is not None
    heard = np.flatnonzero(sound.samples)
    assert (heard[0], heard[-1] + 1) == (30 / 60 * RATE_HZ, 48 / 60 * RATE_HZ)
    assert set(sound.samples.tolist()) == {0, -5}


def test_the_sound_of_a_voice_of_the_session_is_kept() -> None:
    def voice(text: str) -> Speech:
        return Speech(text, tone(3), (), tuple(Cue(*cue) for cue in PHONES), (), "none")  # type: ignore[arg-type]

    lines: list[str] = []
    session = Session(face("toon:olav"), idle=STILL, voice=voice, log=lines.append)
    ok(session, kind="say", text="Hello")
    run(session, 30)
    session.close()
    sound = perform_log(read_log(lines), face("toon:olav")).sound
    assert sound is not None
    assert sound.samples.tolist() == [3] * (RATE_HZ // 2)


class Blind:
    """No pictures."""

    number, setup = 0, b""

    def encode(self, frame: Frame) -> bytes:
        return b""


def test_sound_that_a_server_says_is_kept() -> None:
    lines: list[str] = []
    session = Session(face("toon:olav"), idle=STILL, log=lines.append)
    message = check_message(SAY)
    utterance = make_utterance("Hello", message["phones"], (), rate=session.rate, seed=0)
    animator = Animator(session, Blind())
    animator.deliver(Part(message, utterance, None, 0))
    animator.deliver(Part(message, utterance, np.array([1, -2], dtype=np.int16), RATE_HZ))
    session.close()
    sounds = read_log(lines).sounds
    assert {speech: sound.samples.tolist() for speech, sound in sounds.items()} == {1: [1, -2]}


def test_without_sounds_there_is_none() -> None:
    lines: list[str] = []
    session = Session(face("toon:olav"), idle=STILL, log=lines.append)
    run(session, 3)
    session.close()
    session.keep_sound(0, tone(1))
    assert len(lines) == 2
    assert perform_log(read_log(lines), face("toon:olav")).sound is None


def test_much_sound_lies_in_a_file() -> None:
    sounds = Sounds()
    for number in range(5):
        sounds.add(number, tone(number, 30.0))
    kept = sounds.finish()
    assert [np.unique(sound.samples).tolist() for sound in kept.values()] == [[0], [1], [2], [3], [4]]
    assert all(isinstance(sound.samples, np.memmap) for sound in kept.values())
    spans = {number: (400.0 * number, 400.0 * number + 30) for number in range(5)}
    whole = join_sounds(kept, spans, 2000.0)
    assert whole is not None
    assert isinstance(whole.samples, np.memmap)
    assert len(whole.samples) == 2000 * RATE_HZ
    assert whole.samples[400 * RATE_HZ - 1 : 400 * RATE_HZ + 1].tolist() == [0, 1]
    assert whole.samples[430 * RATE_HZ - 1 : 430 * RATE_HZ + 1].tolist() == [1, 0]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"data": "%"}, "data: want 16-bit samples in base64, got '%'"),
        ({"data": "AAAA"}, "data"),
        ({"data": 7}, "data"),
        ({"data": None}, "data"),
        ({"rate_hz": 5}, "rate_hz"),
        ({"rate_hz": 16000}, "16000, and 8000 before"),
        ({"sound": -1}, "sound"),
        ({"sound": "a"}, "sound"),
    ],
)
def test_what_is_no_sound_is_told_with_its_line(change: dict[str, object], words: str) -> None:
    lines: list[str] = []
    talk(lines)
    number = max(index for index, line in enumerate(lines) if "rate_hz" in line)
    lines[number] = json.dumps(json.loads(lines[number]) | change)
    with pytest.raises(LoadError, match=f"log:{number + 1}: .*{words}"):
        read_log(lines)


def test_a_file_is_read_line_by_line(tmp_path: Path) -> None:
    lines: list[str] = []
    talk(lines)
    path = tmp_path / "talk.log"
    path.write_bytes(b"\xef\xbb\xbf" + "\r\n".join(lines).encode())
    stored = load_log(path)
    assert (len(stored.sounds), stored.loops) == (3, 290)
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(LoadError, match=r"no text in UTF-8"):
        load_log(path)
    with pytest.raises(LoadError, match="cannot be read"):
        load_log(tmp_path)
