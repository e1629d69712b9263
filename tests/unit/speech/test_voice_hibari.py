from __future__ import annotations

import hashlib
import itertools
import os
import subprocess
import sys
from importlib.metadata import PackageNotFoundError
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mien.core import Cue, MienError
from mien.speech import Speech, speak, strip_stress, voice_hibari_model
from mien.speech.voice_hibari_model import add_output, check_version, open_model

POEM = "How happy is the little stone\nThat rambles in the road alone,"


@pytest.fixture(scope="module")
def poem() -> Speech:
    return speak(POEM)


def test_speaking_leaves_no_telemetry_in_the_home_folder(tmp_path: Path) -> None:
    environment = {key: value for key, value in os.environ.items() if not key.startswith(("XDG_", "ORT_"))}
    program = "from mien.speech import speak; speak('Hello.')"
    subprocess.run([sys.executable, "-c", program], env={**environment, "HOME": str(tmp_path)}, check=True)
    assert [path.name for path in tmp_path.rglob("*") if "icrosoft" in str(path) or "onnx" in str(path)] == []


def level_db(speech: Speech, cue: Cue) -> float:
    """Loudness of a cue, decibels below the loudest possible."""
    first, last = round(cue.start_s * speech.sound.rate_hz), round(cue.end_s * speech.sound.rate_hz)
    samples = speech.sound.samples[first:last].astype(np.float64)
    return float(20 * np.log10(np.sqrt((samples**2).mean()) / 32767 + 1e-9))


def check_cover(speech: Speech) -> None:
    phones = speech.phones
    assert phones[0].start_s == 0
    assert phones[-1].end_s == speech.sound.length_s
    assert all(before.end_s == after.start_s for before, after in itertools.pairwise(phones))
    assert all(cue.end_s > cue.start_s for cue in (*phones, *speech.words))
    assert all(before.end_s <= after.start_s for before, after in zip(speech.words, speech.words[1:], strict=False))


def said(text: str) -> str:
    """Phones of a text in one line, without stress and pauses."""
    return " ".join(strip_stress(cue.symbol) for cue in speak(text).phones if cue.symbol != "SIL")


def test_the_phones_of_the_poem(poem: Speech):
    want = (
        "SIL HH AW2 HH AE1 P IY0 IH0 Z DH AH0 L IH1 T AH0 L S T OW1 N "
        "SIL DH AE1 T R AE1 M B AH0 L Z IH0 N DH AH0 R OW1 D AH0 L OW1 N SIL"
    )
    assert " ".join(cue.symbol for cue in poem.phones) == want
    check_cover(poem)


def test_the_words_of_the_poem(poem: Speech):
    assert [cue.symbol for cue in poem.words] == POEM.replace(",", "").split()
    happy = poem.words[1]
    inside = [cue.symbol for cue in poem.phones if happy.start_s <= cue.start_s < happy.end_s]
    assert inside == ["HH", "AE1", "P", "IY0"]


def test_the_sound_begins_and_ends_in_silence_at_the_level_of_speech(poem: Speech):
    spoken = [cue for cue in poem.phones if cue.symbol != "SIL"]
    assert 0.19 <= spoken[0].start_s <= 0.21
    assert 0.34 <= poem.sound.length_s - spoken[-1].end_s <= 0.36
    power = [10 ** (level_db(poem, cue) / 10) * cue.length_s for cue in spoken]
    assert 10 * np.log10(sum(power) / sum(cue.length_s for cue in spoken)) == pytest.approx(-20, abs=1)
    assert np.abs(poem.sound.samples.astype(int)).max() <= 32767 * 10 ** (-1 / 20)
    assert all(level_db(poem, cue) < -60 for cue in poem.phones if cue.symbol == "SIL")


def test_lips_are_shut_when_the_sound_is_stopped():
    speech = speak("Papa put a pepper above the baby, and Bob popped up.")
    closures = 0
    for before, cue, after in zip(speech.phones, speech.phones[1:], speech.phones[2:], strict=False):
        if cue.symbol in {"P", "B"} and before.symbol[-1].isdigit() and after.symbol[-1].isdigit():
            # the first half of a stop is its closure; the burst comes after it
            closure = Cue(cue.start_s, cue.centre_s, cue.symbol)
            assert level_db(speech, closure) < level_db(speech, before) - 6
            closures += 1
    assert closures >= 6


def test_two_processes_say_the_same(poem: Speech):
    def digest(speech: Speech) -> str:
        cues = repr((speech.phones, speech.words)).encode()
        return hashlib.sha256(speech.sound.samples.tobytes() + cues).hexdigest()

    # SciPy would be used by hibari where it is installed, and round otherwise.
    code = (
        f"import sys; sys.modules['scipy'] = None; from mien.speech import speak; import hashlib; s = speak({POEM!r});"
    )
    code += "print(hashlib.sha256(s.sound.samples.tobytes() + repr((s.phones, s.words)).encode()).hexdigest())"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == digest(poem) == digest(speak(POEM))


@pytest.mark.parametrize(
    ("text", "phones"),
    [
        ("Hello", "HH AH L OW"),
        ("1984", "N AY N T IY N EY T IY F AO R"),
        ("5€", "F AY V Y UH R OW Z"),
        ("1½", "W AH N AE N D AH HH AE F"),
        ("Dr. Smith", "D AA K T ER S M IH TH"),
        ("x²", "EH K S S K W EH R D"),
        ("Oh no.", "OW N OW"),
        ("no. 5", "N AH M B ER F AY V"),
        ("don't", "D OW N T"),
        ("naïve", "N AY IY V"),
        ("π", "P AY"),
        ("nurse early", "N ER S ER L IY"),
    ],
)
def test_spoken_forms(text: str, phones: str):
    assert said(text) == phones


def test_written_words_keep_their_times_when_they_are_spoken_as_several():
    speech = speak("Dr. Smith paid $5 million for “it”—once.")
    assert [cue.symbol for cue in speech.words] == ["Dr", "Smith", "paid", "$5", "million", "for", "it", "once"]
    check_cover(speech)


def test_a_number_that_hibari_cannot_read_is_read_digit_by_digit():
    speech = speak("9" * 40)
    assert [cue.symbol for cue in speech.words] == ["9" * 40]
    assert sum(cue.symbol == "AY1" for cue in speech.phones) == 40


def test_a_word_longer_than_hibari_guesses_is_said_to_its_end():
    assert said("donaudampfschifffahrtsgesellschaftskapitän").endswith("N")
    assert said("pneumonoultramicroscopicsilicovolcanoconiosis").startswith("N UW M AH")


@pytest.mark.parametrize(
    ("text", "skipped", "words"),
    [
        ("hello 你好 🙂👩‍👧 world", ("你好", "🙂👩‍👧"), ["hello", "world"]),
        ("Привет and hi🙂", ("Привет", "🙂"), ["and", "hi🙂"]),
    ],
)
def test_what_cannot_be_said_is_told(text: str, skipped: tuple[str, ...], words: list[str]):
    speech = speak(text)
    assert speech.skipped == skipped
    assert [cue.symbol for cue in speech.words] == words


@pytest.mark.parametrize("text", ["🙂", "你好", "...", "!?", "—"])
def test_nothing_to_say_is_refused(text: str):
    with pytest.raises(MienError, match="voice 'hibari' speaks en-US"):
        speak(text)


def test_a_sentence_that_does_not_end():
    text = "the stone rolled on and on " * 60
    speech = speak(text)
    assert len(speech.words) == len(text.split())
    check_cover(speech)


@settings(deadline=None, max_examples=40)
@given(st.text(st.one_of(st.characters(exclude_categories=["Cs"]), st.sampled_from("ab 12.,$€'-\n%#")), max_size=30))
def test_any_text_is_said_or_refused(text: str):
    try:
        speech = speak(text)
    except MienError:
        return
    assert speech.words
    check_cover(speech)


@pytest.mark.slow
def test_two_thousand_words_need_no_more_memory_than_two_hundred():
    code = (
        "import resource, sys; from mien.speech import speak\n"
        "used = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
        f"poem = {POEM!r} + '\\n\\n'\n"
        "speak(poem * 20); few = used(); speech = speak(poem * 170); print(few, used(), len(speech.words))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    few_kb, many_kb, words = map(int, done.stdout.split())
    assert words == 2040
    assert many_kb - few_kb < 30_000


def test_another_release_of_hibari_is_refused(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(voice_hibari_model, "version", lambda name: "0.3.0")
    with pytest.raises(MienError, match=r"want hibari-tts 0\.2\.1, got 0\.3\.0 — try: pip install"):
        check_version()


def test_a_missing_hibari_is_said(monkeypatch: pytest.MonkeyPatch):
    def missing(name: str) -> str:
        raise PackageNotFoundError(name)

    monkeypatch.setattr(voice_hibari_model, "version", missing)
    with pytest.raises(MienError, match="is not installed"):
        check_version()


def test_a_model_without_durations_is_refused():
    with pytest.raises(MienError, match="has no tensor '/Clip_output_0'"):
        open_model(b"\x08\x08")


def test_an_output_is_appended_as_a_protocol_buffer():
    # graph (field 7, bytes) of 5 bytes: output (field 12) of 3 bytes: name (field 1) of 1 byte
    assert add_output(b"M", "t") == b"M" + bytes([0x3A, 5, 0x62, 3, 0x0A, 1]) + b"t"
    long = "t" * 200
    assert add_output(b"", long).endswith(bytes([0x0A, 0xC8, 0x01]) + long.encode())
